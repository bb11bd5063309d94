// Tests that the source of a take, given or read from its file, reaches methods and reports.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/live.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

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

using testing::ElementsAre;

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
