// The default method on synthetic takes, and problems that users of such tools report.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {
namespace {

Take take(const std::string& motion, double duration_s = 5, double rate_hz = 120) {
  SynthOptions options;
  options.motion = motion;
  options.duration_s = duration_s;
  options.frame_rate_hz = rate_hz;
  return synthesize(options);
}

Take shipped(const char* name) {
  return read_joints(std::string(KINEMEND_TAKES) + "/" + name).take;
}

/// A chain of four joints: the first passes +-180 degrees of yaw, and the second reaches 88 degrees
/// of pitch.
Take turning_chain() {
  Take clip;
  const RotationOrder order = parse_rotation_order("ZYX");
  for (int j = 0; j < 4; ++j) {
    clip.skeleton.add_joint("link" + std::to_string(j), j - 1, {0, 10, 0},
                            make_channels(j == 0, order));
  }
  clip.frame_rate_hz = 60;
  constexpr std::size_t frames = 600;
  clip.positions.assign(frames, {});
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / clip.frame_rate_hz;
    const double yaw = 0.9 * t, pitch = 88 * radians_per_degree * std::sin(1.3 * t);
    clip.rotations.push_back(from_euler({0, yaw, 0}, order));
    clip.rotations.push_back(from_euler({0.5 * yaw, pitch, 0}, order));
    clip.rotations.push_back(from_euler({0, pitch, yaw}, order));
    clip.rotations.push_back(from_euler({-yaw, 0.5 * pitch, 0.3 * yaw}, order));
  }
  return clip;
}

// The noise is half of each channel's motion, so it moves some axes much more than others.
TEST(Auto, BeatsGaussiansOfAnyWidthWhereNoiseHasDirections) {
  for (const char* motion : {"walk", "run", "punch"}) {
    const Take truth = take(motion);
    Take noisy = truth;
    Random random(7);
    apply_damage(noisy, "gaussian-channels", {{"k", 0.5}}, random);
    const double ours = figures(truth, cleaned(noisy, "auto")).rms;
    for (const double width_s : {0.01, 0.018, 0.025, 0.035, 0.045, 0.06, 0.08}) {
      EXPECT_LT(ours, figures(truth, cleaned(noisy, "gaussian", {{"width_s", width_s}})).rms)
          << motion << ", " << width_s << " s";
    }
  }
}

class AutoOnShippedMotions : public testing::TestWithParam<const char*> {};

TEST_P(AutoOnShippedMotions, BeatsEveryFilterWithFixedParameters) {
  const Take truth = take(GetParam());
  const Take noisy = damaged(truth, 1.5, 0.004, 3);
  const double ours = figures(truth, cleaned(noisy, "auto")).rms;
  EXPECT_LT(ours, 0.45 * figures(truth, noisy).rms);
  for (const auto& filter : fixed_filters()) {
    EXPECT_LT(ours, figures(truth, cleaned(noisy, filter.first, filter.second)).rms)
        << describe(filter);
  }
}

TEST_P(AutoOnShippedMotions, LeavesACleanTakeAlone) {
  const Take truth = take(GetParam());
  EXPECT_LT(geodesic_rms_deg(truth, cleaned(truth, "auto")), 0.05);
}

TEST_P(AutoOnShippedMotions, ChangesLittleTheSecondTime) {
  const Take noisy = damaged(take(GetParam()), 1.5, 0.004, 5);
  const Take once = cleaned(noisy, "auto");
  const double first_change = geodesic_rms_deg(noisy, once);
  EXPECT_LT(geodesic_rms_deg(once, cleaned(once, "auto")), 0.1 * first_change);
}

INSTANTIATE_TEST_SUITE_P(Motions, AutoOnShippedMotions,
                         testing::Values("walk", "run", "jump", "turn", "wave"),
                         [](const auto& motion) { return std::string(motion.param); });

TEST(Auto, CleansTheTakeThatShips) {
  const Take truth = shipped("walk.bvh"), noisy = shipped("noisy_walk.bvh");
  const Figures before = figures(truth, noisy), after = figures(truth, cleaned(noisy, "auto"));
  EXPECT_GT(before.rms, 3.0);
  EXPECT_LT(after.rms, 0.25 * before.rms);
}

TEST(Auto, HoldsThroughHalfTurnsAndNearGimbalLock) {
  const Take truth = turning_chain();
  const Take noisy = damaged(truth, 1.0, 0, 7);
  EXPECT_GT(geodesic_rms_deg(truth, noisy), 1.6);
  const Take result = cleaned(noisy, "auto");
  EXPECT_LT(geodesic_rms_deg(truth, result), 0.50);
  const Take written = read_joints(write_take(result), "chain.bvh").take;
  EXPECT_LT(geodesic_rms_deg(truth, written), 0.50);
}

