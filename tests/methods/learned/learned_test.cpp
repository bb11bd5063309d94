// Tests of the method `learned` that do not depend on its weights; this network selects the
// Gaussian of 50 ms everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "methods/learned/motion_support.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t gaussian_of_50_ms = 5;

Take walk_for_networks(double rate_hz) {
  return synthesize({.motion = "walk", .duration_s = 3, .frame_rate_hz = rate_hz});
}

Take with_damage(Take clip, const std::string& damage, const OptionValues& options) {
  Random random(5);
  apply_damage(clip, damage, options, random);
  return clip;
}

std::unique_ptr<Cleaner> cleaner_of(Model model, bool live = false) {
  return make_learned({.live = live}, std::make_shared<const Model>(std::move(model)));
}

CleanResult cleaned_from(Source source, const Take& take, const Cleaner& cleaner) {
  CleanSettings settings;
  settings.source = source;
  return clean_take(take, cleaner, settings);
}

// A cleaner whose network always selects one smoother.
std::unique_ptr<Cleaner> asking_for(std::size_t smoother) {
  return cleaner_of(one_smoother_model(smoother));
}

// Makes the network always state one deviation of its result.
Model expecting(Model model, double deviation_deg) {
  model.tensors["output.bias"].values.back() = 2 * std::log(deviation_deg);
  return model;
}

Take without_known_names(Take clip) {
  for (std::size_t j = 0; j < clip.skeleton.joint_count(); ++j)
    clip.skeleton.names[j] = "Q" + std::to_string(j);
  return clip;
}

TEST(LearnedCleaner, SmoothsByTimeAndNotByFrames) {
  for (const double rate_hz : {60.0, 120.0, 240.0}) {
    const Take truth = walk_for_networks(rate_hz);
    const Take noisy = with_damage(truth, "gaussian", {{"std_deg", 3.0}});
    const Take cleaned = clean_take(noisy, *asking_for(gaussian_of_50_ms)).take;
    EXPECT_LT(rms_deg(truth, cleaned), 0.75 * rms_deg(truth, noisy)) << rate_hz << " Hz";
  }
}

TEST(LearnedCleaner, MakesTheSameOfJointsWhoseNamesItDoesNotKnow) {
  const Take noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 1.0}});
  const std::unique_ptr<Cleaner> smoothing = asking_for(gaussian_of_50_ms);
  const Take known = clean_take(noisy, *smoothing).take;
  Take unknown = clean_take(without_known_names(noisy), *smoothing).take;
  unknown.skeleton.names = known.skeleton.names;
  // Rotation vectors about another reference differ only by the curvature of rotations.
  EXPECT_LT(rms_deg(known, unknown), 0.1);
}

TEST(LearnedCleaner, SmoothsMarkers) {
  const Take truth = joint_markers(walk_for_networks(120));
  Take noisy = truth;
  Random random(5);
  apply_damage(noisy, "gaussian", {{"std_deg", 4.0}}, random);
  const Take cleaned = clean_take(noisy, *asking_for(gaussian_of_50_ms)).take;
  double before = 0, after = 0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    const Vec3 damage = noisy.positions[i] - truth.positions[i];
    const Vec3 left = cleaned.positions[i] - truth.positions[i];
    before += dot(damage, damage);
    after += dot(left, left);
  }
  EXPECT_LT(std::sqrt(after), 0.8 * std::sqrt(before));
}

TEST(LearnedCleaner, RepairsSpikesBeforeTheNetworkSeesThem) {
  const Take truth = walk_for_networks(120);
  const Take spiky = with_damage(truth, "outliers", {{"share", 0.005}, {"std_deg", 25.0}});
  EXPECT_LT(rms_deg(truth, clean_take(spiky, *asking_for(0)).take), 0.4 * rms_deg(truth, spiky));
}

TEST(LearnedCleaner, KeepsACleanTakeOfWhichItsNetworkKeepsAll) {
  const Take walk = walk_for_networks(120);
  for (const Take& take : {walk, without_known_names(walk)})
    EXPECT_LT(rms_deg(take, clean_take(take, *asking_for(0)).take), 1e-3);
}

