// Tests of the samples that the network of `learned` is trained on.
#include "lab/samples/motion_samples.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/lab/synth.hpp"

namespace kinemend {
namespace {

const TrainingSequences& walks() {
  static const TrainingSequences sequences = [] {
    SynthOptions options{.motion = "walk", .duration_s = 6, .frame_rate_hz = 120};
    const Take clip = synthesize(options);
    return encode_takes({1, [&](std::size_t) { return Take(clip); }}, {}, 120);
  }();
  return sequences;
}

MotionSample drawn(const MotionSampling& sampling, std::uint64_t seed) {
  return random_motion_sample({walks(), mirror_of(walks().layout)}, sampling, Random(seed));
}

// Root mean square of the damage over observed samples.
double size_of_damage(const MotionSample& sample) {
  double square = 0;
  for (std::size_t i = 0; i < sample.truth.size(); ++i) {
    if (!sample.take.missing.empty() && sample.take.missing[i] != 0) continue;
    square += std::pow(static_cast<double>(sample.take.values[i] - sample.truth[i]), 2);
  }
  return std::sqrt(square / static_cast<double>(sample.truth.size()));
}

TEST(MotionSamples, AreTheSameForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    const MotionSample one = drawn({}, seed), other = drawn({}, seed);
    EXPECT_EQ(one.take.values, other.take.values);
    EXPECT_EQ(one.truth, other.truth);
    EXPECT_EQ(one.take.missing, other.take.missing);
  }
  EXPECT_NE(drawn({}, 1).take.values, drawn({}, 2).take.values);
}

TEST(MotionSamples, HaveAsManyStepsAsAskedForAtEveryRate) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const MotionSample sample = drawn({.steps = 40}, seed);
    EXPECT_GE(sample.take.steps(), 40U);
    EXPECT_LE(sample.take.steps(), 41U) << sample.take.frame_rate_hz;
    EXPECT_EQ(sample.take.values.size(), sample.take.frames * sample.take.channels);
    for (const float value : sample.take.values) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(MotionSamples, AreDamagedButForTheShareThatIsClean) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_EQ(size_of_damage(drawn({.clean_share = 1}, seed)), 0);
    EXPECT_GT(size_of_damage(drawn({.clean_share = 0}, seed)), 1e-3);
  }
}

TEST(MotionSamples, HaveGapsWhereTheyAreCleanToo) {
  std::size_t with_gaps = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const MotionSample sample = drawn({.clean_share = 1}, seed);
    const auto& missing = sample.take.missing;
    with_gaps += std::count(missing.begin(), missing.end(), 1) > 0 ? 1 : 0;
  }
  EXPECT_GT(with_gaps, 8u);
  EXPECT_LT(with_gaps, 28u);
}

TEST(MotionSamples, ShowTheReferenceOfAPairInTheShareThatIsClean) {
  MotionPair pair;
  MotionTake& take = pair.sample.take;
  take.frames = 900;
  take.channels = 6;
  take.frame_rate_hz = 60;
  take.slots.assign(6, -1);
  take.is_position.assign(6, 0);
  take.missing.assign(900 * 6, 1);
  for (std::size_t i = 0; i < 900 * 6; ++i) {
    const auto x = static_cast<float>(10 * std::sin(0.01 * static_cast<double>(i)));
    pair.sample.truth.push_back(x);
    take.values.push_back(x + (i % 2 == 0 ? 1 : -1));
  }
  const std::vector<MotionPair> pairs{pair};
  for (const double share : {0.0, 1.0}) {
    for (std::uint64_t seed = 0; seed < 6; ++seed) {
      const MotionSample sample =
          random_motion_sample({walks(), mirror_of(walks().layout), pairs},
                               {.pair_share = 1, .clean_share = share}, Random(seed));
      EXPECT_EQ(sample.take.values == sample.truth, share == 1);
      EXPECT_EQ(sample.take.missing.empty(), share == 1);
    }
  }
}

// Two markers that travel at 2 degrees per frame; the second swings about the first.
MarkerMotion travelling_markers() {
  MarkerMotion motion{120, PoseMatrix(1200, 6)};
  for (std::size_t f = 0; f < 1200; ++f) {
    const auto t = static_cast<double>(f);
    motion.positions(f, 0) = motion.positions(f, 3) = 2 * t;
    motion.positions(f, 4) = 30 * std::sin(0.05 * t);
  }
  return motion;
}

