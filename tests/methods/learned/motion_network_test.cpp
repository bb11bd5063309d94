// Tests of the network of `learned` and the parts before and after it, against LibTorch.
#include "methods/learned/motion_network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "methods/learned/motion_filter.hpp"
#include "motion_support.hpp"

namespace kinemend {
namespace {

using test::small_motion_model;
using test::small_motion_take;

// A take of two tracks that swing at several frequencies under a little noise.
MotionTake swinging(std::size_t frames, double rate_hz, double noise_deg) {
  MotionTake take;
  take.frames = frames;
  take.channels = 6;
  take.frame_rate_hz = rate_hz;
  take.slots = {0, 1, 2, -1, -1, -1};
  take.is_position.assign(6, 0);
  Random random(3);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t c = 0; c < 6; ++c) {
      const double time = static_cast<double>(f) / rate_hz;
      const double swing = 20 * std::sin(time * (2 + static_cast<double>(c)));
      take.values.push_back(static_cast<float>(swing + noise_deg * random.normal()));
    }
  }
  return take;
}

MotionChannels told_of(const MotionReader& reader) {
  return {reader.take().slots, reader.strengths().is_alive};
}

TEST(SmootherBank, KeepsStraightLinesUpToTheirEnds) {
  for (const double rate_hz : {25.0, 60.0, 120.0, 240.0}) {
    const SmootherBank bank(rate_hz);
    std::vector<float> line;
    for (int f = 0; f < 500; ++f) line.push_back(static_cast<float>(3 - 0.25 * f));
    const ExtendedChannels extended = bank.extended(line, 1);
    std::vector<float> result(line.size());
    for (std::size_t level = 0; level < bank_levels; ++level) {
      bank.level(extended, level, 0, line.size(), result);
      for (std::size_t f = 0; f < line.size(); ++f)
        ASSERT_NEAR(result[f], line[f], 2e-4) << rate_hz << " Hz, level " << level;
    }
  }
}