TEST(Auto, HasNoBumpOrFadeAtTheEnds) {
  const Take truth = take("walk");
  double ends = 0, middle = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Take result = cleaned(damaged(truth, 1.5, 0, seed), "auto");
    const std::size_t frames = truth.frame_count();
    ends += geodesic_rms_deg(slice(truth, 0, 5), slice(result, 0, 5)) +
            geodesic_rms_deg(slice(truth, frames - 5, frames), slice(result, frames - 5, frames));
    middle +=
        2 * geodesic_rms_deg(slice(truth, 100, frames - 100), slice(result, 100, frames - 100));
  }
  EXPECT_LT(ends, 2.0 * middle);
}

TEST(Auto, TakesNoNoticeOfTheSignOfAQuaternion) {
  const Take noisy = damaged(take("turn", 3), 1.5, 0.004, 9);
  Take negated = noisy;
  for (std::size_t i = 0; i < negated.rotations.size(); i += 3) {
    negated.rotations[i] = -negated.rotations[i];
  }
  EXPECT_LT(geodesic_rms_deg(cleaned(noisy, "auto"), cleaned(negated, "auto")), 1e-6);
}

TEST(Auto, DoesNotShiftTheMotionInTime) {
  const Take truth = take("walk");
  const Take result = cleaned(damaged(truth, 1.5, 0.004, 2), "auto");
  const std::size_t frames = truth.frame_count();
  const auto error_at = [&](int lag) {
    const auto first = static_cast<std::size_t>(10 + lag);
    return geodesic_rms_deg(slice(truth, 10, frames - 10),
                            slice(result, first, first + frames - 20));
  };
  for (const int lag : {-3, -2, -1, 1, 2, 3})
    EXPECT_LT(error_at(0), error_at(lag)) << "lag " << lag;
}

TEST(Auto, ReversedInTimeGivesTheReversedResult) {
  const Take noisy = damaged(take("walk", 3), 1.5, 0.004, 4);
  const auto reversed = [](Take clip) {
    const std::size_t joints = clip.joint_count(), frames = clip.frame_count();
    for (std::size_t f = 0; f < frames / 2; ++f) {
      std::swap(clip.root_position(f), clip.root_position(frames - 1 - f));
      for (std::size_t j = 0; j < joints; ++j)
        std::swap(clip.rotation(f, j), clip.rotation(frames - 1 - f, j));
    }
    return clip;
  };
  EXPECT_LT(geodesic_rms_deg(cleaned(noisy, "auto"), reversed(cleaned(reversed(noisy), "auto"))),
            0.15);
}

class FastEvent : public testing::TestWithParam<const char*> {};

TEST_P(FastEvent, KeepsItsPeakSpeed) {
  const Take truth = take(GetParam(), 4);
  const CleanResult result = clean_take(damaged(truth, 0.5, 0.002, 6), *make_cleaner("auto"));
  const auto before = peak_angular_speed_deg_s(truth),
             after = peak_angular_speed_deg_s(result.take);
  for (std::size_t j = 0; j < truth.joint_count(); ++j) {
    if (before[j] < 200) continue;
    EXPECT_GT(after[j], 0.85 * before[j]) << truth.skeleton.names[j];
    EXPECT_LT(after[j], 1.2 * before[j]) << truth.skeleton.names[j];
  }
}

INSTANTIATE_TEST_SUITE_P(Events, FastEvent, testing::Values("punch", "clap", "landing"),
                         [](const auto& motion) { return std::string(motion.param); });

TEST(Auto, KeepsTheContactOfALanding) {
  const Take truth = take("landing", 4);
  const Take noisy = damaged(truth, 0.5, 0.002, 8);
  const Take result = cleaned(noisy, "auto");
  EXPECT_LT(foot_slide(truth, result).per_frame, 0.5 * foot_slide(truth, noisy).per_frame);
}

TEST(Auto, LeavesUntouchedJointsBitwiseAlone) {
  Take noisy = damaged(take("wave", 3), 1.5, 0.004, 12);
  const Take truth = take("wave", 3);
  // The fingers are exact, as from a glove.
  std::vector<std::size_t> exact;
  for (std::size_t j = 0; j < noisy.joint_count(); ++j) {
    if (noisy.skeleton.names[j].find("Hand") == std::string::npos) continue;
    exact.push_back(j);
    for (std::size_t f = 0; f < noisy.frame_count(); ++f)
      noisy.rotation(f, j) = truth.rotation(f, j);
  }
  ASSERT_FALSE(exact.empty());
  const Take result = cleaned(noisy, "auto");
  for (const std::size_t j : exact) {
    for (std::size_t f = 0; f < noisy.frame_count(); ++f) {
      ASSERT_EQ(noisy.rotation(f, j), result.rotation(f, j))
          << noisy.skeleton.names[j] << ", frame " << f;
    }
  }
}