TEST(LearnedCleaner, TakesWhatIsMeasuredForNoiseWhereItsNetworkKeepsAll) {
  const Take walk = walk_for_networks(120),
             noisy = with_damage(walk, "gaussian", {{"std_deg", 1.0}});
  EXPECT_LT(rms_deg(walk, clean_take(noisy, *asking_for(0)).take), 0.6 * rms_deg(walk, noisy));
}

TEST(LearnedCleaner, GivesTheSameAgain) {
  const Take noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 3.0}});
  EXPECT_EQ(clean_take(noisy, *asking_for(gaussian_of_50_ms)).take.rotations,
            clean_take(noisy, *asking_for(gaussian_of_50_ms)).take.rotations);
}

TEST(LearnedCleaner, LeavesShortTakesAndSlowOnesToAutoAndSaysSo) {
  const Take noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 3.0}});
  Take slow = noisy;
  slow.frame_rate_hz = 15;
  const std::unique_ptr<Cleaner> learned = asking_for(gaussian_of_50_ms), automatic = make_auto();
  for (const auto& [take, reason] :
       {std::pair{Take(slice(noisy, 0, 3)), "shorter than half a second"},
        {slice(noisy, 0, 59), "shorter than half a second"},
        {slow, "below 20 Hz"}}) {
    const CleanResult result = clean_take(take, *learned);
    EXPECT_EQ(result.take.rotations, clean_take(take, *automatic).take.rotations);
    ASSERT_EQ(result.report.fall_backs.size(), 1U);
    EXPECT_EQ(result.report.fall_backs[0].method, "auto");
    EXPECT_THAT(result.report.fall_backs[0].reason, testing::HasSubstr(reason));
  }
}

TEST(LearnedCleaner, SaysHowFarItsResultIsExpectedToBeOff) {
  const Take noisy = with_damage(walk_for_networks(120), "gaussian", {{"std_deg", 2.0}});
  const CleanReport report =
      clean_take(noisy, *cleaner_of(expecting(one_smoother_model(gaussian_of_50_ms), 0.5))).report;
  ASSERT_GE(report.tracks.size(), noisy.joint_count());
  for (const TrackSummary& track : report.tracks) EXPECT_NEAR(track.left, 0.5, 1e-3) << track.name;
}

TEST(LearnedCleaner, LeavesTracksAloneWhoseChangeIsSmallBesideWhatMayBeWrongAnyway) {
  const Take truth = walk_for_networks(120);
  Take clip = with_damage(truth, "gaussian", {{"std_deg", 0.2}});
  // A spike is repaired even so.
  const std::size_t knee = 2, frame = 200;
  clip.rotation(frame, knee) = clip.rotation(frame, knee) * exp(Vec3{2, 0, 0});
  const Model smoothing = one_smoother_model(gaussian_of_50_ms);
  const CleanResult unsure = clean_take(clip, *cleaner_of(expecting(smoothing, 40)));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (f == frame && j == knee) continue;
      ASSERT_EQ(unsure.take.rotation(f, j), clip.rotation(f, j)) << "frame " << f;
    }
  }
  EXPECT_LT(angle_between(unsure.take.rotation(frame, knee), truth.rotation(frame, knee)), 0.05);
  EXPECT_TRUE(unsure.report.noise.empty());
  EXPECT_EQ(unsure.report.tracks[knee].left, 0);
  const CleanResult sure = clean_take(clip, *cleaner_of(expecting(smoothing, 0.1)));
  EXPECT_NE(sure.take.rotation(100, knee), clip.rotation(100, knee));
}

// The network takes the peaks of fast moves for errors, and the take shows no noise.
TEST(LearnedCleaner, KeepsAFastMoveThatItsNetworkWouldSmoothUnlessTheSourceHasSlowNoise) {
  const Take punch = synthesize({.motion = "punch", .duration_s = 6, .frame_rate_hz = 60});
  const auto cleaner = asking_for(gaussian_of_50_ms);
  const CleanResult kept = clean_take(punch, *cleaner),
                    video = cleaned_from(Source::video, punch, *cleaner);
  EXPECT_GT(rms_deg(punch, video.take), 0.5);
  EXPECT_LT(rms_deg(punch, kept.take), 0.2 * rms_deg(punch, video.take));
  ASSERT_EQ(kept.report.notes.size(), 1U);
  EXPECT_THAT(kept.report.notes[0],
              testing::EndsWith("; if this take comes from video, a depth camera or a suit, "
                                "--source video (depth, suit) makes them"));
  EXPECT_TRUE(video.report.notes.empty());
  for (const Source source : {Source::depth, Source::suit})
    EXPECT_EQ(cleaned_from(source, punch, *cleaner).take.rotations, video.take.rotations);
  EXPECT_EQ(cleaned_from(Source::unknown, punch, *cleaner).take.rotations, kept.take.rotations);
}

