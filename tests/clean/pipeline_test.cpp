// Tests of the pipeline on joints: strength, limits, selection, range and report.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "registry/takes.hpp"
#include "translations.hpp"

namespace kinemend::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// Turns every selected joint by `turn` in its own frame and moves positions by `shift`.
class Turner final : public Cleaner {
 public:
  explicit Turner(Vec3 turn, Vec3 shift = {}) : turn_(turn), shift_(shift) {}
  std::string_view name() const override { return "turner"; }
  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>&) const override {
    for (std::size_t n = 0; n < take.tracks.size(); ++n) {
      const Track& track = take.tracks[n];
      if (n < take.owners && !track.selected) continue;
      CleanedTrack cleaned{rotations_of(track), positions_of(track), {}};
      for (Quat& q : cleaned.rotations) q = q * exp(turn_);
      for (Vec3& p : cleaned.positions) p += shift_;
      if (n < actions.size()) cleaned.actions = actions[n];
      sink(n, std::move(cleaned));
    }
    return trace;
  }
  CleanTrace trace;
  std::vector<std::vector<Action>> actions;

 private:
  Vec3 turn_, shift_;
};

double change_deg(const Take& a, const Take& b, std::size_t frame, std::size_t joint) {
  return angle_between(a.rotation(frame, joint), b.rotation(frame, joint)) * degrees_per_radian;
}

