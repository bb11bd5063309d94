// Tests of peak speeds and the noise in them, by simulation.
#include "metrics/track_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/metrics.hpp"
#include "motion/clips.hpp"

namespace kinemend {
namespace {

using test::moving_chain;

// In a simulation, one set in twenty holds a longer vector.
TEST(LongestOfNoise, IsPassedByOneSetInTwenty) {
  for (const std::size_t count : {30u, 300u, 3000u}) {
    const int sets = 600000 / static_cast<int>(count);
    int longer = 0;
    Random random(count);
    for (int set = 0; set < sets; ++set) {
      double longest = 0;
      for (std::size_t i = 0; i < count; ++i)
        longest = std::max(longest, norm(test::random_vector(random, 1)));
      longer += longest > longest_of_noise(count) ? 1 : 0;
    }
    const double expected = 0.05 * sets, deviation = std::sqrt(expected);
    EXPECT_NEAR(longer, expected, 4 * deviation + 0.3 * expected) << count;
  }
}

// The simulation draws correlated samples.
TEST(SampleNoise, KnowsHowFarSamplesThatDependOnEachOtherGoApart) {
  const SampleNoise noise{0, 2, 0.8};
  Random random(7);
  std::vector<double> samples{2 * random.normal()};
  for (int t = 1; t < 200000; ++t)
    samples.push_back(0.8 * samples.back() + 2 * std::sqrt(1 - 0.64) * random.normal());
  for (const std::size_t gap : {1u, 2u, 6u, 40u}) {
    double squares = 0;
    for (std::size_t t = gap; t < samples.size(); ++t)
      squares += (samples[t] - samples[t - gap]) * (samples[t] - samples[t - gap]);
    const double deviation = std::sqrt(squares / static_cast<double>(samples.size() - gap));
    EXPECT_NEAR(noise.of_difference(gap), deviation, 0.02 * deviation) << gap;
  }
  EXPECT_NEAR((SampleNoise{1, 1}.of_difference(3)), std::sqrt(2.0), 1e-12);
}

Take turning(double speed_deg_s, std::size_t frames = 240) {
  Take clip = test::chain_clip(2, frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / clip.frame_rate_hz;
    clip.rotation(f, 1) = test::about_x(0.3 * std::sin(speed_deg_s * radians_per_degree / 0.3 * t));
  }
  return clip;
}

TEST(PeakSpeeds, AreThoseOfTheMotionBesideNoiseAndSpikes) {
  const Take truth = turning(90);
  Take other = truth;
  Random random(4);
  for (std::size_t f = 0; f < other.frame_count(); ++f)
    other.rotation(f, 1) = other.rotation(f, 1) * exp(test::random_vector(random, 0.002));
  other.rotation(100, 1) = other.rotation(100, 1) * exp({0, 1, 0});
  const JointComparison joint = compare_clips(truth, other).joints[1];
  EXPECT_NEAR(joint.peak_speed_reference_deg_s, 90, 2);
  EXPECT_NEAR(joint.peak_speed_other_deg_s, 90, 15);  // 7,000 with the spike
  const JointComparison turned_round = compare_clips(other, truth).joints[1];
  EXPECT_NEAR(turned_round.peak_speed_reference_deg_s, joint.peak_speed_other_deg_s, 1e-9);
  EXPECT_EQ(turned_round.peak_frames, joint.peak_frames);
}

TEST(PeakSpeeds, OfACleanTakeAreFromFrameToFrame) {
  const Take clip = turning(40);
  const JointComparison joint = compare_clips(clip, clip).joints[1];
  EXPECT_EQ(joint.peak_frames, 1u);
  EXPECT_NEAR(joint.peak_speed_reference_deg_s, peak_angular_speed_deg_s(clip)[1], 1e-9);
}

}  // namespace
}  // namespace kinemend
