#include "priors/recurrent_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "random_values.hpp"
#include "recurrent_support.hpp"

namespace kinemend {
namespace {

using test::constant_network_model;

constexpr std::size_t filter_channels = 6;

struct Take {
  PoseMatrix measured, automatic;
  std::vector<std::uint8_t> missing;
  double rate_hz;

  RecurrentFacts facts() const { return {measured, automatic, missing, rate_hz}; }
};

Take noisy_take(std::size_t frames, double rate_hz) {
  Take take{PoseMatrix(frames, filter_channels), PoseMatrix(frames, filter_channels),
            std::vector<std::uint8_t>(frames * filter_channels), rate_hz};
  const std::vector<double> noise = test::random_values(frames * filter_channels, 1);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    take.automatic.values[i] =
        20 * std::sin(2 * static_cast<double>(i / filter_channels) / rate_hz);
    take.measured.values[i] = take.automatic.values[i] + noise[i];
  }
  return take;
}

TEST(RecurrentFilter, OfANetworkThatSaysNothingIsAuto) {
  const RecurrentNetwork network = recurrent_network_of(constant_network_model(0, 0));
  for (const double rate_hz : {24.0, 60.0, 119.88, 120.0, 250.0, 1000.0}) {
    const Take take = noisy_take(97, rate_hz);
    EXPECT_EQ(recurrent_filter(network, take.facts()).values, take.automatic.values) << rate_hz;
  }
}

TEST(RecurrentFilter, OfGainsOfOneIsWhatWasMeasuredAtTheNetworksRate) {
  const RecurrentNetwork network = recurrent_network_of(constant_network_model(6, 1));
  // Longer than a stretch: where two of them meet their shares add up to one.
  const Take take = noisy_take(9000, 120);
  const PoseMatrix result = recurrent_filter(network, take.facts());
  for (std::size_t i = 0; i < result.values.size(); ++i)
    ASSERT_NEAR(result.values[i], take.measured.values[i], 0.15) << "frame " << i / filter_channels;
}

TEST(RecurrentFilter, KeepsItsTimeAtOtherRates) {
  const RecurrentNetwork network = recurrent_network_of(constant_network_model(6, 1));
  for (const double rate_hz : {30.0, 60.0, 100.0, 240.0}) {
    Take take = noisy_take(400, rate_hz);
    // A slow difference to what was measured, which every rate can carry.
    for (std::size_t i = 0; i < take.measured.values.size(); ++i)
      take.measured.values[i] = take.automatic.values[i] +
                                std::sin(3 * static_cast<double>(i / filter_channels) / rate_hz);
    const PoseMatrix result = recurrent_filter(network, take.facts());
    for (std::size_t i = 0; i < result.values.size(); ++i)
      ASSERT_NEAR(result.values[i], take.measured.values[i], 0.06)
          << rate_hz << " Hz, frame " << i / filter_channels;
  }
}

TEST(RecurrentFilter, ReadsNothingWhereSamplesAreMissing) {
  const RecurrentNetwork network = recurrent_network_of(test::small_network_model());
  Take take = noisy_take(300, 120);
  for (std::size_t f = 100; f < 120; ++f) {
    for (std::size_t c = 0; c < 3; ++c) take.missing[f * filter_channels + c] = 1;
  }
  const PoseMatrix before = recurrent_filter(network, take.facts());
  for (std::size_t f = 100; f < 120; ++f) take.measured(f, 0) = 1e6;
  EXPECT_EQ(recurrent_filter(network, take.facts()).values, before.values);
}

TEST(GuardedRecurrentFilter, TakesNothingFromANetworkThatBringsTheNoiseBack) {
  const Model model = constant_network_model(6, 1);
  const RecurrentNetwork network = recurrent_network_of(model);
  const Take take = noisy_take(600, 120);
  std::vector<double> shares;
  const PoseMatrix result = guarded_recurrent_filter(network, model.layout, take.facts(), &shares);
  for (const double share : shares) EXPECT_LT(share, 0.05);
  for (std::size_t i = 0; i < result.values.size(); ++i)
    ASSERT_NEAR(result.values[i], take.automatic.values[i], 0.2);
}

TEST(GuardedRecurrentFilter, AddsTheShareOfTheCorrectionThatItFinds) {
  const Model model = constant_network_model(1, 0.02);
  const RecurrentNetwork network = recurrent_network_of(model);
  Take take = noisy_take(600, 120);
  std::vector<double> shares;
  const PoseMatrix result = guarded_recurrent_filter(network, model.layout, take.facts(), &shares);
  const PoseMatrix whole = recurrent_filter(network, take.facts());
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const double a = take.automatic.values[i];
    ASSERT_NEAR(result.values[i] - a, shares[i % filter_channels / 3] * (whole.values[i] - a),
                1e-9);
  }
  for (const double share : shares) EXPECT_TRUE(share >= 0 && share <= 1);
}

TEST(GuardedRecurrentFilter, LeavesToAutoLowRatesHeldSamplesAndThePlace) {
  const Model model = constant_network_model(1, 0.5);
  const RecurrentNetwork network = recurrent_network_of(model);
  Take held = noisy_take(600, 120);
  for (std::size_t i = 0; i < held.measured.values.size(); ++i) {
    if (i / filter_channels % 2 == 1)
      held.measured.values[i] = held.measured.values[i - filter_channels];
  }
  for (const Take& take : {noisy_take(200, 30), held}) {
    std::vector<double> shares;
    const PoseMatrix result =
        guarded_recurrent_filter(network, model.layout, take.facts(), &shares);
    EXPECT_EQ(shares, (std::vector<double>{0, 0}));
    EXPECT_EQ(result.values, take.automatic.values);
  }
  std::vector<double> shares;
  guarded_recurrent_filter(network, model.layout, noisy_take(600, 120).facts(), &shares);
  EXPECT_EQ(shares.back(), 0);
}

TEST(RecurrentFilter, TakesAnyNumberOfFrames) {
  const RecurrentNetwork network = recurrent_network_of(test::small_network_model());
  for (const std::size_t frames : {0UL, 1UL, 2UL, 3UL, 4UL, 5UL, 4351UL, 4352UL, 4353UL}) {
    for (const double rate_hz : {50.0, 120.0, 300.0}) {
      const PoseMatrix result = recurrent_filter(network, noisy_take(frames, rate_hz).facts());
      ASSERT_EQ(result.frames, frames);
      for (const double value : result.values) ASSERT_TRUE(std::isfinite(value));
      if (frames > 5) continue;
      const PoseMatrix guarded = guarded_recurrent_filter(
          network, test::small_network_model().layout, noisy_take(frames, rate_hz).facts());
      for (const double value : guarded.values) ASSERT_TRUE(std::isfinite(value));
    }
  }
}

}  // namespace
}  // namespace kinemend
