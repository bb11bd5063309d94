// Tests that one call mends labels, marks gaps, cleans, and lists the faults that it leaves, and
// that the source of a take, given or read from its file, reaches methods and reports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <memory>
#include <utility>
#include <vector>

#include "check/marker_support.hpp"
#include "check/support.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/live.hpp"
#include "kinemend/take.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
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

// Records the sources of the takes and changes nothing.
class Listener final : public Cleaner {
 public:
  std::string_view name() const override { return "listener"; }
  CleanTrace clean(const TakeView& take, const TrackSink&,
                   const std::function<void(double)>&) const override {
    heard_.push_back(take.source);
    return {};
  }
  LiveSupport live_support(double) const override { return {}; }
  std::unique_ptr<LiveFilter> live(const TakeView& like) const override {
    heard_.push_back(like.source);
    return make_one_euro()->live(like);
  }

  std::vector<Source> heard() const { return std::exchange(heard_, {}); }

 private:
  mutable std::vector<Source> heard_;
};

Take noisy_walk() {
  Take take = moving_take(240, 120);
  add_noise(take, 2, 0.5, 1);
  return take;
}

Take noisy_markers() {
  Take take = make_marker_take({"A", "B", "C"}, 240, 120);
  Random random(2);
  for (Vec3& position : take.positions)
    position = {random.normal(), 100 + random.normal(), random.normal()};
  take.observed.assign(take.observed.size(), 1);
  return take;
}

Take from_a_suit(Take take) {
  take.source.facts.push_back({"software", "Axis Studio"});
  return take;
}

CleanSettings given(Source source) {
  CleanSettings settings;
  settings.source = source;
  return settings;
}

TEST(TakeSources, ReachTheMethodAndTheReport) {
  const Listener listener;
  for (const Take& take : {noisy_walk(), noisy_markers()}) {
    CleanReport report = clean_take(take, listener).report;
    EXPECT_THAT(listener.heard(), ElementsAre(Source::unknown));
    EXPECT_EQ(report.source, TakeSource());
    report = clean_take(take, listener, given(Source::video)).report;
    EXPECT_THAT(listener.heard(), ElementsAre(Source::video));
    EXPECT_EQ(report.source, (TakeSource{Source::video, "given"}));
    report = clean_take(from_a_suit(take), listener).report;
    EXPECT_THAT(listener.heard(), ElementsAre(Source::suit));
    EXPECT_EQ(report.source.reason, "read from the file, software: Axis Studio");
    report = clean_take(from_a_suit(take), listener, given(Source::optical)).report;
    EXPECT_THAT(listener.heard(), ElementsAre(Source::optical));
    EXPECT_EQ(report.source.reason, "given");
  }
}

TEST(TakeSources, ReachTheMethodWhereGapsAreFilledToo) {
  const Listener listener;
  CleanSettings settings = given(Source::depth);
  settings.fill.emplace();
  clean_take(noisy_walk(), listener, settings);
  const std::vector<Source> heard = listener.heard();
  ASSERT_FALSE(heard.empty());
  for (const Source source : heard) EXPECT_EQ(source, Source::depth);
}

TEST(TakeSources, ReachStreams) {
  const Listener listener;
  make_stream(listener, noisy_walk());
  make_stream(listener, noisy_walk(), 0, Source::video);
  make_stream(listener, from_a_suit(noisy_walk()));
  make_stream(listener, from_a_suit(noisy_walk()), 0, Source::optical);
  EXPECT_THAT(listener.heard(),
              ElementsAre(Source::unknown, Source::video, Source::suit, Source::optical));
}

TEST(TakeSources, AutoChangesNothingOfKeys) {
  const Take noisy = noisy_walk();
  const CleanResult kept = clean_take(noisy, *make_auto(), given(Source::keyframed));
  EXPECT_EQ(kept.take.rotations, noisy.rotations);
  EXPECT_EQ(kept.take.positions, noisy.positions);
  for (const TrackSummary& track : kept.report.tracks) EXPECT_EQ(track.noise, 0) << track.name;
  EXPECT_NE(clean_take(noisy, *make_auto(), given(Source::optical)).take.rotations,
            noisy.rotations);
  // An explicitly chosen method runs whatever the source.
  EXPECT_EQ(clean_take(noisy, *make_gaussian(), given(Source::keyframed)).take.rotations,
            clean_take(noisy, *make_gaussian()).take.rotations);
}

}  // namespace
}  // namespace kinemend::test