TEST(SmootherBank, SpreadsAnImpulseByTheWidthOfItsLevel) {
  const double rate_hz = 120;
  const SmootherBank bank(rate_hz);
  std::vector<float> impulse(401, 0.0F), result(impulse.size());
  impulse[200] = 1;
  const ExtendedChannels extended = bank.extended(impulse, 1);
  for (std::size_t level = 1; level < bank_levels; ++level) {
    bank.level(extended, level, 0, impulse.size(), result);
    double sum = 0, square = 0;
    for (std::size_t f = 0; f < result.size(); ++f) {
      const double away = (static_cast<double>(f) - 200) / rate_hz;
      sum += static_cast<double>(result[f]);
      square += away * away * static_cast<double>(result[f]);
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    // Truncation at 3.3 deviations reduces the deviation of a Gaussian by 1 %.
    EXPECT_NEAR(std::sqrt(square), bank_widths_s[level - 1], 0.02 * bank_widths_s[level - 1]);
  }
}

TEST(MotionSteps, TellStrengthsThatNoiseOfThisDeviationHas) {
  MotionTake take = swinging(20000, 120, 0);
  Random random(11);
  for (float& value : take.values) value = static_cast<float>(2 * random.normal());
  const MotionReader reader(take);
  // The variance of white noise between two Gaussians is the sum of squares of their kernels'
  // difference.
  const SmootherBank& bank = reader.bank();
  std::vector<float> impulse(401, 0.0F), upper(impulse.size()), lower(impulse.size());
  impulse[200] = 1;
  const ExtendedChannels extended = bank.extended(impulse, 1);
  for (std::size_t band = 0; band < 5; ++band) {
    bank.level(extended, band, 0, impulse.size(), upper);
    bank.level(extended, band + 1, 0, impulse.size(), lower);
    double power = 0;
    for (std::size_t f = 0; f < impulse.size(); ++f)
      power += std::pow(static_cast<double>(upper[f] - lower[f]), 2);
    const double expected = 2 * std::sqrt(power);
    EXPECT_NEAR(reader.strengths().bands[band], expected, 0.12 * expected) << "band " << band;
  }
}

TEST(MotionNetwork, AgreesWithLibTorchOnTheSameWeights) {
  const Model model = small_motion_model();
  const MotionTake take = small_motion_take(model);
  const MotionReader reader(take);
  const std::vector<double>& expected = model.tensors.at("outputs").values;
  const std::size_t steps = expected.size() / take.channels / motion_outputs;
  const std::vector<float> outputs =
      run(motion_network_of(model), told_of(reader), reader.steps(0, steps));
  ASSERT_EQ(outputs.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    ASSERT_NEAR(outputs[i], expected[i], 1e-3) << "number " << i;
}

TEST(MotionNetwork, ThatDoesNotFitItselfOrItsBodyIsRefusedWithTheLayer) {
  const auto message_of = [](const Model& model) -> std::string {
    try {
      motion_network_of(model);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  Model model = small_motion_model();
  model.tensors.erase("block1.dense.bias");
  EXPECT_EQ(message_of(model), "tensor block1.dense.bias is missing");
  model = small_motion_model();
  model.numbers["block0.dilation"] = 0;
  EXPECT_EQ(message_of(model), "the model's block0.dilation is not between 1 and 4096");
  model = small_motion_model();
  model.tensors["speed"].values[2] = 0;
  EXPECT_EQ(message_of(model), "the model's speed is not positive everywhere");
  model = small_motion_model();
  model.tensors["output.weight"] = {TensorType::f32, {5, 7}, std::vector<double>(35)};
  model.tensors["output.bias"] = {TensorType::f32, {5}, std::vector<double>(5)};
  EXPECT_THAT(message_of(model), testing::HasSubstr("the model's layer output"));
}

TEST(MotionFilter, MakesTheSameOfPartsAsOfTheWhole) {
  const MotionNetwork network = motion_network_of(small_motion_model());
  const MotionTake take = swinging(4000, 120, 1);
  const MotionReader reader(take);
  const std::vector<float> whole = run(network, told_of(reader), reader.steps(0, 800));
  const std::size_t first = 300, count = 100, reach = network.reach();
  const std::vector<float> part =
      run(network, told_of(reader), reader.steps(first - reach, count + 2 * reach));
  for (std::size_t c = 0; c < take.channels; ++c) {
    for (std::size_t s = 0; s < count; ++s) {
      for (std::size_t i = 0; i < motion_outputs; ++i) {
        const std::size_t there = (c * 800 + first + s) * motion_outputs + i;
        const std::size_t here = (c * (count + 2 * reach) + reach + s) * motion_outputs + i;
        ASSERT_NEAR(part[here], whole[there], 1e-4);
      }
    }
  }
}

TEST(MotionFilter, GivesTheTakeBackWhereTheNetworkAsksForNoSmoother) {
  const MotionNetwork network = motion_network_of(test::one_smoother_model(0));
  for (const double rate_hz : {25.0, 47.0, 120.0, 240.0}) {
    const MotionTake take = swinging(1500, rate_hz, 1);
    const MotionResult result = filtered(network, take);
    for (std::size_t i = 0; i < take.values.size(); ++i)
      ASSERT_NEAR(result.values[i], take.values[i], 1e-4) << rate_hz << " Hz";
  }
}

TEST(MotionFilter, KeepsShortTakesAndChannelsThatStandStill) {
  const MotionNetwork network = motion_network_of(small_motion_model());
  for (const std::size_t frames : {1, 2, 3, 5, 9}) {
    MotionTake take = swinging(frames, 120, 1);
    for (std::size_t f = 0; f < frames; ++f) take.values[6 * f + 4] = 7;
    const MotionResult result = filtered(network, take);
    ASSERT_EQ(result.values.size(), take.values.size());
    for (std::size_t f = 0; f < frames; ++f) {
      EXPECT_EQ(result.values[6 * f + 4], 7);
      for (std::size_t c = 0; c < 6; ++c) EXPECT_TRUE(std::isfinite(result.values[6 * f + c]));
    }
  }
}

}  // namespace
}  // namespace kinemend
