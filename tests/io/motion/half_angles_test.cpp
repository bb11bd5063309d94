// Tests of sines and cosines of half angles, to the last digits, and of the rotations made from
// them.
#include "io/motion/motion_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

struct Pair {
  double sine, cosine;
};

Pair half(double degrees) {
  Pair pair{};
  half_angle_sincos(&degrees, 1, &pair.sine, &pair.cosine);
  return pair;
}

TEST(HalfAngles, AreWithinTwoUnitsInTheLastPlaceOfOne) {
  Random random(3);
  long double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double degrees = random.uniform(-1080, 1080);
    const long double half_angle =
        static_cast<long double>(degrees) * 3.14159265358979323846264L / 360;
    const Pair pair = half(degrees);
    worst = std::max({worst, std::fabs(pair.sine - std::sin(half_angle)),
                      std::fabs(pair.cosine - std::cos(half_angle))});
  }
  EXPECT_LT(worst, 2.3e-16L);
}

TEST(HalfAngles, AreExactAtRightAngles) {
  EXPECT_EQ(half(0).sine, 0);
  EXPECT_EQ(half(0).cosine, 1);
  EXPECT_EQ(half(180).sine, 1);
  EXPECT_EQ(half(180).cosine, 0);
  EXPECT_EQ(half(-180).sine, -1);
  EXPECT_EQ(half(360).sine, 0);
  EXPECT_EQ(half(360).cosine, -1);
  EXPECT_EQ(half(-540).sine, 1);
  EXPECT_EQ(half(720).cosine, 1);
}

TEST(HalfAngles, LoseNothingOverManyTurns) {
  for (const double turns : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    EXPECT_EQ(half(720 * turns + 64).sine, half(64).sine) << turns;
    EXPECT_EQ(half(-720 * turns + 64).cosine, half(64).cosine) << turns;
  }
  const Pair huge = half(1e300);
  EXPECT_NEAR(huge.sine * huge.sine + huge.cosine * huge.cosine, 1, 1e-15);
}

TEST(HalfAngles, OfNoNumberAreNoNumber) {
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    EXPECT_TRUE(std::isnan(half(value).sine));
    EXPECT_TRUE(std::isnan(half(value).cosine));
  }
}

TEST(MotionColumns, RotationsEqualFromEulerInEveryOrder) {
  std::vector<RotationOrder> orders(all_rotation_orders().begin(), all_rotation_orders().end());
  for (const char* few : {"X", "Y", "Z", "XY", "ZX", "YZ", "YX"})
    orders.push_back(parse_rotation_order(few));
  Skeleton skeleton;
  for (std::size_t j = 0; j < orders.size(); ++j) {
    skeleton.add_joint("j", static_cast<std::int32_t>(j) - 1, {},
                       make_channels(j % 3 == 0, orders[j]));
  }
  MotionColumns columns(skeleton);
  Random random(4);
  const std::size_t frames = columns.block_frames();
  std::vector<double> rows(frames * columns.count());
  for (double& value : rows) value = random.uniform(-400, 400);
  std::vector<Quat> rotations(frames * orders.size());
  columns.decode_rotations(rows.data(), frames, rotations.data());
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < orders.size(); ++j) {
      std::array<double, 3> angles{};
      for (std::size_t i = 0; i < orders[j].count; ++i) {
        angles[i] =
            rows[f * columns.count() + columns.rotations()[j].columns[i]] * radians_per_degree;
      }
      const Quat expected = from_euler(angles, orders[j]), q = rotations[f * orders.size() + j];
      ASSERT_NEAR(norm(q + -expected), 0, 2e-15) << to_string(orders[j]);
    }
  }
}

}  // namespace
}  // namespace kinemend
