// Label swaps in synthetic takes are found, and undoing them restores the take.
#include <gtest/gtest.h>

#include "check/marker_support.hpp"
#include "kinemend/error.hpp"

namespace kinemend::test {
namespace {

TEST(Swaps, AreNotSeenInCleanTakes) {
  for (const char* motion : {"walk", "run", "turn", "jump", "wave", "clap", "still"})
    EXPECT_EQ(find_swaps(synthetic_markers(motion)).size(), 0u) << motion;
}

TEST(Swaps, AreFoundToTheFrameAndNothingElse) {
  Tally tally;
  for (const char* motion : {"walk", "run", "turn", "jump", "wave", "punch"}) {
    const Take clean = synthetic_markers(motion);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const SwapTrial trial = with_random_swaps(clean, 6, 2, seed);
      tally.add(trial.swaps, find_swaps(trial.clip));
    }
  }
  EXPECT_GE(tally.put_in, 100u);
  EXPECT_EQ(tally.precision(), 1) << tally.found - tally.right << " of " << tally.found;
  EXPECT_GE(tally.recall(), 0.98) << tally.right << " of " << tally.put_in;
}

TEST(Swaps, UndoneGiveTheTakeBack) {
  const Take clean = synthetic_markers("walk");
  SwapTrial trial = with_random_swaps(clean, 5, 2, 3);
  ASSERT_EQ(trial.swaps.size(), 5u);
  EXPECT_NE(trial.clip.positions, clean.positions);
  undo_swaps(trial.clip, find_swaps(trial.clip));
  EXPECT_EQ(trial.clip.positions, clean.positions);
}

TEST(Swaps, ThatReachTheEndOfTheTakeAreTheShorterSide) {
  Take clip = synthetic_markers("walk");
  const MarkerSwap swap{3, 8, 600, clip.frame_count() - 1};
  undo_swaps(clip, {swap});
  EXPECT_EQ(find_swaps(clip), std::vector<MarkerSwap>{swap});
}

TEST(Swaps, OfPointsWithoutALabelAreNone) {
  Take clip = synthetic_markers("walk");
  undo_swaps(clip, {{3, 8, 600, clip.frame_count() - 1}});
  ASSERT_EQ(find_swaps(clip).size(), 1u);
  for (const char* name : {"*", "Ann:*", "uname*", "U_", "Unlabeled ", "Ann:Unlabelled_"}) {
    for (const std::size_t m : {3, 8}) clip.names[m] = name + std::to_string(m);
    EXPECT_TRUE(find_swaps(clip).empty()) << name;
  }
}

// Both markers are hidden for a while and reappear with exchanged labels.
TEST(Swaps, MayBeginAndEndInGaps) {
  const Take clean = synthetic_markers("walk");
  Take clip = clean;
  const auto left = static_cast<std::size_t>(clip.find("LeftHand")),
             right = static_cast<std::size_t>(clip.find("RightHand"));
  undo_swaps(clip, {{left, right, 200, 340}});
  const std::vector<NamedGap> gaps{{"LeftHand", 195, 206},
                                   {"RightHand", 198, 203},
                                   {"LeftHand", 338, 346},
                                   {"RightHand", 335, 341}};
  mark_gaps(clip, gaps);
  const std::vector<MarkerSwap> found = find_swaps(clip);
  ASSERT_EQ(found.size(), 1u);
  undo_swaps(clip, found);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (const std::size_t m : {left, right}) {
      if (!clip.is_observed(f, m)) continue;
      ASSERT_EQ(clip.position(f, m), clean.position(f, m)) << f;
    }
  }
}

TEST(Swaps, AreNotSeenInGapsOfTracksThatComeBackRight) {
  Take clip = synthetic_markers("walk", 10);
  Random random(4);
  std::vector<NamedGap> gaps;
  for (int i = 0; i < 120; ++i) {
    const std::size_t first = pick(random, clip.frame_count() - 60);
    gaps.push_back(
        {clip.names[pick(random, clip.marker_count())], first, first + pick(random, 50)});
  }
  mark_gaps(clip, gaps);
  EXPECT_EQ(find_swaps(clip).size(), 0u);
}

TEST(Swaps, TakeResidualsAndMasksAlong) {
  Take clip = make_marker_take({"A", "B"}, 3, 100);
  clip.residuals.assign(6, -1);
  clip.positions[2] = {1, 2, 3};
  clip.observed[2] = 1;
  clip.residuals[2] = 0.5;
  undo_swaps(clip, {{0, 1, 1, 1}});
  EXPECT_FALSE(clip.is_observed(1, 0));
  EXPECT_TRUE(clip.is_observed(1, 1));
  EXPECT_EQ(clip.position(1, 1), (Vec3{1, 2, 3}));
  EXPECT_EQ(clip.residuals[3], 0.5f);
}

TEST(Swaps, OfWhatTheTakeDoesNotHaveAreAnError) {
  Take clip = make_marker_take({"A", "B"}, 3, 100);
  EXPECT_THROW(undo_swaps(clip, {{0, 2, 1, 1}}), Error);
  EXPECT_THROW(undo_swaps(clip, {{0, 1, 1, 3}}), Error);
  EXPECT_THROW(undo_swaps(clip, {{0, 1, 2, 1}}), Error);
}

TEST(Swaps, OfTakesTooShortToTellAreNone) {
  for (const std::size_t frames : {0, 1, 2, 3}) {
    Take clip = make_marker_take({"A", "B", "C"}, frames, 100);
    std::fill(clip.observed.begin(), clip.observed.end(), std::uint8_t{1});
    EXPECT_TRUE(find_swaps(clip).empty()) << frames;
  }
}

}  // namespace
}  // namespace kinemend::test