std::string message_of(const Take& clip, const CleanSettings& settings) {
  try {
    clean_take(clip, Turner({}), settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

TEST(Pipeline, BlendsByStrengthAlongTheGeodesic) {
  const Take input = moving_take(10, 120);
  CleanSettings settings;
  settings.strength = 0.25;
  const Take output = clean_take(input, Turner({0.4, 0, 0}, {8, 0, 0}), settings).take;
  const Quat expected = input.rotation(3, 1) * exp({0.1, 0, 0});
  EXPECT_LT(angle_between(output.rotation(3, 1), expected), 1e-12);
  EXPECT_NEAR(output.root_position(3).x, input.root_position(3).x + 2, 1e-12);
  EXPECT_NEAR(output.position(3, 1).x, input.position(3, 1).x + 2, 1e-12);
}

TEST(Pipeline, LimitsTheChangeOfRotationsOfEveryNumberOfAxes) {
  const Take input = moving_take(10, 120);
  CleanSettings settings;
  settings.max_change_deg = 3;
  const Take output = clean_take(input, Turner({0.3, -0.2, 0.1}), settings).take;
  EXPECT_NEAR(change_deg(input, output, 2, 1), 3, 1e-9);
  EXPECT_NEAR(change_deg(input, output, 2, 3), 3, 1e-9);  // a hinge
  EXPECT_LE(change_deg(input, output, 2, 4), 3 + 1e-9);   // a saddle
  EXPECT_GT(change_deg(input, output, 2, 4), 2.9);
  settings.max_change_deg = 0;
  EXPECT_EQ(clean_take(input, Turner({0.3, -0.2, 0.1}), settings).take.rotations, input.rotations);
}

TEST(Pipeline, TheRotationsOfHingesAndSaddlesAreOnesTheirChannelsHold) {
  const Take input = moving_take(50, 120);
  const Take output = clean_take(input, Turner({0.3, -0.2, 0.1})).take;
  for (std::size_t f = 0; f < 50; ++f) {
    for (const std::size_t j : {3, 4}) {
      const RotationOrder order = input.skeleton.rotation_order(j);
      const Quat held = from_euler(to_euler(output.rotation(f, j), order), order);
      ASSERT_LT(angle_between(held, output.rotation(f, j)), 1e-9);
      ASSERT_GT(change_deg(input, output, f, j), 1);
    }
    // A joint without rotation channels never changes.
    ASSERT_EQ(output.rotation(f, 5), input.rotation(f, 5));
  }
}

TEST(Pipeline, SamplesThatHardlyChangeKeepTheirExactValue) {
  const Take input = moving_take(10, 120);
  const double tiny = 0.9e-9 * radians_per_degree;
  const CleanResult kept = clean_take(input, Turner({tiny, 0, 0}, {1e-11, 0, 0}));
  EXPECT_EQ(kept.take.rotations, input.rotations);
  EXPECT_EQ(kept.take.positions, input.positions);
  EXPECT_THAT(kept.report.spans, IsEmpty());
  const CleanResult changed = clean_take(input, Turner({20 * tiny, 0, 0}));
  EXPECT_NE(changed.take.rotation(4, 1), input.rotation(4, 1));
  EXPECT_EQ(changed.report.tracks[1].frames_changed, 10U);
}

TEST(Pipeline, PatternsChooseJointsAndTheRest) {
  const Take input = moving_take(5, 120);
  CleanSettings settings;
  settings.joints = {"Left*", "Spine"};
  settings.exclude = {"*Saddle"};
  const Take output = clean_take(input, Turner({0.1, 0, 0}, {1, 0, 0}), settings).take;
  std::vector<bool> changed;
  for (std::size_t j = 0; j < input.joint_count(); ++j) {
    changed.push_back(output.rotation(2, j) != input.rotation(2, j));
  }
  EXPECT_THAT(changed, ElementsAre(false, true, true, true, false, false, false));
  EXPECT_EQ(output.positions, input.positions);  // selected only with joint 0
}

TEST(Pipeline, TheRootPositionMayBeLeftAlone) {
  const Take input = moving_take(5, 120);
  CleanSettings settings;
  settings.root_position = false;
  const Take output = clean_take(input, Turner({0.1, 0, 0}, {1, 0, 0}), settings).take;
  EXPECT_EQ(point_track(output, 0), point_track(input, 0));
  EXPECT_NE(output.rotation(0, 0), input.rotation(0, 0));
  EXPECT_NE(point_track(output, 1), point_track(input, 1));
}

TEST(Pipeline, PositionsWithoutAChannelStay) {
  Take input = moving_take(5, 120);
  input.skeleton.channels[0] = {Channel::y_position, Channel::z_rotation, Channel::x_rotation,
                                Channel::y_rotation};
  const Take output = clean_take(input, Turner({0.1, 0, 0}, {1, 2, 3})).take;
  EXPECT_EQ(output.root_position(2).x, input.root_position(2).x);
  EXPECT_EQ(output.root_position(2).y, input.root_position(2).y + 2);
  EXPECT_EQ(output.root_position(2).z, input.root_position(2).z);
}

TEST(Pipeline, ARangeChangesNothingOutsideAndFadesInOverATenthOfASecond) {
  const Take input = moving_take(200, 100);
  CleanSettings settings;
  settings.range = {50, 149};
  const Take output = clean_take(input, Turner({0.2, 0, 0}), settings).take;
  const double whole = 0.2 * degrees_per_radian;
  EXPECT_EQ(output.rotation(49, 1), input.rotation(49, 1));
  EXPECT_EQ(output.rotation(150, 1), input.rotation(150, 1));
  EXPECT_GT(change_deg(input, output, 50, 1), 0);
  EXPECT_LT(change_deg(input, output, 50, 1), 0.1 * whole);
  EXPECT_NEAR(change_deg(input, output, 60, 1), whole, 1e-9);
  EXPECT_NEAR(change_deg(input, output, 139, 1), whole, 1e-9);
  for (std::size_t f = 50; f < 60; ++f) {
    EXPECT_LT(change_deg(input, output, f, 1), change_deg(input, output, f + 1, 1) + 1e-9);
    EXPECT_NEAR(change_deg(input, output, f, 1), change_deg(input, output, 199 - f, 1), 1e-9);
  }
}

TEST(Pipeline, ARangeThatReachesAnEndOfTheTakeDoesNotFadeThere) {
  const Take input = moving_take(100, 100);
  CleanSettings settings;
  settings.range = {0, 99};
  const Take output = clean_take(input, Turner({0.2, 0, 0}), settings).take;
  EXPECT_NEAR(change_deg(input, output, 0, 1), 0.2 * degrees_per_radian, 1e-9);
  EXPECT_NEAR(change_deg(input, output, 99, 1), 0.2 * degrees_per_radian, 1e-9);
  settings.range = {40, 40};
  const Take one = clean_take(input, Turner({0.2, 0, 0}), settings).take;
  EXPECT_EQ(one.rotation(39, 1), input.rotation(39, 1));
  EXPECT_NE(one.rotation(40, 1), input.rotation(40, 1));
}

TEST(Pipeline, RefusesSettingsOutOfRange) {
  const Take clip = moving_take(10, 120);
  CleanSettings settings;
  settings.strength = 1.5;
  EXPECT_THAT(message_of(clip, settings), HasSubstr("strength: 1.5 is outside 0 to 1"));
  settings = {};
  settings.max_change_deg = std::nan("");
  EXPECT_THAT(message_of(clip, settings), HasSubstr("max_change_deg"));
  settings = {};
  settings.joints = {"Tail*"};
  EXPECT_THAT(message_of(clip, settings), HasSubstr("no joint matches \"Tail*\""));
  settings = {};
  settings.exclude = {"Tail"};
  EXPECT_THAT(message_of(clip, settings), HasSubstr("no joint matches \"Tail\""));
  settings = {};
  settings.range = {5, 10};
  EXPECT_THAT(message_of(clip, settings), HasSubstr("frames 5 to 10"));
  settings.range = {6, 5};
  EXPECT_THAT(message_of(clip, settings), HasSubstr("frames 6 to 5"));
}

TEST(Report, SaysWhatWasDoneWhereAndByHowMuch) {
  const Take input = moving_take(30, 120);
  Turner cleaner({0, 0.1, 0}, {0, 0, 2});
  cleaner.actions.resize(input.joint_count());
  cleaner.actions[1].assign(30, Action::kept);
  for (const std::size_t f : {10, 11, 20}) cleaner.actions[1][f] = Action::despiked;
  cleaner.trace.noise.assign(2 + input.joint_count(), 0.5);
  cleaner.trace.warnings = {"a warning"};
  CleanSettings settings;
  settings.joints = {"Spine", "Hips"};
  const CleanReport report = clean_take(input, cleaner, settings).report;
  EXPECT_EQ(report.method, "turner");
  EXPECT_EQ(report.frames, 30U);
  EXPECT_EQ(report.calibration_frames, 0U);
  EXPECT_EQ(report.frame_rate_hz, 120);
  ASSERT_THAT(report.tracks, SizeIs(7));
  const TrackSummary& spine = report.tracks[1];
  EXPECT_EQ(spine.name, "Spine");
  EXPECT_NE(spine.noise, 0.5) << "it is measured, and not the method's";
  EXPECT_NEAR(spine.rms_change, 0.1 * degrees_per_radian, 1e-9);
  EXPECT_NEAR(spine.max_change, 0.1 * degrees_per_radian, 1e-9);
  EXPECT_EQ(spine.frames_changed, 30U);
  EXPECT_EQ(spine.frames_repaired, 3U);
  EXPECT_EQ(report.tracks[2].frames_changed, 0U);
  EXPECT_NEAR(report.root_rms_change, 2, 1e-12);
  EXPECT_NEAR(report.root_max_change, 2, 1e-12);
  EXPECT_THAT(report.warnings, ElementsAre("a warning"));

  struct Row {
    std::int32_t joint;
    std::size_t first, last;
    Action action;
    bool operator==(const Row&) const = default;
  };
  std::vector<Row> rows;
  for (const ReportSpan& s : report.spans) {
    rows.push_back({s.joint, s.first_frame, s.last_frame, s.action});
    EXPECT_NEAR(s.max_change, s.joint < 0 ? 2 : 0.1 * degrees_per_radian, 1e-9);
    EXPECT_NEAR(s.rms_change, s.max_change, 1e-9);
  }
  EXPECT_THAT(rows, ElementsAre(Row{-1, 0, 29, Action::denoised}, Row{0, 0, 29, Action::denoised},
                                Row{1, 0, 9, Action::denoised}, Row{1, 10, 11, Action::despiked},
                                Row{1, 12, 19, Action::denoised}, Row{1, 20, 20, Action::despiked},
                                Row{1, 21, 29, Action::denoised}));
}

TEST(Report, CountsFramesFromTheTakesFirstAlsoBehindACalibrationPose) {
  Take input = moving_take(30, 120);
  for (std::size_t j = 0; j < input.joint_count(); ++j) input.rotation(0, j) = {};
  ASSERT_EQ(leading_calibration_frames(input), 1U);
  const CleanResult result = clean_take(input, Turner({0, 0.1, 0}));
  EXPECT_EQ(result.report.calibration_frames, 1U);
  EXPECT_EQ(result.report.spans.front().first_frame, 1U);
  EXPECT_EQ(result.report.spans.front().last_frame, 29U);
  EXPECT_EQ(result.take.rotation(0, 1), input.rotation(0, 1));
  EXPECT_EQ(result.take.source.document, input.source.document);
}

// The joint rests, turns by 90 degrees in a tenth of a second, and rests again.
Take punch() {
  Take clip = empty_take(240, 120);
  for (std::size_t f = 0; f < 240; ++f) {
    const double x = std::clamp((static_cast<double>(f) - 120) / 12, 0.0, 1.0);
    clip.rotation(f, 2) = exp({0, x * x * (3 - 2 * x) * pi / 2, 0});
  }
  return clip;
}

double fastest_step_deg_s(const Take& clip, std::size_t joint) {
  double largest = 0;
  for (std::size_t f = 1; f < clip.frame_count(); ++f) {
    largest =
        std::max(largest, angle_between(clip.rotation(f - 1, joint), clip.rotation(f, joint)));
  }
  return largest * clip.frame_rate_hz * degrees_per_radian;
}

TEST(Report, GivesThePeakSpeedsOfACleanTakeFrameByFrame) {
  const Take input = punch();
  const CleanResult result = clean_take(input, *make_butterworth({.cutoff_hz = 3}));
  const TrackSummary& arm = result.report.tracks[2];
  EXPECT_EQ(arm.peak_frames, 1U);
  EXPECT_NEAR(arm.peak_speed_before, fastest_step_deg_s(input, 2), 1e-6);
  EXPECT_NEAR(arm.peak_speed_after, fastest_step_deg_s(result.take, 2), 1e-6);
  EXPECT_LT(arm.peak_speed_after, 0.7 * arm.peak_speed_before);
}

TEST(Report, WarnsOfALostPeakAndOfNothingElse) {
  const Take input = punch();
  EXPECT_THAT(clean_take(input, *make_butterworth({.cutoff_hz = 3})).report.warnings,
              ElementsAre(HasSubstr("LeftArm: peak speed falls from"),
                          HasSubstr("LeftArm: smoothing changes it by ")));
  EXPECT_THAT(clean_take(input, *make_butterworth({.cutoff_hz = 20})).report.warnings, IsEmpty());
  CleanSettings settings;
  settings.peak_loss_limit = 0.9;
  EXPECT_THAT(clean_take(input, *make_butterworth({.cutoff_hz = 3}), settings).report.warnings,
              ElementsAre(HasSubstr("LeftArm: smoothing changes it by ")));
}

TEST(Report, DoesNotTakeNoiseOrSpikesForPeaks) {
  Take input = punch();
  add_noise(input, 1, 0.1, 4);
  for (const std::size_t f : {30, 70, 190})
    input.rotation(f, 2) = input.rotation(f, 2) * exp({1.6, 0, 0});
  const CleanResult fine = clean_take(input, *make_butterworth({.cutoff_hz = 12}));
  // Smearing a spike does not count as losing a peak.
  EXPECT_THAT(fine.report.warnings, ElementsAre(HasSubstr("LeftArm: smoothing changes it by ")));
  const TrackSummary& arm = fine.report.tracks[2];
  EXPECT_GT(arm.peak_frames, 1U);
  EXPECT_NEAR(arm.peak_speed_before, fastest_step_deg_s(punch(), 2), 200);
  EXPECT_THAT(clean_take(input, *make_butterworth({.cutoff_hz = 3})).report.warnings,
              Contains(HasSubstr("LeftArm: peak speed falls from")));
}

}  // namespace
}  // namespace kinemend::test
