// Tests that long takes need memory for one copy and report progress.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "counting_allocation.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;

#if !defined(KINEMEND_SANITIZED)
Take noisy_stroll(double duration_s) {
  Take clip = synthesize({"stroll", duration_s, 120, 1});
  Random random(7);
  apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  apply_damage(clip, "outliers", {{"share", 0.004}}, random);
  return clip;
}

// The peak excludes the take itself (32 bytes per rotation). It holds the vectors of all joints,
// marks, and the work of two threads.
TEST(LongTakes, AreCleanedInLittleMoreRoomThanTheyTake) {
  const ThreadLimit control(2);
  const auto cleaner = make_auto();
  Take clip = noisy_stroll(60);
  const auto rotations = static_cast<double>(clip.rotations.size());
  const std::size_t peak = peak_memory([&] { clip = clean_take(std::move(clip), *cleaner).take; });
  EXPECT_LT(static_cast<double>(peak), 90 * rotations);
  EXPECT_GT(static_cast<double>(peak), 10 * rotations);  // proves that allocations are counted
}

// With the shipped model, memory grows only by five vectors of the take's channels, the marks of
// its samples, and the copy passed on; the rest is for one stretch.
TEST(LongTakes, AreCleanedByExampleInRoomThatGrowsLittle) {
  const ThreadLimit control(2);
  const auto cleaner = make_example();
  const auto peak_of = [&](const Take& take) {
    Take clip = take;
    return static_cast<double>(
        peak_memory([&] { clip = clean_take(std::move(clip), *cleaner).take; }));
  };
  Take whole = noisy_stroll(50);
  EXPECT_LT(peak_of(slice(whole, 0, 1500)), 95e6);
  whole.frame_rate_hz = 30;
  const double growth = peak_of(whole) - peak_of(slice(whole, 0, whole.frame_count() / 2));
  EXPECT_LT(growth, 150 * static_cast<double>(whole.rotations.size() / 2));
  // The take's rate matters little, because windows are resampled to the model's rate.
  whole.frame_rate_hz = 120;
  const double usual = peak_of(whole);
  whole.frame_rate_hz = 1000;
  EXPECT_LT(peak_of(whole), 1.5 * usual);
}
#endif

struct Told {
  std::string stage;
  std::vector<double> shares;
};

class EveryOnLongTakes : public testing::TestWithParam<std::string> {};

TEST_P(EveryOnLongTakes, TellsOfEachStageOnceFromBeginningToEnd) {
  Take clip = moving_take(1500, 120);
  add_noise(clip, 1.5, 0.5, 1);
  std::vector<Told> told;
  CleanSettings settings;
  settings.progress = [&](std::string_view stage, double done) {
    if (told.empty() || told.back().stage != stage) told.push_back({std::string(stage), {}});
    told.back().shares.push_back(done);
  };
  const auto cleaner = make_cleaner(GetParam());
  const auto stages = [&] {
    told.clear();
    clean_take(clip, *cleaner, settings);
    std::vector<std::string> names;
    for (const Told& stage : told) {
      names.push_back(stage.stage);
      EXPECT_EQ(stage.shares.front(), 0) << stage.stage;
      EXPECT_EQ(stage.shares.back(), 1) << stage.stage;
      for (std::size_t i = 1; i < stage.shares.size(); ++i)
        EXPECT_LT(stage.shares[i - 1], stage.shares[i]) << stage.stage;
    }
    return names;
  };
  EXPECT_THAT(stages(), ElementsAre("cleaning"));
  if (GetParam() == "auto") {
    EXPECT_GT(told[0].shares.size(), 10U);
  }
  settings.fill.emplace();
  settings.feet.emplace();
  EXPECT_THAT(stages(), ElementsAre("cleaning", "filling", "feet"));
}

// A track passed on may replace the input at once.
TEST_P(EveryOnLongTakes, ReadsNoTrackThatItHasHandedOver) {
  Take clip = moving_take(600, 120);
  add_noise(clip, 1.5, 0.5, 2);
  clip.rotation(100, 2) = clip.rotation(100, 2) * exp({1.2, 0, 0});
  const auto cleaner = make_cleaner(GetParam());
  Take at_once = clip;
  const InPlaceTrace trace = clean_in_place(*cleaner, at_once);
  Take afterwards = clip;
  std::vector<CleanedTrack> tracks(2 + clip.joint_count());
  const CleanTrace other = cleaner->clean(
      view_of(clip), [&](std::size_t n, CleanedTrack cleaned) { tracks[n] = std::move(cleaned); },
      {});
  for (std::size_t n = 0; n < tracks.size(); ++n) {
    set_track(afterwards, n, tracks[n].rotations);
    set_track(afterwards, n, tracks[n].positions);
    EXPECT_EQ(tracks[n].actions, trace.actions[n]);
  }
  EXPECT_EQ(at_once.rotations, afterwards.rotations);
  EXPECT_EQ(at_once.positions, afterwards.positions);
  EXPECT_EQ(other.noise, trace.noise);
}

TEST_P(EveryOnLongTakes, GivesTheSameOfATakeThatIsNeededNoMore) {
  Take clip = moving_take(300, 120);
  add_noise(clip, 1.5, 0.5, 3);
  for (std::size_t j = 0; j < clip.joint_count(); ++j) clip.rotation(0, j) = {};
  ASSERT_EQ(leading_calibration_frames(clip), 1U);
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 50; f < 55; ++f) clip.observed[f * clip.joint_count() + 1] = 0;
  const auto cleaner = make_cleaner(GetParam());
  const CleanResult kept = clean_take(clip, *cleaner);
  const std::vector<std::uint8_t> observed = clip.observed;
  const CleanResult given = clean_take(std::move(clip), *cleaner);
  EXPECT_EQ(given.take.rotations, kept.take.rotations);
  EXPECT_EQ(given.take.positions, kept.take.positions);
  EXPECT_EQ(given.take.observed, observed);
  ASSERT_EQ(given.report.spans.size(), kept.report.spans.size());
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryOnLongTakes, testing::ValuesIn(method_names()),
                         [](const auto& method) { return camel_case(method.param); });

}  // namespace
}  // namespace kinemend::test
