// Tests of the damage `system` on joints and markers, in every system family and unit.
#include <gmock/gmock.h>

#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_support.hpp"
#include "lab/damage/system_noise.hpp"
#include "lab/damage/track_errors.hpp"
#include "long_tests.hpp"
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

// Markers on a grid that move independently; the body is 1.7 m tall.
Take markers(std::size_t frames, double rate_hz, const std::string& unit = "mm", double scale = 1) {
  Take clip =
      make_marker_take({"LeftHand", "RightHand", "LeftFoot", "RightFoot", "Head"}, frames, rate_hz);
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

Take with_noise(Take clip, const OptionValues& values, std::uint64_t seed = 1) {
  Random random(seed);
  apply_damage(clip, "system", values, random);
  return clip;
}

std::vector<double> errors(const Take& clean, const Take& noisy, std::size_t marker,
                           double Vec3::*axis) {
  std::vector<double> result;
  for (std::size_t f = 0; f < clean.frame_count(); ++f)
    result.push_back(noisy.position(f, marker).*axis - clean.position(f, marker).*axis);
  return result;
}

double deviation(const std::vector<double>& x) { return std::sqrt(test::variance_of(x)); }

TEST(SystemNoise, OfEachFamilyMakesSense) {
  for (const auto& [name, about, noise] : corrupt::system_families()) {
    SCOPED_TRACE(std::string(name));
    EXPECT_FALSE(about.empty());
    EXPECT_GT(noise.std_mm, 0);
    EXPECT_GT(noise.fc_hz, 0);
    EXPECT_GT(noise.slope, 1);
    EXPECT_GT(noise.floor_hz, 0);
    EXPECT_GT(noise.motion_hz, 0);
    EXPECT_LE(noise.correlation + noise.limb_correlation, 1);
    EXPECT_LE(noise.depth_correlation + noise.depth_limb_correlation, 1);
    EXPECT_LE(noise.burst_min_s, noise.burst_max_s);
    EXPECT_LE(noise.burst_min_height, noise.burst_max_height);
    EXPECT_EQ(noise.limb_errors_per_min > 0, noise.limb_error_mm > 0);
  }
}

TEST(SystemNoise, LeavesEveryByteWhereItHasNoStrength) {
  const Take clean = moving_humanoid(100);
  const Take taken = markers(100, 60);
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
  const Take clean = markers(600, 60);
  for (const std::string& name : kinds()) {
    if (name == "inertial") continue;  // rotations do not add up linearly
    const Take once = with_noise(clean, kind(name)),
               twice = with_noise(clean, kind(name, {{"strength", 2.0}}));
    for (std::size_t i = 0; i < clean.positions.size(); ++i) {
      const Vec3 a = once.positions[i] - clean.positions[i],
                 b = twice.positions[i] - clean.positions[i];
      ASSERT_LT(norm(b - 2.0 * a), 1e-9 * (1 + norm(a))) << name;
    }
  }
}

TEST(SystemNoise, IsOfMillimetresWhateverTheUnitOfTheFile) {
  const Take clean = markers(600, 60), in_metres = markers(600, 60, "m", 0.001);
  for (const std::string& name : kinds()) {
    const Take a = with_noise(clean, kind(name)), b = with_noise(in_metres, kind(name));
    for (std::size_t i = 0; i < clean.positions.size(); ++i)
      ASSERT_LT(norm(a.positions[i] - 1000.0 * b.positions[i]), 1e-6) << name;
  }
}

// Spectral density along an axis of a family's slow noise and floor alone, over five tracks.
test::Spectrum density_of(corrupt::SystemNoise noise, double rate_hz, std::uint64_t seed,
                          double Vec3::*axis) {
  noise.motion_mm = noise.leak = noise.bursts_per_min = noise.limb_error_mm = 0;
  const auto frames = static_cast<std::size_t>(600 * rate_hz);
  const std::vector<double> still(frames, 0.0);
  corrupt::TrackErrors tracks(noise, frames, rate_hz, Random(seed));
  test::Spectrum sum;
  for (std::size_t m = 0; m < 5; ++m) {
    std::vector<double> along;
    for (const Vec3 e : tracks.errors_of({m, m, false, 2, still, {}})) along.push_back(e.*axis);
    const auto found = test::welch(along, rate_hz, static_cast<std::size_t>(4 * rate_hz));
    if (m == 0) sum = found;
    for (std::size_t k = 0; m > 0 && k < sum.density.size(); ++k)
      sum.density[k] += found.density[k];
  }
  return sum;
}

TEST(SystemNoise, HasTheSameSpectrumBelow25HzAtBothRates) {
  KINEMEND_LONG_TEST();
  for (const auto& [name, about, noise] : corrupt::system_families()) {
    if (name == "inertial") continue;  // has hardly any noise above its corner of 1.4 Hz
    for (double Vec3::*const axis : {&Vec3::x, &Vec3::z}) {
      const test::Spectrum at_60 = density_of(noise, 60, 3, axis),
                           at_120 = density_of(noise, 120, 4, axis);
      for (const auto& [low, high] : {std::pair{0.5, 2.0}, {2, 6}, {6, 15}, {15, 25}})
        EXPECT_NEAR(at_60.between(low, high) / at_120.between(low, high), 1, 0.15)
            << name << " " << low;
    }
  }
}

TEST(SystemNoise, IsStrongerAtArmsAndInDepth) {
  Take clean = markers(60 * 300, 60);
  for (std::size_t f = 1; f < clean.frame_count(); ++f) {
    for (std::size_t m = 0; m < 5; ++m) clean.position(f, m) = clean.position(0, m);
  }
  // A corner low enough for the family and high enough to average out in five minutes.
  const Take noisy = with_noise(
      clean,
      kind("video", {{"fc_hz", 2.0}, {"bursts_per_min", 0.0}, {"depth_axis", std::string("x")}}));
  const corrupt::SystemNoise video = corrupt::system_families()[0].noise;
  const double floor = video.floor_mm, depth_floor = video.floor_depth_factor * floor;
  const double arm = video.arm_factor * video.std_mm, depth = video.depth_factor;
  const auto expect_deviation = [&](std::size_t marker, double Vec3::*axis, double expected) {
    EXPECT_NEAR(deviation(errors(clean, noisy, marker, axis)), expected, 0.1 * expected) << marker;
  };
  expect_deviation(0, &Vec3::y, std::hypot(arm, floor));
  expect_deviation(0, &Vec3::x, std::hypot(depth * arm, depth_floor));
  expect_deviation(2, &Vec3::y, std::hypot(video.std_mm, floor));
  expect_deviation(4, &Vec3::x, std::hypot(depth * video.std_mm, depth_floor));
}

TEST(SystemNoise, TakesItsOptionsInPlaceOfTheKind) {
  const Take clean = markers(60 * 120, 60);
  const corrupt::SystemNoise video = corrupt::system_families()[0].noise;
  const auto with = [&](const OptionValues& more) {
    return with_noise(clean, kind("video", more)).positions;
  };
  const std::vector<Vec3> usual = with({});
  EXPECT_EQ(with({{"fc_hz", -1.0}, {"bursts_per_min", -1.0}, {"heading_deg", -1.0}}), usual);
  EXPECT_EQ(with({{"fc_hz", video.fc_hz},
                  {"bursts_per_min", video.bursts_per_min},
                  {"heading_deg", video.heading_deg}}),
            usual);
  EXPECT_NE(with({{"fc_hz", 2 * video.fc_hz}}), usual);
  EXPECT_NE(with({{"bursts_per_min", 0.0}}), usual);
  EXPECT_NE(with({{"heading_deg", 8.0}}), usual);
}

TEST(SystemNoise, TakesTheAxisForDepthAlongWhichTheBodyIsThinnest) {
  const Take clean = markers(60 * 120, 60);
  const Take noisy = with_noise(clean, kind("video"));
  EXPECT_GT(deviation(errors(clean, noisy, 4, &Vec3::z)),
            2 * deviation(errors(clean, noisy, 4, &Vec3::x)));
}

TEST(SystemNoise, TurnsJointsByDegrees) {
  const Take clean = moving_humanoid(12000);
  const auto noisy =
      damaged(clean, "system", kind("inertial", {{"strength", 0.8}, {"heading_deg", 0.0}})).clip;
  double square = 0;
  for (const std::size_t joint : {1, 5, 9, 12}) {
    for (const Vec3 e : test::errors_of(clean, noisy, joint)) square += dot(e, e) / 12000 / 4 / 3;
  }
  const double arc_mm = 0.8 * corrupt::system_families()[3].noise.std_mm;
  EXPECT_NEAR(std::sqrt(square), arc_mm / 425, 0.15 * arc_mm / 425);  // radians
}

TEST(SystemNoise, DriftsTheHeadingOfJointsAndMarkersAlike) {
  // The noise is the same with and without drift, so drift is the only difference.
  const OptionValues still = kind("optical"), drift = kind("optical", {{"heading_deg", 30.0}});
  const Take clean = damaged(moving_humanoid(2400), "system", still).clip;
  const Take turned = damaged(moving_humanoid(2400), "system", drift).clip;
  const auto before = joint_positions(clean), after = joint_positions(turned);
  const std::size_t joints = clean.joint_count();
  // The body stays rigid: distances between joints are unchanged.
  for (std::size_t f = 0; f < 2400; f += 100) {
    for (std::size_t j = 1; j < joints; ++j)
      ASSERT_NEAR(norm(after[f * joints + j] - after[f * joints]),
                  norm(before[f * joints + j] - before[f * joints]), 1e-6);
    ASSERT_NEAR(after[f * joints].y, before[f * joints].y, 1e-6) << "heights stay";
  }
  EXPECT_GT(angle_between(clean.rotation(2399, 0), turned.rotation(2399, 0)), 0.02);
  const Take taken = with_noise(markers(2400, 120), still),
             moved = with_noise(markers(2400, 120), drift);
  EXPECT_GT(norm(moved.position(2399, 0) - taken.position(2399, 0)), 20);
  for (std::size_t f = 0; f < 2400; f += 100) {
    EXPECT_NEAR(norm(moved.position(f, 0) - moved.position(f, 4)),
                norm(taken.position(f, 0) - taken.position(f, 4)), 1e-6);
  }
}

TEST(SystemNoise, LeavesWhatIsMissingAndOtherPointsAlone) {
  Take clean = markers(200, 60);
  for (std::size_t f = 50; f < 90; ++f) {
    clean.position(f, 1) = {};
    clean.observed[f * 5 + 1] = 0;
  }
  const Take noisy = with_noise(clean, kind("video", {{"joints", std::string("*Hand")}}));
  EXPECT_EQ(noisy.observed, clean.observed);
  for (std::size_t f = 0; f < 200; ++f) {
    EXPECT_EQ(noisy.position(f, 1) == clean.position(f, 1), f >= 50 && f < 90) << f;
    EXPECT_EQ(noisy.position(f, 4), clean.position(f, 4));
  }
}

TEST(SystemNoise, MovesTranslatedJointsAndTheRoot) {
  Take clean = moving_humanoid(100);
  test::add_translations(clean, {3}, clean.skeleton.offsets[3]);
  for (std::int32_t axis = 0; axis < 3; ++axis) {
    clean.skeleton.channels[3].insert(
        clean.skeleton.channels[3].begin() + axis,
        static_cast<Channel>(static_cast<int>(Channel::x_position) + axis));
  }
  const Take noisy = damaged(clean, "system", kind("optical")).clip;
  EXPECT_NE(test::point_track(noisy, 1), test::point_track(clean, 1));
  EXPECT_NE(test::point_track(noisy, 0), test::point_track(clean, 0));
  const Take without = damaged(clean, "system", kind("optical", {{"root", false}})).clip;
  EXPECT_EQ(test::point_track(without, 0), test::point_track(clean, 0));
  EXPECT_EQ(test::point_track(without, 1), test::point_track(noisy, 1));
}

TEST(SystemNoise, RefusesNumbersOutOfRange) {
  const Take clean = markers(10, 60);
  const auto refused = [&](const OptionValues& values, const std::string& text) {
    EXPECT_THAT([&] { with_noise(clean, values); }, ThrowsMessage<Error>(HasSubstr(text)));
  };
  refused({{"kind", std::string("radar")}},
          "is not one of video, triangulated, depth, inertial, optical");
  refused({{"fc_hz", 0.0}}, "fc_hz: must be above 0 Hz");
  refused({{"fc_hz", 1000.0}}, "fc_hz: 1000 is outside -1 to 100 Hz");
  refused({{"slope", 2.0}}, "unknown option slope");
}

}  // namespace
}  // namespace kinemend
