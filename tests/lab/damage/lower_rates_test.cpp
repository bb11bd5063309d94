// Tests of the damages that simulate capture at a lower rate.
#include <gmock/gmock.h>

#include <cmath>

#include "lab/damage/damage_support.hpp"

namespace kinemend {
namespace {

using test::damaged;
using test::moving_humanoid;
using test::same_bits;
using testing::Contains;
using testing::HasSubstr;

Take line(std::size_t frames, double rate_hz) {
  Take clip = make_marker_take({"A"}, frames, rate_hz);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate_hz;
    clip.position(f, 0) = {t, t * t, std::sin(20 * t)};
    clip.observed[f] = 1;
  }
  return clip;
}

Take with(Take clip, const char* damage, double rate_hz) {
  Random random(1);
  apply_damage(clip, damage, {{"rate_hz", rate_hz}}, random);
  return clip;
}

TEST(Held, RepeatsEverySecondFrameOfTwiceTheRate) {
  const Take clean = moving_humanoid(101);
  const Take held = damaged(clean, "held", {{"rate_hz", 60.0}}).clip;
  for (std::size_t f = 0; f < 101; ++f) {
    for (std::size_t j = 0; j < clean.joint_count(); ++j)
      ASSERT_TRUE(same_bits(held.rotation(f, j), clean.rotation(f - f % 2, j)));
    ASSERT_EQ(held.root_position(f), clean.root_position(f - f % 2));
  }
}

TEST(Held, TakesSamplesBetweenFramesWhereRatesDoNotDivide) {
  const Take clean = line(101, 100), held = with(clean, "held", 60);
  for (std::size_t f = 0; f < 101; ++f) {
    const double sampled = std::floor(static_cast<double>(f) * 0.6 + 1e-6) / 60;
    EXPECT_NEAR(held.position(f, 0).x, sampled, 1e-12) << f;
  }
}

TEST(Upsampled, IsStraightBetweenSamplesAndHoldsTheLast) {
  const Take clean = line(103, 120), lines = with(clean, "upsampled", 30);
  for (std::size_t f = 0; f < 103; ++f) {
    const std::size_t before = f - f % 4;
    const double share = before + 4 < 103 ? static_cast<double>(f % 4) / 4 : 0;
    const Vec3 a = clean.position(before, 0),
               b = clean.position(std::min<std::size_t>(before + 4, 102), 0);
    EXPECT_LT(norm(lines.position(f, 0) - (a + share * (b - a))), 1e-12) << f;
  }
  EXPECT_EQ(lines.position(102, 0), clean.position(100, 0));
  EXPECT_EQ(lines.position(40, 0), clean.position(40, 0));
}

TEST(Upsampled, TurnsAlongTheGeodesic) {
  const Take clean = moving_humanoid(101);
  const Take lines = damaged(clean, "upsampled", {{"rate_hz", 30.0}}).clip;
  for (std::size_t f = 0; f + 4 < 101; f += 4) {
    const double step = angle_between(clean.rotation(f, 5), clean.rotation(f + 4, 5)) / 4;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(angle_between(lines.rotation(f + i, 5), lines.rotation(f + i + 1, 5)), step,
                  1e-9);
  }
}

TEST(LowerRates, LoseWhatALowerRateDidNotSee) {
  Take clean = line(41, 120);
  for (std::size_t f = 8; f < 11; ++f) clean.observed[f] = 0, clean.position(f, 0) = {};
  const Take held = with(clean, "held", 30), lines = with(clean, "upsampled", 30);
  for (std::size_t f = 0; f < 41; ++f) {
    EXPECT_EQ(held.observed[f], f >= 8 && f < 12 ? 0 : 1) << f;
    EXPECT_EQ(lines.observed[f], f > 4 && f < 12 ? 0 : 1) << f;
  }
}

TEST(LowerRates, LeaveTakesOfNoHigherRateAlone) {
  const Take clean = moving_humanoid(50, 60);
  for (const char* name : {"held", "upsampled"}) {
    const auto [clip, report] = damaged(clean, name, {{"rate_hz", 60.0}});
    EXPECT_EQ(report.samples_damaged, 0u);
    EXPECT_EQ(clip.positions, clean.positions);
    EXPECT_THAT(report.notes, Contains(HasSubstr("the take has 60 Hz")));
  }
}

}  // namespace
}  // namespace kinemend