// With a stated source, the report gives no advice to state one.
TEST(LearnedCleaner, CleansOpticalTakesAsUnknownOnesWithoutTheAdvice) {
  const Take punch = synthesize({.motion = "punch", .duration_s = 6, .frame_rate_hz = 60});
  const auto cleaner = asking_for(gaussian_of_50_ms);
  const CleanResult optical = cleaned_from(Source::optical, punch, *cleaner);
  EXPECT_EQ(optical.take.rotations, clean_take(punch, *cleaner).take.rotations);
  ASSERT_EQ(optical.report.notes.size(), 1U);
  EXPECT_THAT(optical.report.notes[0], testing::EndsWith("does not show to be noise"));
}

TEST(LearnedCleaner, LiveTheSourceCountsToo) {
  const Take punch = synthesize({.motion = "punch", .duration_s = 6, .frame_rate_hz = 60});
  const auto cleaner = cleaner_of(one_smoother_model(gaussian_of_50_ms), true);
  const Take unknown = clean_take(punch, *cleaner).take,
             video = cleaned_from(Source::video, punch, *cleaner).take;
  EXPECT_EQ(cleaned_from(Source::optical, punch, *cleaner).take.rotations, unknown.rotations);
  EXPECT_GT(rms_deg(punch, video), 2 * rms_deg(punch, unknown));
}

TEST(LearnedCleaner, ChangesNothingOfKeysButGaps) {
  Take keyed = with_damage(walk_for_networks(60), "gaussian", {{"std_deg", 3.0}});
  const std::size_t knee = 2, gap = 50;
  keyed.observed.assign(keyed.frame_count() * keyed.joint_count(), 1);
  keyed.observed[gap * keyed.joint_count() + knee] = 0;
  keyed.rotation(gap, knee) = keyed.rotation(gap, knee) * exp(Vec3{2, 0, 0});
  for (const bool live : {false, true}) {
    const auto cleaner = cleaner_of(one_smoother_model(gaussian_of_50_ms), live);
    const CleanResult result = cleaned_from(Source::keyframed, keyed, *cleaner);
    EXPECT_EQ(result.report.method, "learned");
    EXPECT_TRUE(result.report.fall_backs.empty());
    EXPECT_LT(angle_between(result.take.rotation(gap, knee), keyed.rotation(gap - 1, knee)), 0.5);
    Take rest = result.take;
    rest.rotation(gap, knee) = keyed.rotation(gap, knee);
    EXPECT_EQ(rest.rotations, keyed.rotations) << live;
    EXPECT_EQ(rest.positions, keyed.positions) << live;
  }
}

// Noise that shows from frame to frame is measurable at any size, and small errors need no mention.
TEST(LearnedCleaner, NamesNoiseThatIsLargeAndSlowOnly) {
  const Take clip = walk_for_networks(120);
  const auto characters = [&](const Take& take, double expected_deg) {
    const std::unique_ptr<Cleaner> cleaner =
        cleaner_of(expecting(one_smoother_model(gaussian_of_50_ms), expected_deg));
    std::vector<NoiseCharacter> noise = cleaned_from(Source::video, take, *cleaner).report.noise;
    std::erase_if(noise, [](const NoiseCharacter& one) {
      return one.space != Space::rotation || !one.is_expected || one.correlation > 0;
    });
    return noise;
  };
  EXPECT_TRUE(characters(clip, 0.2).empty());
  EXPECT_TRUE(characters(with_damage(clip, "gaussian", {{"std_deg", 6.0}}), 2).empty());
  const std::vector<NoiseCharacter> slow = characters(clip, 1.5);
  ASSERT_FALSE(slow.empty());
  EXPECT_TRUE(slow[0].is_expected);
  EXPECT_GT(slow[0].strength, 1.5);
  EXPECT_LT(slow[0].strength, 3);
}

}  // namespace
}  // namespace kinemend::test
