#include <gmock/gmock.h>

#include <cmath>

#include "corrupt/damage_support.hpp"
#include "corrupt/system_noise.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/kinematics.hpp"
#include "noise_measures.hpp"
#include "translations.hpp"

namespace kinemend {
namespace {

using test::damaged;
using test::moving_humanoid;
using test::same_bits;
using testing::HasSubstr;
using testing::ThrowsMessage;

OptionValues kind(const std::string& name, OptionValues more = {}) {
  more["kind"] = name;
  return more;
}

std::vector<std::string> kinds() {
  std::vector<std::string> names;
  for (const auto& family : corrupt::system_families()) names.emplace_back(family.name);
  return names;
}

// Markers on a grid, each moving by itself, 1.7 m tall.
MarkerClip markers(std::size_t frames, double rate_hz, const std::string& unit = "mm",
                   double scale = 1) {
  MarkerClip clip =
      make_marker_clip({"LeftHand", "RightHand", "LeftFoot", "RightFoot", "Head"}, frames, rate_hz);
  clip.unit = unit;
  const Vec3 places[] = {{300, 1000, 0}, {-300, 1000, 0}, {100, 0, 50}, {-100, 0, 0}, {0, 1700, 0}};
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / rate_hz;
    for (std::size_t m = 0; m < 5; ++m) {
      const double k = 1 + 0.2 * static_cast<double>(m);
      clip.position(f, m) =
          scale * (places[m] + 80 * Vec3{std::sin(k * t), std::cos(2 * k * t), 0});
      clip.observed[f * 5 + m] = 1;
    }
  }
  return clip;
}

MarkerClip with_noise(MarkerClip clip, const OptionValues& values, std::uint64_t seed = 1) {
  Random random(seed);
  apply_damage(clip, "system", values, random);
  return clip;
}

std::vector<double> errors(const MarkerClip& clean, const MarkerClip& noisy, std::size_t marker,
                           double Vec3::*axis) {
  std::vector<double> result;
  for (std::size_t f = 0; f < clean.frame_count(); ++f)
    result.push_back(noisy.position(f, marker).*axis - clean.position(f, marker).*axis);
  return result;
}

double deviation(const std::vector<double>& x) { return std::sqrt(test::variance_of(x)); }

TEST(SystemNoise, GivesAllItsNumbersInEachFamily) {
  for (const auto& family : corrupt::system_families()) {
    for (const auto& field : corrupt::system_fields()) {
      EXPECT_GE(family.noise.*field.member, 0) << family.name << " " << field.name;
      EXPECT_LE(family.noise.*field.member, field.maximum) << family.name << " " << field.name;
    }
    EXPECT_NO_THROW(corrupt::completed({}, family)) << family.name;
  }
}

TEST(SystemNoise, LeavesEveryByteWhereItHasNoStrength) {
  const Clip clean = moving_humanoid(100);
  const MarkerClip taken = markers(100, 60);
  for (const std::string& name : kinds()) {
    const auto [clip, report] = damaged(clean, "system", kind(name, {{"strength", 0.0}}));
    for (std::size_t i = 0; i < clean.rotations.size(); ++i)
      ASSERT_TRUE(same_bits(clip.rotations[i], clean.rotations[i]));
    EXPECT_EQ(clip.positions, clean.positions);
    EXPECT_EQ(report.samples_damaged, 0u);
    EXPECT_EQ(with_noise(taken, kind(name, {{"strength", 0.0}})).positions, taken.positions);
  }
}

TEST(SystemNoise, GrowsInProportionToItsStrength) {
  const MarkerClip clean = markers(600, 60);
  for (const std::string& name : kinds()) {
    if (name == "inertial") continue;  // turns are no sums
    const MarkerClip once = with_noise(clean, kind(name)),
                     twice = with_noise(clean, kind(name, {{"strength", 2.0}}));
    for (std::size_t i = 0; i < clean.positions.size(); ++i) {
      const Vec3 a = once.positions[i] - clean.positions[i],
                 b = twice.positions[i] - clean.positions[i];
      ASSERT_LT(norm(b - 2.0 * a), 1e-9 * (1 + norm(a))) << name;
    }
  }
}

TEST(SystemNoise, IsOfMillimetresWhateverTheUnitOfTheFile) {
  const MarkerClip clean = markers(600, 60), in_metres = markers(600, 60, "m", 0.001);
  for (const std::string& name : kinds()) {
    const MarkerClip a = with_noise(clean, kind(name)), b = with_noise(in_metres, kind(name));
    for (std::size_t i = 0; i < clean.positions.size(); ++i)
      ASSERT_LT(norm(a.positions[i] - 1000.0 * b.positions[i]), 1e-6) << name;
  }
}

TEST(SystemNoise, HasTheSameSpectrumBelow25HzAtBothRates) {
  const OptionValues slow_only{
      {"motion_mm", 0.0}, {"leak", 0.0}, {"bursts_per_min", 0.0}, {"depth_axis", std::string("z")}};
  const MarkerClip at_60 = markers(60 * 600, 60), at_120 = markers(120 * 600, 120);
  for (const std::string name : {"video", "triangulated", "optical"}) {
    const MarkerClip a = with_noise(at_60, kind(name, slow_only), 3),
                     b = with_noise(at_120, kind(name, slow_only), 4);
    for (double Vec3::*const axis : {&Vec3::x, &Vec3::z}) {
      test::Spectrum of_60, of_120;
      for (std::size_t m = 0; m < 5; ++m) {
        const auto s = test::welch(errors(at_60, a, m, axis), 60, 240),
                   t = test::welch(errors(at_120, b, m, axis), 120, 480);
        if (m == 0) of_60 = s, of_120 = t;
        for (std::size_t k = 0; m > 0 && k < s.density.size(); ++k)
          of_60.density[k] += s.density[k];
        for (std::size_t k = 0; m > 0 && k < t.density.size(); ++k)
          of_120.density[k] += t.density[k];
      }
      for (const auto& [low, high] : {std::pair{0.5, 2.0}, {2, 6}, {6, 15}, {15, 25}})
        EXPECT_NEAR(of_60.between(low, high) / of_120.between(low, high), 1, 0.15)
            << name << " " << low;
    }
  }
}

TEST(SystemNoise, IsStrongerAtArmsAndInDepth) {
  const MarkerClip clean = markers(60 * 300, 60);
  const MarkerClip noisy = with_noise(clean, kind("video", {{"std_mm", 5.0},
                                                            {"arm_factor", 3.0},
                                                            {"depth_factor", 4.0},
                                                            {"fc_hz", 2.0},
                                                            {"floor_mm", 0.0},
                                                            {"motion_mm", 0.0},
                                                            {"leak", 0.0},
                                                            {"depth_axis", std::string("x")}}));
  EXPECT_NEAR(deviation(errors(clean, noisy, 0, &Vec3::y)), 15, 1.5);
  EXPECT_NEAR(deviation(errors(clean, noisy, 0, &Vec3::x)), 60, 6);
  EXPECT_NEAR(deviation(errors(clean, noisy, 2, &Vec3::y)), 5, 0.5);
  EXPECT_NEAR(deviation(errors(clean, noisy, 4, &Vec3::x)), 20, 2);
}

TEST(SystemNoise, TakesTheAxisForDepthAlongWhichTheBodyIsThinnest) {
  const MarkerClip clean = markers(60 * 120, 60);
  const MarkerClip noisy = with_noise(clean, kind("video"));
  EXPECT_GT(deviation(errors(clean, noisy, 4, &Vec3::z)),
            2 * deviation(errors(clean, noisy, 4, &Vec3::x)));
}

TEST(SystemNoise, TurnsJointsByDegrees) {
  const Clip clean = moving_humanoid(12000);
  const auto noisy =
      damaged(clean, "system",
              kind("inertial", {{"std_deg", 4.0}, {"heading_deg", 0.0}, {"root_mm", 0.0}}))
          .clip;
  double square = 0;
  for (const std::size_t joint : {1, 5, 9, 12}) {
    for (const Vec3 e : test::errors_of(clean, noisy, joint)) square += dot(e, e) / 12000 / 4 / 3;
  }
  EXPECT_NEAR(degrees_per_radian * std::sqrt(square), 4, 0.6);
}

TEST(SystemNoise, DriftsTheHeadingOfJointsAndMarkersAlike) {
  const OptionValues drift =
      kind("inertial", {{"std_mm", 0.0}, {"heading_deg", 30.0}, {"root_mm", 0.0}});
  const Clip clean = moving_humanoid(2400);
  const Clip turned = damaged(clean, "system", drift).clip;
  const auto before = joint_positions(clean), after = joint_positions(turned);
  const std::size_t joints = clean.joint_count();
  // The body stays rigid: distances between joints are what they were.
  for (std::size_t f = 0; f < 2400; f += 100) {
    for (std::size_t j = 1; j < joints; ++j)
      ASSERT_NEAR(norm(after[f * joints + j] - after[f * joints]),
                  norm(before[f * joints + j] - before[f * joints]), 1e-6);
    ASSERT_NEAR(after[f * joints].y, before[f * joints].y, 1e-6) << "heights stay";
  }
  EXPECT_GT(angle_between(clean.rotation(2399, 0), turned.rotation(2399, 0)), 0.02);
  const MarkerClip taken = markers(2400, 120), moved = with_noise(taken, drift);
  for (std::size_t f = 0; f < 2400; f += 100) {
    EXPECT_NEAR(norm(moved.position(f, 0) - moved.position(f, 4)),
                norm(taken.position(f, 0) - taken.position(f, 4)), 1e-6);
  }
}

TEST(SystemNoise, LeavesWhatIsMissingAndOtherPointsAlone) {
  MarkerClip clean = markers(200, 60);
  for (std::size_t f = 50; f < 90; ++f) {
    clean.position(f, 1) = {};
    clean.observed[f * 5 + 1] = 0;
  }
  const MarkerClip noisy = with_noise(clean, kind("video", {{"joints", std::string("*Hand")}}));
  EXPECT_EQ(noisy.observed, clean.observed);
  for (std::size_t f = 0; f < 200; ++f) {
    EXPECT_EQ(noisy.position(f, 1) == clean.position(f, 1), f >= 50 && f < 90) << f;
    EXPECT_EQ(noisy.position(f, 4), clean.position(f, 4));
  }
}

TEST(SystemNoise, MovesTranslatedJointsAndTheRoot) {
  Clip clean = moving_humanoid(100);
  test::add_translations(clean, {3}, clean.skeleton.offsets[3]);
  for (std::int32_t axis = 0; axis < 3; ++axis) {
    clean.skeleton.channels[3].insert(
        clean.skeleton.channels[3].begin() + axis,
        static_cast<Channel>(static_cast<int>(Channel::x_position) + axis));
  }
  const Clip noisy = damaged(clean, "system", kind("optical")).clip;
  EXPECT_NE(test::point_track(noisy, 1), test::point_track(clean, 1));
  EXPECT_NE(test::point_track(noisy, 0), test::point_track(clean, 0));
  const Clip without = damaged(clean, "system", kind("optical", {{"root", false}})).clip;
  EXPECT_EQ(test::point_track(without, 0), test::point_track(clean, 0));
  EXPECT_EQ(test::point_track(without, 1), test::point_track(noisy, 1));
}

TEST(SystemNoise, RefusesNumbersThatContradictEachOther) {
  const MarkerClip clean = markers(10, 60);
  const auto refused = [&](const OptionValues& values, const std::string& text) {
    EXPECT_THAT([&] { with_noise(clean, values); }, ThrowsMessage<Error>(HasSubstr(text)));
  };
  refused({{"kind", std::string("radar")}},
          "is not one of video, triangulated, depth, inertial, optical");
  refused({{"slope", 1.0}}, "slope: 1 is not above 1");
  refused({{"fc_hz", 0.0}}, "fc_hz: must be above 0 Hz");
  refused({{"fc_hz", 1000.0}}, "fc_hz: 1000 is outside -1 to 100 Hz");
  refused({{"correlation", 0.7}, {"limb_correlation", 0.4}}, "more than 1 together");
  refused({{"burst_min_s", 0.3}}, "burst_max_s is below burst_min_s");
}

}  // namespace
}  // namespace kinemend