TEST(Auto, UsesTheRateOfTheFile) {
  const double at_60 = [] {
    const Take truth = take("walk", 5, 60);
    return figures(truth, cleaned(damaged(truth, 1.5, 0.004, 1), "auto")).rms;
  }();
  const double at_240 = [] {
    const Take truth = take("walk", 5, 240);
    return figures(truth, cleaned(damaged(truth, 1.5, 0.004, 1), "auto")).rms;
  }();
  EXPECT_LT(at_60, 1.4);
  EXPECT_LT(at_240, 0.75 * at_60) << "four times the samples of one motion leave less noise";
}

TEST(Auto, KeepsATPoseOutOfTheMotion) {
  SynthOptions options;
  options.duration_s = 3;
  options.t_pose_first = true;
  const Take truth = synthesize(options);
  ASSERT_EQ(leading_calibration_frames(truth), 1U);
  const Take noisy = damaged(truth, 1.5, 0.004, 1);
  const CleanResult with_pose = clean_take(noisy, *make_cleaner("auto"));
  const CleanResult without_pose =
      clean_take(slice(noisy, 1, noisy.frame_count()), *make_cleaner("auto"));
  EXPECT_EQ(with_pose.report.calibration_frames, 1U);
  EXPECT_EQ(geodesic_rms_deg(slice(with_pose.take, 1, noisy.frame_count()), without_pose.take),
            0.0);
}

// The largest angle between two clips over all joints in frames `first` to `last`, degrees.
double largest_difference(const Take& a, const Take& b, std::size_t first, std::size_t last) {
  double largest = 0;
  for (std::size_t f = first; f < last; ++f) {
    for (std::size_t j = 0; j < a.joint_count(); ++j) {
      largest = std::max(largest, angle_between(a.rotation(f, j), b.rotation(f, j)));
    }
  }
  return largest * degrees_per_radian;
}

TEST(Auto, KeepsAFrozenFirstFrameOutOfTheMotion) {
  // The recorder wrote the last pose of the previous take into the first frame.
  const Take truth = take("walk", 4);
  const Take noisy = damaged(truth, 1.5, 0, 21);
  Take with_stale_frame = noisy;
  for (std::size_t j = 0; j < truth.joint_count(); ++j) {
    with_stale_frame.rotation(0, j) = exp({0.5, 0.2 * static_cast<double>(j % 5), -0.4});
  }
  const Take expected = cleaned(noisy, "auto"), result = cleaned(with_stale_frame, "auto");
  EXPECT_LT(largest_difference(expected, result, 1, 20), 6);
  EXPECT_LT(largest_difference(expected, result, 20, truth.frame_count()), 0.7);
  const auto part = [](const Take& clip) { return slice(clip, 1, clip.frame_count()); };
  EXPECT_LT(figures(part(truth), part(result)).rms,
            1.05 * figures(part(truth), part(expected)).rms);
}

TEST(Auto, RepairsManySpikesInAnOtherwiseCleanTake) {
  const Take truth = take("walk", 5);
  for (const double share : {0.001, 0.004, 0.01, 0.02}) {
    Take spiked = truth;
    Random random(3);
    apply_damage(spiked, "outliers", {{"share", share}, {"std_deg", 25.0}}, random);
    const Take result = cleaned(spiked, "auto");
    EXPECT_GT(figures(truth, spiked).rms, 1.0);
    EXPECT_LT(figures(truth, result).rms, 0.1) << "share " << share;
  }
}

TEST(Auto, LeavesToesThatLeaveTheGroundAloneAtLowRates) {
  for (const double rate_hz : {30.0, 60.0}) {
    const Take truth = take("run", 10, rate_hz);
    EXPECT_LT(figures(truth, cleaned(truth, "auto")).rms, 0.05) << rate_hz;
  }
}

TEST(Auto, RepairsWhatGoesFarBeyondTheHabitOfAToe) {
  const Take truth = take("run", 10, 60);
  Take thrown = truth;
  const auto toe = static_cast<std::size_t>(truth.skeleton.find("LeftToeBase"));
  const auto knee = static_cast<std::size_t>(truth.skeleton.find("LeftLeg"));
  for (std::size_t f = 40; f < 560; f += 40) {
    if (f % 120 == 0) thrown.rotation(f, toe) = thrown.rotation(f, toe) * exp({1.6, 0, 0});
    thrown.rotation(f + 9, knee) = thrown.rotation(f + 9, knee) * exp({0, 1.2, 0});
  }
  EXPECT_LT(figures(truth, cleaned(thrown, "auto")).rms, 0.6 * figures(truth, thrown).rms);
}

TEST(Auto, SurvivesTheShortestTakes) {
  const Take walk = damaged(take("walk"), 1.5, 0.004, 1);
  for (const std::size_t frames : {1U, 2U, 3U, 4U, 5U, 8U, 13U, 30U}) {
    const Take result = cleaned(slice(walk, 0, frames), "auto");
    EXPECT_NO_THROW(result.validate());
    EXPECT_EQ(result.frame_count(), frames);
  }
}

}  // namespace
}  // namespace kinemend::quality
