// Tests of the drift of heading and position, by its statistics over many seeds.
#include "lab/damage/drift.hpp"

#include <gmock/gmock.h>

namespace kinemend::corrupt {
namespace {

std::vector<Vec3> walk(std::size_t frames) {
  std::vector<Vec3> centres;
  for (std::size_t f = 0; f < frames; ++f) centres.push_back({0.01 * static_cast<double>(f), 1, 3});
  return centres;
}

TEST(Drift, KeepsTheLengthOfStepsAndTheHeight) {
  const auto centres = walk(6000);
  const Drift drift = drifted(centres, 100, Axis::y, 30, 0, Random(1));
  EXPECT_EQ(drift.places[0], centres[0]);
  for (std::size_t f = 1; f < centres.size(); ++f) {
    EXPECT_NEAR(norm(drift.places[f] - drift.places[f - 1]), 0.01, 1e-12);
    EXPECT_NEAR(drift.places[f].y, 1, 1e-9);
  }
  EXPECT_GT(norm(drift.places.back() - centres.back()), 1);
}

TEST(Drift, TurnsAboutTheAxisThatPointsUpOnly) {
  const Drift drift = drifted(walk(1000), 100, Axis::z, 30, 0.5, Random(2));
  ASSERT_EQ(drift.headings.size(), 1000u);
  EXPECT_GT(std::fabs(drift.headings.back().z), 0.01);
  for (const Quat q : drift.headings) {
    EXPECT_NEAR(q.x, 0, 1e-15);
    EXPECT_NEAR(q.y, 0, 1e-15);
  }
  for (const Vec3 place : drift.places) EXPECT_NEAR(place.z, 3, 1e-9);
}

TEST(Drift, HasTheSizesAskedForAfterAMinute) {
  double heading = 0, place = 0;
  const std::vector<Vec3> still(601, Vec3{});
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const Drift drift = drifted(still, 10, Axis::y, 8, 300, Random(seed));
    const double angle = degrees_per_radian * norm(log(drift.headings.back()));
    heading += angle * angle / 1000;
    place += dot(drift.places.back(), drift.places.back()) / 1000;
  }
  EXPECT_NEAR(std::sqrt(heading), 8, 0.6);
  EXPECT_NEAR(std::sqrt(place / 2), 300, 18);
}

}  // namespace
}  // namespace kinemend::corrupt
