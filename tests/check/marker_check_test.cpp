// Each fault injected into a synthetic take of markers is found.
#include <gmock/gmock.h>

#include "check/marker_support.hpp"
#include "check/support.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

TEST(CheckMarkers, FindsNothingInCleanTakes) {
  for (const char* motion : {"walk", "run", "turn", "jump", "wave", "still"})
    EXPECT_EQ(faults_of(check_take(synthetic_markers(motion))), "") << motion;
}

TEST(CheckMarkers, SaysThatTheModelExpectsTheNoiseOfVideo) {
  Take clip = synthetic_markers("walk");
  EXPECT_EQ(doubts_of(check_take(clip)), "");
  Random random(1);
  apply_damage(clip, "system", {{"kind", std::string("video")}}, random);
  const std::vector<Finding> found = of_kind(check_take(clip), FindingKind::expected_noise);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].unit, clip.unit);
}

TEST(CheckMarkers, TellsGapsByMarker) {
  Take clip = synthetic_markers("walk");
  const std::vector<NamedGap> gaps{{"Head", 30, 89}, {"LeftHand", 0, 4}};
  mark_gaps(clip, gaps);
  const CheckReport report = check_take(clip);
  EXPECT_EQ(report.figures.gaps, 2u);
  EXPECT_DOUBLE_EQ(report.figures.longest_gap_s, 0.5);
  EXPECT_EQ(report.tracks[static_cast<std::size_t>(clip.find("Head"))].missing_frames, 60u);
  EXPECT_EQ(of_kind(report, FindingKind::gap)[0].severity, Severity::serious);
}

TEST(CheckMarkers, TellsFrozenAndBridgedSpansInTheSideFile) {
  Take clip = synthetic_markers("walk");
  const auto hand = static_cast<std::size_t>(clip.find("LeftHand")),
             foot = static_cast<std::size_t>(clip.find("RightLeg"));
  for (std::size_t f = 101; f <= 130; ++f) clip.position(f, hand) = clip.position(100, hand);
  for (std::size_t f = 301; f < 340; ++f) {
    const double share = static_cast<double>(f - 300) / 40;
    clip.position(f, foot) =
        (1 - share) * clip.position(300, foot) + share * clip.position(340, foot);
  }
  const CheckReport report = check_take(clip);
  ASSERT_EQ(report.stale.size(), 2u);
  const auto is = [](const NamedGap& gap, const char* name, std::size_t first, std::size_t last) {
    return gap.name == name && gap.first_frame == first && gap.last_frame == last;
  };
  for (const NamedGap& gap : report.stale) {
    EXPECT_TRUE(is(gap, "LeftHand", 101, 130) || is(gap, "RightLeg", 301, 339))
        << gap.name << " " << gap.first_frame << " " << gap.last_frame;
  }
  const std::vector<NamedGap> read = parse_gaps(gaps_text(report.stale, 1), "side file", 1);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[1].name, report.stale[1].name);
  EXPECT_EQ(read[1].first_frame, report.stale[1].first_frame);
}

TEST(CheckMarkers, TellsAMarkerThatLeavesItsSegment) {
  Take clip = synthetic_markers("walk");
  const auto toe = static_cast<std::size_t>(clip.find("Head"));
  EXPECT_TRUE(of_kind(check_take(clip), FindingKind::length).empty());
  for (std::size_t f = 300; f < 360; ++f) clip.position(f, toe) += Vec3{0, 6, 0};
  const std::vector<Finding> found = of_kind(check_take(clip), FindingKind::length);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0].track, "Head");
  EXPECT_EQ(found[0].first_frame, 300u);
  EXPECT_EQ(found[0].last_frame, 359u);
}

