// Tests that one call mends labels, marks gaps, cleans, and lists the faults that it leaves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "check/marker_support.hpp"
#include "check/support.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/methods.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

auto says(const std::string& words) { return Field(&Leftover::what, HasSubstr(words)); }
auto advises(const std::string& words) { return Field(&Leftover::mend, HasSubstr(words)); }

// A walk in which one joint stands still for a while.
Take with_a_frozen_arm() {
  Take take = synthetic_clip("walk", 8);
  const std::size_t arm = joint_of(take, "LeftArm");
  for (std::size_t f = 200; f < 230; ++f) take.rotation(f, arm) = take.rotation(199, arm);
  return take;
}

TEST(WholeClean, UndoesSwapsBeforeItCleans) {
  const SwapTrial trial = with_random_swaps(synthetic_markers("walk"), 3, 4, 2);
  const auto cleaner = make_auto();
  CleanSettings settings;
  settings.fix_swaps = true;
  settings.leftovers = Leftovers::all;
  const CleanResult result = clean_take(trial.clip, *cleaner, settings);
  Take mended = trial.clip;
  const std::vector<MarkerSwap> swaps = find_swaps(mended);
  ASSERT_EQ(swaps.size(), 3U);
  EXPECT_EQ(result.report.swaps.size(), 3U);
  undo_swaps(mended, swaps);
  EXPECT_EQ(result.take.positions, clean_take(mended, *cleaner).take.positions);
  EXPECT_THAT(result.report.leftovers, Not(Contains(says("swap"))));
}

TEST(WholeClean, NamesTheSwapsThatItWasNotAskedToUndo) {
  const SwapTrial trial = with_random_swaps(synthetic_markers("walk"), 3, 4, 2);
  CleanSettings settings;
  settings.leftovers = Leftovers::all;
  const CleanReport report = clean_take(trial.clip, *make_auto(), settings).report;
  EXPECT_THAT(report.swaps, IsEmpty());
  EXPECT_THAT(report.leftovers,
              Contains(AllOf(says("3 swaps of markers left"), advises("--fix-swaps"))));
}

TEST(WholeClean, FillsTheGapsThatTheSettingsMark) {
  const Take take = synthetic_markers("walk");
  CleanSettings settings;
  settings.gaps = {{"Head", 100, 111}};
  const auto cleaner = make_auto();
  const CleanResult left = clean_take(take, *cleaner, settings);
  EXPECT_FALSE(left.take.is_observed(105, static_cast<std::size_t>(take.find("Head"))));
  settings.fill.emplace();
  const CleanResult filled = clean_take(take, *cleaner, settings);
  EXPECT_EQ(filled.report.fill.filled(), 1U);
  EXPECT_TRUE(filled.take.is_observed(105, static_cast<std::size_t>(take.find("Head"))));
}

TEST(WholeClean, RefusesAGapOfAMarkerThatTheTakeLacks) {
  CleanSettings settings;
  settings.gaps = {{"NoSuchMarker", 1, 2}};
  EXPECT_THROW(clean_take(synthetic_markers("walk"), *make_auto(), settings), Error);
}

TEST(WholeClean, ListsAsManyLeftoversAsTheSettingsAskFor) {
  const Take take = with_a_frozen_arm();
  const auto cleaner = make_auto({.sensitivity = 0});
  CleanSettings settings;
  settings.strength = 0;
  const auto leftovers = [&](Leftovers asked) {
    settings.leftovers = asked;
    return clean_take(take, *cleaner, settings).report.leftovers;
  };
  EXPECT_THAT(leftovers(Leftovers::none), IsEmpty());
  const auto frozen = AllOf(says("1 frozen or bridged span left"), advises("kinemend check TAKE"));
  EXPECT_THAT(leftovers(Leftovers::beyond_cleaning), Each(frozen));
  EXPECT_THAT(leftovers(Leftovers::all), AllOf(Contains(frozen), Contains(says("--strength 0"))));
}

}  // namespace
}  // namespace kinemend::test