TEST(MotionSamples, OfMarkersArePositionsOfNoKnownBody) {
  const std::vector<MarkerMotion> markers{travelling_markers()};
  double damage = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const MotionSample sample =
        random_motion_sample({walks(), mirror_of(walks().layout), {}, markers},
                             {.marker_share = 1, .clean_share = 0}, Random(seed));
    const MotionTake& take = sample.take;
    damage += size_of_damage(sample);
    EXPECT_EQ(take.channels, walks().layout.channel_count());
    EXPECT_EQ(std::count(take.is_position.begin(), take.is_position.end(), 1),
              static_cast<std::ptrdiff_t>(take.channels));
    EXPECT_EQ(*std::max_element(take.slots.begin(), take.slots.end()), -1);
    // Channels that are not markers stay 0.
    for (std::size_t f = 0; f < take.frames; ++f)
      for (std::size_t c = 6; c < take.channels; ++c)
        ASSERT_EQ(take.values[f * take.channels + c], 0);
  }
  EXPECT_GT(damage, 0.1);
}

TEST(MotionSamples, OfMarkersThatAreCleanAreShownAsTheyAreWhereTheyAreSeen) {
  const std::vector<MarkerMotion> markers{travelling_markers()};
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const MotionSample sample =
        random_motion_sample({walks(), mirror_of(walks().layout), {}, markers},
                             {.marker_share = 1, .clean_share = 1}, Random(seed));
    EXPECT_EQ(size_of_damage(sample), 0);
  }
}

TEST(MotionSamples, AreReadLiveInTheShareThatIsAndThenNoNoiseIsMeasured) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const MotionSample live = drawn({.live_share = 1}, seed),
                       whole = drawn({.live_share = 0}, seed);
    EXPECT_TRUE(live.is_live);
    EXPECT_TRUE(live.take.measured.empty());
    EXPECT_FALSE(whole.is_live);
    EXPECT_EQ(whole.take.measured.size(), whole.take.values.size());
  }
}

TEST(MotionSamples, MapAReferenceByTheGainAndOffsetOfEachChannel) {
  MotionPair pair;
  MotionTake& take = pair.sample.take;
  take.frames = 200;
  take.channels = 3;
  take.frame_rate_hz = 60;
  take.slots.assign(3, -1);
  take.is_position.assign(3, 0);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const auto x = static_cast<float>(10 * std::sin(0.1 * static_cast<double>(f)));
    for (const float value : {x, 2 * x, 0.01F * x}) pair.sample.truth.push_back(value);
    for (const float value : {3 - 0.5F * x, 1 + x, x}) take.values.push_back(value);
  }
  const MotionPair mapped = mapped_pair(pair, 1);
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < 2; ++c)
      ASSERT_NEAR(mapped.sample.truth[3 * f + c], take.values[3 * f + c], 1e-4);
    // A channel that hardly moves is set to zero.
    EXPECT_EQ(mapped.sample.truth[3 * f + 2], 0);
    EXPECT_EQ(mapped.sample.take.values[3 * f + 2], 0);
  }
}

// Two swinging tracks on a rig at 30 Hz whose first joint the model knows.
RigMotion swinging_rig() {
  RigMotion rig{30, PoseMatrix(40, 6), {0, 1, 2, -1, -1, -1}, std::vector<std::uint8_t>(6)};
  for (std::size_t f = 0; f < 40; ++f)
    for (std::size_t c = 0; c < 6; ++c)
      rig.values(f, c) = 20 * std::sin(0.3 * static_cast<double>(f) + static_cast<double>(c));
  return rig;
}

TEST(MotionSamples, OfOtherRigsSomeAreCleanAndSomeAreDamaged) {
  const std::vector<RigMotion> rigs{swinging_rig()};
  std::size_t clean = 0, known = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const MotionSample sample =
        random_motion_sample({walks(), mirror_of(walks().layout), {}, {}, rigs},
                             {.rig_share = 1, .live_share = 0}, Random(seed));
    const std::vector<std::int32_t>& slots = sample.take.slots;
    const auto marked =
        std::count_if(slots.begin(), slots.end(), [](std::int32_t slot) { return slot >= 0; });
    clean += size_of_damage(sample) == 0 ? 1 : 0;
    known += marked == 3 ? 1 : 0;
  }
  EXPECT_GT(clean, 10U);
  EXPECT_LT(clean, 30U);
  EXPECT_GT(known, 15U);
  EXPECT_LT(known, 40U);
}

}  // namespace
}  // namespace kinemend