TEST(CheckMarkers, NamesSwapsOnceAndNoneOfTheirJumps) {
  const SwapTrial trial = with_random_swaps(synthetic_markers("walk"), 3, 4, 2);
  ASSERT_EQ(trial.swaps.size(), 3u);
  const CheckReport report = check_take(trial.clip);
  EXPECT_EQ(report.figures.swaps, 3u);
  EXPECT_EQ(of_kind(report, FindingKind::swap).size(), 3u);
  EXPECT_EQ(report.figures.spikes, 0u);
  EXPECT_TRUE(of_kind(report, FindingKind::length).empty());
}

TEST(CheckMarkers, DoesNotAskForTheLabelsOfTracksWithoutOne) {
  Take clip = synthetic_markers("walk");
  undo_swaps(clip, {{3, 8, 200, 300}});
  ASSERT_EQ(find_swaps(clip).size(), 1u);
  clip.names[8] = "*8";
  EXPECT_TRUE(find_swaps(clip).empty());
}

TEST(CheckMarkers, TellsAUnitThatMakesAGiant) {
  Take clip = synthetic_markers("walk");
  clip.unit = "m";
  const std::vector<Finding> unit = of_kind(check_take(clip), FindingKind::unit);
  ASSERT_EQ(unit.size(), 1u);
  EXPECT_THAT(unit[0].words, HasSubstr("in cm"));
}

TEST(CheckMarkers, LeavesPointsThatAreNoPositionsOut) {
  Take clip = synthetic_markers("walk");
  clip.is_position[5] = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.observed[f * clip.marker_count() + 5] = 0;
  const CheckReport report = check_take(clip);
  EXPECT_EQ(report.tracks.size(), clip.marker_count() - 1);
  EXPECT_EQ(report.figures.gaps, 0u);
  EXPECT_EQ(of_kind(report, FindingKind::left_out).size(), 1u);
}

TEST(CheckMarkers, AcceptsTakesOfAnyLengthAndWithoutSamples) {
  for (std::size_t frames = 0; frames < 8; ++frames) {
    Take clip = make_marker_take({"A", "B", "C"}, frames, 100);
    EXPECT_EQ(check_take(clip).frames, frames);
    std::fill(clip.observed.begin(), clip.observed.end(), std::uint8_t{1});
    EXPECT_EQ(check_take(clip).frames, frames);
  }
  EXPECT_EQ(check_take(Take(make_marker_take({}, 0, 100))).tracks.size(), 0u);
}

// The hint must agree with the slower check.
TEST(FindBeyondCleaning, FindsWhatACheckWouldCallSeriousAndStaleSpans) {
  const auto expected = [](const CheckReport& report) {
    std::vector<std::string> texts;
    for (const Finding& f : report.findings) {
      const bool is_stale = f.kind == FindingKind::frozen || f.kind == FindingKind::bridged;
      if (is_stale || f.severity == Severity::serious) texts.push_back(f.track + f.words);
    }
    return texts;
  };
  const auto found = [](const auto& clip) {
    std::vector<std::string> texts;
    for (const Finding& f : find_beyond_cleaning(clip)) texts.push_back(f.track + f.words);
    return texts;
  };
  Take markers = with_random_swaps(synthetic_markers("walk"), 3, 2, 2).clip;
  const std::vector<NamedGap> gaps{{"Head", 30, 89}};
  mark_gaps(markers, gaps);
  for (std::size_t f = 201; f <= 230; ++f) markers.position(f, 5) = markers.position(200, 5);
  EXPECT_EQ(found(markers), expected(check_take(markers)));
  EXPECT_GE(found(markers).size(), 4u);
  Take joints = synthetic_clip("walk");
  const std::size_t arm = joint_of(joints, "LeftArm");
  for (std::size_t f = 201; f <= 230; ++f) joints.rotation(f, arm) = joints.rotation(200, arm);
  for (std::size_t i = 0; i < joints.joint_count(); ++i) joints.rotation(300, i) = {};
  joints.root_position(300) = {};
  EXPECT_EQ(found(joints), expected(check_take(joints)));
  EXPECT_GE(found(joints).size(), 1u);
  EXPECT_TRUE(found(synthetic_clip("run")).empty());
}

}  // namespace
}  // namespace kinemend::test
