#include "priors/recurrent_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "random_values.hpp"

namespace kinemend {
namespace {

constexpr std::size_t input_channels = 6;

std::vector<float> random_floats(std::size_t count, std::uint64_t seed, double size = 1) {
  std::vector<float> values;
  for (const double value : test::random_values(count, seed))
    values.push_back(static_cast<float>(size * value));
  return values;
}

RecurrentStatistics unit_statistics() {
  return {std::vector<float>(input_channels, 0.0F), std::vector<float>(input_channels, 1.0F),
          std::vector<float>(input_channels, 1.0F)};
}

// A slow wave and what was taken away from it.
RecurrentTake random_take(std::size_t frames) {
  RecurrentTake take;
  take.frames = frames;
  take.channels = input_channels;
  take.measured = random_floats(frames * input_channels, 1, 0.5);
  for (std::size_t i = 0; i < frames * input_channels; ++i) {
    take.automatic.push_back(
        static_cast<float>(10 * std::sin(0.02 * static_cast<double>(i / input_channels))));
    take.measured[i] += take.automatic[i];
  }
  take.marks.assign(frames * input_channels / 3, 0);
  return take;
}

TEST(RecurrentInput, TheBandsOfWhatWasTakenAwayAddUpToIt) {
  const RecurrentTake take = random_take(157);
  const RecurrentInput input = recurrent_input(take, unit_statistics());
  for (std::size_t f = 0; f < take.frames; ++f) {
    for (std::size_t c = 0; c < input_channels; ++c) {
      float sum = 0;
      for (std::size_t k = 0; k < 6; ++k)
        sum += input.bands[(f * recurrent_bands + k) * input_channels + c];
      const std::size_t i = f * input_channels + c;
      EXPECT_NEAR(sum, take.measured[i] - take.automatic[i], 1e-4);
    }
  }
}

TEST(RecurrentInput, ASmoothCurveHasNothingInTheBandsOfWhatWasLeftButAtItsEnds) {
  const RecurrentTake take = random_take(300);
  const RecurrentInput input = recurrent_input(take, unit_statistics());
  for (std::size_t f = 60; f < 240; ++f) {
    for (std::size_t k = 6; k < 8; ++k)
      EXPECT_LT(std::abs(input.bands[(f * recurrent_bands + k) * input_channels]), 0.05F);
  }
}

TEST(RecurrentInput, TheScaleIsTheDeviationOfWhatWasTakenAway) {
  const RecurrentInput input = recurrent_input(random_take(2000), unit_statistics());
  for (const float scale : input.scales) EXPECT_NEAR(scale, 0.5, 0.03);
}

TEST(RecurrentInput, MarkedSamplesCountForNothing) {
  RecurrentTake take = random_take(200), other = take;
  take.marks[40 * 2] = other.marks[40 * 2] = 1;
  for (std::size_t c = 0; c < 3; ++c) other.measured[40 * input_channels + c] += 1000;
  const RecurrentInput a = recurrent_input(take, unit_statistics());
  const RecurrentInput b = recurrent_input(other, unit_statistics());
  EXPECT_EQ(a.features, b.features);
  EXPECT_EQ(a.bands, b.bands);
}

TEST(RecurrentInput, ATrackThatWasNeverSeenShowsNothingButThat) {
  RecurrentTake take = random_take(32);
  for (std::size_t f = 0; f < take.frames; ++f) take.marks[f * 2] = 1;
  const RecurrentInput input = recurrent_input(take, unit_statistics());
  const std::size_t width = recurrent_feature_count(input_channels);
  ASSERT_EQ(input.features.size(), 8 * width);
  for (std::size_t i = 0; i < width; ++i) {
    const bool is_mark = i >= 11 * input_channels;
    if (is_mark ? i % 2 == 0 : i % input_channels < 3) {
      EXPECT_EQ(input.features[width + i], is_mark ? 1.0F : 0.0F) << i;
    }
  }
}

TEST(RecurrentCorrection, IsNothingWhereNothingWasTakenAway) {
  RecurrentTake take = random_take(50);
  take.measured = take.automatic;
  const RecurrentInput input = recurrent_input(take, unit_statistics());
  const auto outputs = random_floats(input.steps * recurrent_output_count(input_channels), 3);
  std::vector<float> correction(50 * input_channels, 1.0F);
  recurrent_correction(input, outputs, correction);
  EXPECT_EQ(correction, std::vector<float>(50 * input_channels, 0.0F));
}

TEST(RecurrentCorrection, OfGainsOfOneGivesBackWhatWasTakenAway) {
  const RecurrentTake take = random_take(53);
  const RecurrentInput input = recurrent_input(take, unit_statistics());
  const std::size_t width = recurrent_output_count(input_channels);
  std::vector<float> outputs(input.steps * width, 0.0F);
  for (std::size_t t = 0; t < input.steps; ++t)
    std::fill_n(outputs.begin() + static_cast<std::ptrdiff_t>(t * width), 6 * input_channels, 1.0F);
  std::vector<float> correction(53 * input_channels);
  recurrent_correction(input, outputs, correction);
  for (std::size_t i = 0; i < correction.size(); ++i) {
    const float scale = input.scales[i % input_channels];
    const float expected = (take.measured[i] - take.automatic[i]) * scale / (scale + 0.02F);
    EXPECT_NEAR(correction[i], expected, 1e-4);
  }
}

TEST(RecurrentCorrection, HasAnAdjointWithTheSameProduct) {
  const RecurrentInput input = recurrent_input(random_take(61), unit_statistics());
  const auto outputs = random_floats(input.steps * recurrent_output_count(input_channels), 4);
  const auto derivative = random_floats(61 * input_channels, 5);
  std::vector<float> correction(derivative.size()), gradient(outputs.size());
  recurrent_correction(input, outputs, correction);
  recurrent_correction_adjoint(input, derivative, gradient);
  const auto product = [](const std::vector<float>& a, const std::vector<float>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  EXPECT_NEAR(product(correction, derivative), product(outputs, gradient), 1e-3);
}

}  // namespace
}  // namespace kinemend
