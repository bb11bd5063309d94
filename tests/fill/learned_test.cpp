// Tests of gaps filled by models that give a fixed answer.
#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "fill/made_gaps.hpp"
#include "fill/marker_takes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "motion/clips.hpp"

namespace kinemend::fill {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* unknown = "the model does not know them";

const Quat said = exp(Vec3{0.3, -0.2, 0.1});

// A model that gives every missing sample the same rotation and does not know joint4.
LearnedFilling same_everywhere(const Take& clip) {
  LearnedFilling filling{clip.rotations, {}};
  for (std::size_t i = 0; i < filling.rotations.size(); ++i) {
    if (!clip.observed.empty() && clip.observed[i] == 0) filling.rotations[i] = said;
  }
  filling.left_out.assign(clip.joint_count(), "");
  filling.left_out[track_of(clip, "joint4")] = unknown;
  return filling;
}

FillSettings by_model() {
  FillSettings settings;
  settings.method = "recurrent";
  settings.models.recurrent = same_everywhere;
  return settings;
}

Take gapped() {
  Take clip = test::moving_chain(6, 500);
  hide(clip, "joint1", 200, 260);
  hide(clip, "joint3", 300, 320);
  hide(clip, "joint4", 300, 312);
  return clip;
}

TEST(LearnedFilling, HasWhatTheModelSays) {
  Take clip = gapped();
  const FillReport report = fill_gaps(clip, by_model());
  ASSERT_EQ(report.gaps.size(), 3u);
  const std::size_t joint = track_of(clip, "joint1");
  for (const std::size_t f : {200u, 230u, 260u})
    EXPECT_LT(angle_between(clip.rotation(f, joint), said), 1e-9) << f;
  EXPECT_EQ(report.gaps[0].method, "recurrent");
  EXPECT_EQ(report.gaps[1].method, "recurrent");
}

TEST(LearnedFilling, LeavesToAutoWhatTheModelDoesNotKnowAndSaysSo) {
  Take clip = gapped(), automatic = gapped();
  const FillReport report = fill_gaps(clip, by_model());
  fill_gaps(automatic);
  EXPECT_NE(report.gaps[2].method, "recurrent");
  EXPECT_TRUE(report.gaps[2].filled);
  const std::size_t joint = track_of(clip, "joint4");
  for (std::size_t f = 300; f <= 312; ++f)
    EXPECT_EQ(clip.rotation(f, joint), automatic.rotation(f, joint)) << f;
  EXPECT_THAT(report.warnings,
              ElementsAre("1 gap left to auto (joint4): the model does not know them"));
}

TEST(LearnedFilling, IsRefusedWhereTheGapIsTooLong) {
  Take clip = test::moving_chain(6, 500);
  hide(clip, "joint1", 100, 300);
  FillSettings settings = by_model();
  settings.longest_gap_s = 0.5;
  const FillReport report = fill_gaps(clip, settings);
  EXPECT_EQ(report.filled(), 0u);
  EXPECT_THAT(report.gaps[0].reason, HasSubstr("is longer than the 0.5 s that recurrent may fill"));
  settings.fill_all = true;
  EXPECT_EQ(fill_gaps(clip, settings).filled(), 1u);
}

TEST(LearnedFilling, ComesAgainByThePlanOfItsRun) {
  Take clip = gapped(), again = gapped();
  const PlannedFill made = fill_with_plan(clip, by_model());
  EXPECT_EQ(made.plan[0].method, "recurrent");
  const std::string text = plan_csv(gapped(), made.plan);
  fill_with_plan(again, parse_plan(text, "plan.csv", gapped()), {}, {same_everywhere});
  EXPECT_EQ(again.rotations, clip.rotations);
  EXPECT_EQ(again.observed, clip.observed);
}

TEST(LearnedFilling, StandsInPreviewsWhereThereIsAModel) {
  Take clip = gapped();
  std::vector<PlannedGap> plan = fill_with_plan(clip, FillSettings{}).plan;
  const auto by_recurrent = [&] {
    std::vector<GapPreview> found;
    for (const GapPreview& preview : plan[0].previews) {
      if (preview.method == "recurrent") found.push_back(preview);
    }
    return found;
  };
  preview_methods(gapped(), plan);
  EXPECT_THAT(by_recurrent(), IsEmpty());
  preview_methods(gapped(), plan, {}, {same_everywhere});
  ASSERT_EQ(by_recurrent().size(), 1u);
  EXPECT_TRUE(by_recurrent()[0].filled);
  EXPECT_EQ(preview_curves(gapped(), plan, 0, {}, {same_everywhere}).curves.back().preview.method,
            "recurrent");
}

// The model gets the suspected sample as missing; its prediction then shows that the sample is a
// spike.
TEST(LearnedFilling, IsNotMadeFromASpikeBesideTheGap) {
  constexpr std::size_t frames = 1200, first = 600, last = 620;
  const Take truth = test::moving_chain(6, frames);
  Take clip = truth;
  hide(clip, "joint3", first, last);
  const std::size_t joint = track_of(clip, "joint3");
  clip.rotation(first - 1, joint) = clip.rotation(first - 1, joint) * exp(Vec3{1.2, 0, 0});
  // This model predicts the motion correctly, except when it sees the spike.
  FillSettings settings = by_model();
  std::size_t whole_frames = 0;
  settings.models.recurrent = [&](const Take& seen) {
    LearnedFilling filling{seen.rotations, {}};
    filling.left_out.assign(seen.joint_count(), "");
    const bool is_whole = seen.frame_count() == frames;
    if (is_whole) ++whole_frames;
    const std::size_t from = is_whole ? 0 : first - 2 - 401;
    const bool sees_spike = seen.is_observed(first - 1 - from, joint);
    for (std::size_t f = 0; f < seen.frame_count(); ++f)
      filling.rotations[f * seen.joint_count() + joint] =
          sees_spike ? said : truth.rotation(f + from, joint);
    return filling;
  };
  fill_gaps(clip, settings);
  EXPECT_EQ(whole_frames, 1u);
  for (std::size_t f = first; f <= last; ++f)
    EXPECT_LT(angle_between(clip.rotation(f, joint), truth.rotation(f, joint)), 1e-6) << f;
}

// A model that predicts the motion up to a rotation that grows over the take.
LearnedFill drifting(const Take& truth) {
  return [&truth](const Take& seen) {
    LearnedFilling filling{truth.rotations, {}, true};
    filling.left_out.assign(seen.joint_count(), "");
    for (std::size_t i = 0; i < filling.rotations.size(); ++i) {
      const auto frame = static_cast<double>(i / seen.joint_count());
      filling.rotations[i] = filling.rotations[i] * exp(Vec3{0.02 + 0.00004 * frame, 0, 0});
    }
    return filling;
  };
}

TEST(GuessedFilling, IsMovedToMeetTheSamplesBesideTheGap) {
  const Take truth = test::moving_chain(6, 500);
  Take clip = truth;
  hide(clip, "joint3", 300, 400);
  FillSettings settings;
  settings.method = "learned";
  settings.models.learned = drifting(truth);
  const FillReport report = fill_gaps(clip, settings);
  ASSERT_EQ(report.filled(), 1u);
  EXPECT_EQ(report.gaps[0].method, "learned");
  const std::size_t joint = track_of(clip, "joint3");
  for (std::size_t f = 300; f <= 400; ++f)
    EXPECT_LT(angle_between(clip.rotation(f, joint), truth.rotation(f, joint)), 0.01) << f;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (std::size_t j = 0; j < truth.joint_count(); ++j) {
      if (j == joint && f >= 300 && f <= 400) continue;
      EXPECT_EQ(clip.rotation(f, j), truth.rotation(f, j)) << f << " " << j;
    }
  }
}

