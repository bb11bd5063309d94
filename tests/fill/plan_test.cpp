// Tests of gap plans: a plan written by a run is read back and applied.
#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "fill/made_gaps.hpp"
#include "fill/marker_takes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "motion/clips.hpp"

namespace kinemend::fill {
namespace {

using testing::HasSubstr;

Take markers_with_gaps() {
  Take clip = marker_take("walk", 4, 0.8);
  hide(clip, "LeftLeg_b", 200, 223);
  hide(clip, "LeftLeg_c", 210, 250);
  hide(clip, "Head_a", 0, 5);
  hide(clip, "LeftFoot_a", 210, 240);
  // This gap is too long for any method, because no marker is observed.
  for (const std::string& name : clip.names) hide(clip, name, 300, 420);
  return clip;
}

Take joints_with_gaps() {
  Take clip = test::moving_chain(6, 500);
  hide(clip, "joint1", 200, 223);
  hide(clip, "joint3", 410, 417);
  hide(clip, "root", 210, 214);
  return spoilt(clip);
}

bool are_same(const Take& a, const Take& b) {
  return a.rotations == b.rotations && a.positions == b.positions && a.observed == b.observed &&
         a.observed_positions == b.observed_positions && a.residuals == b.residuals;
}

std::string complaint(const std::string& text, const Take& clip) {
  try {
    parse_plan(text, "plan.csv", clip);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.what();
  }
  return "";
}

void expect_same_after_plan(const Take& damaged, const FillSettings& settings) {
  Take filled = damaged, planned = damaged;
  const FillReport report = fill_gaps(filled, settings);
  const PlannedFill made = fill_with_plan(planned, settings);
  EXPECT_TRUE(are_same(planned, filled));
  for (const bool as_json : {false, true}) {
    const std::string text = as_json ? plan_json(damaged, made.plan) : plan_csv(damaged, made.plan);
    std::vector<PlannedGap> plan = parse_plan(text, "plan", damaged);
    ASSERT_EQ(plan.size(), report.gaps.size());
    // The order of rows has no effect.
    std::reverse(plan.begin(), plan.end());
    Take applied = damaged;
    const PlannedFill again = fill_with_plan(applied, plan);
    EXPECT_TRUE(are_same(applied, filled)) << settings.method << text;
    EXPECT_EQ(again.report.filled(), report.filled());
    for (std::size_t g = 0; g < report.gaps.size(); ++g) {
      EXPECT_EQ(again.report.gaps[g].reason, report.gaps[g].reason);
      EXPECT_EQ(again.report.gaps[g].method, report.gaps[g].method);
    }
  }
}

TEST(GapPlan, GivesTheSameSamplesAsTheRunThatWroteIt) {
  for (const FillMethod& method : fill_methods()) {
    if (method.learned) continue;
    for (const bool fill_all : {false, true}) {
      FillSettings settings;
      settings.method = method.name;
      settings.fill_all = fill_all;
      settings.longest_gap_s = method.name == "spline" ? 0.3 : 0;
      if (method.joints) expect_same_after_plan(joints_with_gaps(), settings);
      if (method.name == "pattern") settings.donor = "LeftLeg_a";
      if (method.markers) expect_same_after_plan(markers_with_gaps(), settings);
    }
  }
}

TEST(GapPlan, DoesForEachGapWhatItsRowSays) {
  const Take damaged = markers_with_gaps();
  const std::string text =
      "name,first_frame,last_frame,method,verdict,donor\n"
      "LeftLeg_b,201,224,spline,fill,\n"
      "\"LeftFoot_a\",211,241,pattern,fill,LeftFoot_b\n"
      "LeftLeg_c,211,251,auto,refuse,\n"
      "Head_a,1,6,spline,force,\n";
  Take clip = damaged;
  const PlannedFill made = fill_with_plan(clip, parse_plan(text, "plan.csv", damaged));
  ASSERT_EQ(made.plan.size(), 4u);
  // The same method, applied to that gap only, gives the same result.
  for (const auto& [name, method, donor] :
       {std::tuple("LeftLeg_b", "spline", ""), std::tuple("LeftFoot_a", "pattern", "LeftFoot_b")}) {
    Take alone = damaged;
    FillSettings settings;
    settings.method = method;
    settings.names = {name};
    settings.donor = donor;
    settings.range = {200, 250};
    ASSERT_EQ(fill_gaps(alone, settings).filled(), 1u) << name;
    const std::size_t marker = track_of(clip, name);
    for (std::size_t f = 200; f < 250; ++f)
      EXPECT_EQ(clip.position(f, marker), alone.position(f, marker));
  }
  EXPECT_FALSE(clip.is_observed(220, track_of(clip, "LeftLeg_c")));
  EXPECT_TRUE(clip.is_observed(2, track_of(clip, "Head_a")));
  // Gaps without a row stay open.
  EXPECT_FALSE(clip.is_observed(350, track_of(clip, "Head_a")));
  for (const GapOutcome& gap : made.report.gaps) {
    EXPECT_EQ(gap.reason, gap.filled ? "" : "the plan refuses it");
  }
}

TEST(GapPlan, SaysWhichMarkersAGapWasFilledFrom) {
  Take clip = marker_take("walk", 4, 0.8);
  hide(clip, "LeftLeg_b", 200, 240);
  Take by_donor = clip;
  const PlannedFill made = fill_with_plan(clip, FillSettings{});
  ASSERT_EQ(made.plan.size(), 1u);
  EXPECT_THAT(made.plan[0].evidence, testing::Contains("LeftLeg_a"));
  FillSettings settings;
  settings.method = "pattern";
  settings.donor = "LeftLeg_c";
  EXPECT_THAT(fill_with_plan(by_donor, settings).plan[0].evidence,
              testing::ElementsAre("LeftLeg_c"));
}

TEST(GapPlan, PreviewsEveryMethodBesideWhatFillsTheGap) {
  Take clip = marker_take("walk", 4, 0.8);
  hide(clip, "LeftLeg_b", 200, 215);
  const Take damaged = clip;
  PlannedFill made = fill_with_plan(clip, FillSettings{});
  preview_methods(damaged, made.plan);
  std::size_t seen = 0;
  for (const GapPreview& preview : made.plan[0].previews) {
    Take other = damaged;
    FillSettings settings;
    settings.method = preview.method;
    if (preview.method == "pattern") {
      EXPECT_EQ(preview.reason, "the row names no donor");
      continue;
    }
    const FillReport report = fill_gaps(other, settings);
    EXPECT_EQ(preview.filled, report.filled() == 1) << preview.method;
    if (!preview.filled) continue;
    ++seen;
    EXPECT_NEAR(*preview.distance, rms_error(clip, other, report.gaps[0].gap), 1e-9);
  }
  EXPECT_GT(seen, 4u);
}

// The take filled by the plan after one row gets that method.
Take filled_with(const Take& damaged, std::vector<PlannedGap> plan, std::size_t row,
                 const std::string& method, GapVerdict verdict) {
  plan[row].method = method;
  plan[row].verdict = verdict;
  Take clip = damaged;
  fill_with_plan(clip, plan);
  return clip;
}

TEST(GapPlan, ShowsTheCurvesThatTheRowsMethodsWouldMakeOfMarkers) {
  const Take damaged = markers_with_gaps();
  Take clip = damaged;
  const std::vector<PlannedGap> plan = fill_with_plan(clip, FillSettings{}).plan;
  const std::size_t marker = track_of(clip, "LeftLeg_c");
  std::size_t row = 0;
  while (plan[row].gap.track != marker || plan[row].gap.first_frame != 210) ++row;
  const GapCurves made = preview_curves(damaged, plan, row);
  EXPECT_EQ(made.first_frame, 210u - 41u);
  EXPECT_EQ(made.last_frame, 250u + 41u);
  EXPECT_EQ(made.axes, (std::vector<std::string>{"X", "Y", "Z"}));
  std::size_t drawn = 0, forced = 0;
  for (const GapCurve& curve : made.curves) {
    const std::string& method = curve.preview.method;
    if (method == "pattern") {
      EXPECT_FALSE(curve.values[41 + 4]) << "no donor, no curve";
      continue;
    }
    const GapVerdict verdict = curve.preview.filled ? GapVerdict::fill : GapVerdict::force;
    const Take other = filled_with(damaged, plan, row, method, verdict);
    ASSERT_EQ(curve.values.size(), made.last_frame - made.first_frame + 1);
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      if (!curve.values[i]) continue;
      EXPECT_EQ(*curve.values[i], other.position(made.first_frame + i, marker)) << method;
      drawn += i == 41 + 4;
    }
    forced += !curve.preview.filled && curve.values[41 + 4];
    // Every accepted filling has a curve.
    EXPECT_TRUE(!curve.preview.filled || curve.values[41 + 4]) << method;
  }
  EXPECT_GT(drawn, 5u);
  EXPECT_GT(forced, 0u) << "a long gap that a short method is forced to fill";
  EXPECT_THROW(preview_curves(damaged, plan, plan.size()), Error);
}

TEST(GapPlan, ShowsTheCurvesOfAJointAsAnglesOfTheFileWithoutJumps) {
  const Take damaged = joints_with_gaps();
  Take clip = damaged;
  const std::vector<PlannedGap> plan = fill_with_plan(clip, FillSettings{}).plan;
  std::size_t row = 0;
  while (plan[row].is_position || plan[row].gap.length() != 8) ++row;
  const std::size_t joint = plan[row].gap.track;
  const RotationOrder order = damaged.skeleton.rotation_order(joint);
  const GapCurves made = preview_curves(damaged, plan, row);
  ASSERT_EQ(made.axes.size(), order.count);
  std::size_t filled = 0;
  for (const GapCurve& curve : made.curves) {
    if (!curve.preview.filled) continue;
    ++filled;
    const Take other = filled_with(damaged, plan, row, curve.preview.method, GapVerdict::fill);
    for (std::size_t i = 0; i < curve.values.size(); ++i) {
      const Vec3 angles = (1 / degrees_per_radian) * curve.values[i].value();
      const Quat turned = from_euler({angles.x, angles.y, angles.z}, order);
      EXPECT_LT(angle_between(turned, other.rotation(made.first_frame + i, joint)), 1e-9);
      if (i == 0) continue;
      EXPECT_LT(norm(*curve.values[i] - *curve.values[i - 1]), 90);
    }
  }
  EXPECT_GT(filled, 2u);
}

TEST(GapPlan, LeavesTheTakeAsItWasWhereARunIsEnded) {
  struct Ended {};
  for (const std::size_t calls : {0, 1, 2}) {
    Take markers = markers_with_gaps();
    Take joints = joints_with_gaps();
    const Take markers_before = markers;
    const Take joints_before = joints;
    std::atomic<std::size_t> seen = 0;
    const FillCheck check = [&] {
      if (seen++ >= calls) throw Ended{};
    };
    EXPECT_THROW(fill_with_plan(markers, FillSettings{}, check), Ended);
    EXPECT_TRUE(are_same(markers, markers_before));
    seen = 0;
    EXPECT_THROW(fill_with_plan(joints, FillSettings{}, check), Ended);
    EXPECT_TRUE(are_same(joints, joints_before));
  }
}

TEST(GapPlan, NamesTheLineOfWhatIsWrong) {
  const Take clip = markers_with_gaps();
  const std::string heading = "name,first_frame,last_frame,method,verdict\n";
  const auto after = [&](const std::string& row) { return complaint(heading + row + "\n", clip); };
  EXPECT_EQ(after("Leg,201,224,auto,fill"), "plan.csv:2: the take has no marker \"Leg\"");
  EXPECT_EQ(after("LeftLeg_b,201,230,auto,fill"),
            "plan.csv:2: frames 201 to 230 are no gap of the marker \"LeftLeg_b\": its gaps are "
            "201-224, 301-421");
  EXPECT_THAT(after("LeftLeg_b,201,224,bezier,fill"),
              HasSubstr("plan.csv:2: expected a method for markers (auto, spline"));
  EXPECT_THAT(after("LeftLeg_b,201,224,slerp,fill"), HasSubstr("found \"slerp\""));
  EXPECT_EQ(after("LeftLeg_b,201,224,pattern,fill"),
            "plan.csv:2: the method pattern needs a donor");
  EXPECT_EQ(after("LeftLeg_b,201,224,auto,keep"),
            "plan.csv:2: expected the verdict fill, force or refuse, found \"keep\"");
  EXPECT_EQ(after("LeftLeg_b,201,224,auto,fill\n\n# again\nLeftLeg_b,201,224,spline,fill"),
            "plan.csv:5: the gap of \"LeftLeg_b\" in frames 201 to 224 stands in another row "
            "already");
  EXPECT_EQ(after("LeftLeg_b,first,224,auto,fill"),
            "plan.csv:2: expected a frame number from 1 as first_frame, found \"first\"");
  EXPECT_EQ(after("LeftLeg_b,201"), "plan.csv:2: expected 5 cells as in the heading, found 2");
  EXPECT_EQ(complaint("LeftLeg_b,201,224\n", clip),
            "plan.csv:1: expected a heading with the column name");
  EXPECT_EQ(complaint("name,first_frame,last_frame,methd\n", clip),
            "plan.csv:1: no column of a gap plan is called \"methd\"");
  EXPECT_EQ(complaint("{\n\"gaps\": [\n}", clip),
            "plan.csv:3: this is not valid JSON from here on");
  const std::string nested(1'000'000, '[');
  EXPECT_EQ(complaint("{\n\"gaps\": " + nested, clip),
            "plan.csv:2: JSON is nested more than 64 levels deep");
  EXPECT_EQ(complaint("{\n\"gaps\": [{\"evidence\": " + nested, clip),
            "plan.csv:2: JSON is nested more than 64 levels deep");
  EXPECT_EQ(complaint("{\"schema\": \"kinemend.gap-plan/1\", \"gaps\": [{\"name\": \"LeftLeg_b\", "
                      "\"first_frame\": 1, \"last_frame\": 2}]}",
                      clip),
            "plan.csv: gap 1: frames 1 to 2 are no gap of the marker \"LeftLeg_b\": its gaps are "
            "201-224, 301-421");
}

TEST(GapPlan, TellsTracksOfOneNameApart) {
  Take clip = marker_take("walk", 4, 0.8);
  hide(clip, "LeftLeg_b", 200, 210);
  hide(clip, "LeftLeg_c", 200, 210);
  clip.names[track_of(clip, "LeftLeg_c")] = "LeftLeg_b";
  Take filled = clip;
  const PlannedFill made = fill_with_plan(filled, FillSettings{});
  Take applied = clip;
  fill_with_plan(applied, parse_plan(plan_csv(clip, made.plan), "plan.csv", clip));
  EXPECT_TRUE(are_same(applied, filled));
}

TEST(GapPlan, QuotesNamesThatNeedIt) {
  Take clip = marker_take("walk", 4, 0.8);
  clip.names[track_of(clip, "LeftLeg_b")] = "a, \"b\" #1";
  hide(clip, "a, \"b\" #1", 200, 210);
  Take filled = clip;
  const PlannedFill made = fill_with_plan(filled, FillSettings{});
  const std::string text = plan_csv(clip, made.plan);
  EXPECT_THAT(text, HasSubstr("\n\"a, \"\"b\"\" #1\",position,201,211,11,"));
  EXPECT_EQ(parse_plan(text, "plan.csv", clip).size(), 1u);
}

}  // namespace
}  // namespace kinemend::fill
