#include "priors/recurrent_samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "priors/auto_channels.hpp"
#include "priors/sequence_damage.hpp"
#include "synthetic_walks.hpp"

namespace kinemend {
namespace {

const TrainingSequences& walks() {
  static const TrainingSequences sequences = encoded_walks(3);
  return sequences;
}

double error(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(AutoOfChannels, CleansNoiseAndLeavesCleanTracksAlone) {
  const PoseMatrix truth = sequence_at(walks(), 0).poses;
  EXPECT_EQ(auto_of_channels(walks().layout, 120, truth, {}).poses.values, truth.values);
  PoseMatrix noisy = truth;
  std::vector<std::uint8_t> observed;
  Random random(1);
  damage_sequence(walks().layout, 120, noisy, observed, "gaussian", {{"std_deg", 2.0}}, random);
  const AutoChannels cleaned = auto_of_channels(walks().layout, 120, noisy, observed);
  const std::vector<float> expected(truth.values.begin(), truth.values.end());
  const std::vector<float> before(noisy.values.begin(), noisy.values.end());
  const std::vector<float> after(cleaned.poses.values.begin(), cleaned.poses.values.end());
  EXPECT_LT(error(after, expected), 0.6 * error(before, expected));
  EXPECT_NEAR(cleaned.noise.front(), 2, 0.3);
}

TEST(RecurrentSamples, AreTheSameForTheSameNumberAndOtherwiseDiffer) {
  const Random random(7);
  const auto sample = [&](std::uint64_t index) {
    return random_recurrent_sample(walks(), 200, random.fork(index));
  };
  const RecurrentSample a = sample(1), b = sample(1), c = sample(2);
  EXPECT_EQ(a.take.measured, b.take.measured);
  EXPECT_EQ(a.take.automatic, b.take.automatic);
  EXPECT_NE(a.take.measured, c.take.measured);
  EXPECT_EQ(a.truth.size(), a.take.frames * a.take.channels);
  EXPECT_EQ(a.take.marks.size(), a.take.frames * a.take.channels / 3);
}

TEST(RecurrentSamples, AFifthIsCleanAndTheOthersAreNot) {
  std::size_t clean = 0;
  constexpr std::size_t count = 60;
  for (std::size_t i = 0; i < count; ++i) {
    const RecurrentSample sample = random_recurrent_sample(walks(), 64, Random(3).fork(i));
    if (error(sample.take.measured, sample.truth) == 0) ++clean;
    for (const float value : sample.take.automatic) ASSERT_TRUE(std::isfinite(value));
  }
  EXPECT_GE(clean, 4u);
  EXPECT_LE(clean, 24u);
}

TEST(RecurrentForms, AMirroredWalkHasTheOtherKneesBendAndTwiceMirroredIsItself) {
  const BodyLayout& layout = walks().layout;
  const BodyMirror mirror = mirror_of(layout);
  for (std::size_t n = 0; n < mirror.partners.size(); ++n)
    EXPECT_EQ(mirror.partners[mirror.partners[n]], n);
  const RecurrentSample sample =
      recurrent_sample(layout, 120, sequence_at(walks(), 0).poses, Random(4));
  const RecurrentSample once = in_form(sample, {true, false}, mirror);
  const RecurrentSample twice = in_form(once, {true, false}, mirror);
  EXPECT_NE(once.truth, sample.truth);
  EXPECT_EQ(twice.truth, sample.truth);
  EXPECT_EQ(twice.take.measured, sample.take.measured);
  EXPECT_EQ(twice.take.marks, sample.take.marks);
  const auto track = [&](const char* name) {
    return static_cast<std::size_t>(std::find(layout.names.begin(), layout.names.end(), name) -
                                    layout.names.begin());
  };
  const std::size_t left = 3 * track("LeftLeg"), right = 3 * track("RightLeg");
  const std::size_t place = sample.take.channels - 3;
  for (std::size_t f = 0; f < sample.take.frames; ++f) {
    const std::size_t row = f * sample.take.channels;
    EXPECT_EQ(once.truth[row + right], sample.truth[row + left]);
    EXPECT_EQ(once.truth[row + right + 1], -sample.truth[row + left + 1]);
    EXPECT_EQ(once.truth[row + place], -sample.truth[row + place]);
    EXPECT_EQ(once.truth[row + place + 1], sample.truth[row + place + 1]);
  }
}

TEST(RecurrentForms, BackwardsTheLastFrameIsTheFirst) {
  const BodyMirror mirror = mirror_of(walks().layout);
  const RecurrentSample sample =
      recurrent_sample(walks().layout, 120, sequence_at(walks(), 0).poses, Random(4));
  const RecurrentSample once = in_form(sample, {false, true}, mirror);
  const std::size_t width = sample.take.channels, last = (sample.take.frames - 1) * width;
  for (std::size_t c = 0; c < width; ++c) EXPECT_EQ(once.truth[c], sample.truth[last + c]);
  EXPECT_EQ(in_form(once, {false, true}, mirror).take.measured, sample.take.measured);
  EXPECT_EQ(in_form(once, {false, true}, mirror).take.marks, sample.take.marks);
}

TEST(RecurrentSamples, OfAnotherBodyKeepTheirErrorsButForTheScale) {
  const RecurrentSample sample =
      recurrent_sample(walks().layout, 120, sequence_at(walks(), 0).poses, Random(4));
  const RecurrentSample other = of_another_body(sample, 5, 1.5, Random(2));
  const double before = error(sample.take.measured, sample.truth);
  const double after = error(other.take.measured, other.truth);
  ASSERT_GT(before, 0);
  EXPECT_NE(before, after);
  EXPECT_LT(std::abs(std::log(after / before)), std::log(1.5) + 1e-4);
  EXPECT_NEAR(error(other.take.automatic, other.truth) / error(sample.take.automatic, sample.truth),
              after / before, 1e-3);
}

TEST(RecurrentForms, ATrackWhosePartnerHasAnotherIsItsOwn) {
  BodyLayout layout;
  layout.names = {"LeftArm", "RArm", "RightArm", "LArm", "Lamp"};
  layout.parents = {-1, 0, 0, 0, 0};
  layout.with_place = false;
  EXPECT_EQ(mirror_of(layout).partners, (std::vector<std::size_t>{2, 3, 0, 1, 4}));
}

TEST(RecurrentStatistics, AreMeansAndDeviationsOfTheChannels) {
  const RecurrentStatistics statistics = recurrent_statistics(walks());
  double sum = 0, square = 0, count = 0;
  for (std::size_t i = 0; i < walks().entries.size(); ++i) {
    const PoseMatrix poses = sequence_at(walks(), i).poses;
    for (std::size_t f = 0; f < poses.frames; ++f) {
      sum += poses(f, 3), square += poses(f, 3) * poses(f, 3);
      ++count;
    }
  }
  EXPECT_NEAR(statistics.mean[3], sum / count, 1e-3);
  EXPECT_NEAR(statistics.deviation[3],
              std::max(0.5, std::sqrt(square / count - sum * sum / count / count)), 1e-3);
}

}  // namespace
}  // namespace kinemend