TEST(GuessedFilling, IsRefusedInGapsOfMoreThanTwoSeconds) {
  const Take truth = test::moving_chain(6, 500);
  Take clip = truth;
  hide(clip, "joint1", 100, 299);
  hide(clip, "joint3", 100, 300);
  FillSettings settings;
  settings.method = "learned";
  settings.models.learned = drifting(truth);
  const FillReport report = fill_gaps(clip, settings);
  EXPECT_TRUE(report.gaps[0].filled);
  EXPECT_FALSE(report.gaps[1].filled);
  EXPECT_THAT(report.gaps[1].reason, HasSubstr("is longer than the 2 s that learned may fill"));
}

TEST(GuessedFilling, StandsBesideAnotherModelInOnePlan) {
  const Take truth = test::moving_chain(6, 500);
  Take clip = gapped();
  std::vector<PlannedGap> plan = fill_with_plan(clip, by_model()).plan;
  ASSERT_EQ(plan.size(), 3u);
  plan[1].method = "learned";
  Take both = gapped();
  const FillReport report =
      fill_with_plan(both, plan, {}, {same_everywhere, drifting(truth)}).report;
  EXPECT_EQ(report.gaps[0].method, "recurrent");
  EXPECT_EQ(report.gaps[1].method, "learned");
  const std::size_t first = track_of(clip, "joint1"), second = track_of(clip, "joint3");
  EXPECT_LT(angle_between(both.rotation(230, first), said), 1e-9);
  EXPECT_LT(angle_between(both.rotation(310, second), truth.rotation(310, second)), 0.02);
}

TEST(LearnedFilling, NeedsAModelAndSaysHowToMakeOne) {
  Take clip = gapped();
  FillSettings settings;
  settings.method = "recurrent";
  try {
    fill_gaps(clip, settings);
    FAIL() << "was filled";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("kinemend-train paper --network ebd"));
  }
  std::vector<PlannedGap> plan = fill_with_plan(clip, by_model()).plan;
  Take other = gapped();
  EXPECT_THROW(fill_with_plan(other, plan), Error);
}

TEST(LearnedFilling, IsRefusedOfMarkersWithTheReason) {
  Take markers = marker_take("walk", 1, 0.2);
  FillSettings settings = by_model();
  try {
    fill_gaps(markers, settings);
    FAIL() << "was filled";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("this is a take of markers"));
  }
}

}  // namespace
}  // namespace kinemend::fill
