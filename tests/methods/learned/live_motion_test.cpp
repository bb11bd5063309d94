// The frame-by-frame learned cleaner agrees with the offline one on takes cut at its lookahead.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "methods/learned/learned_live.hpp"
#include "motion_support.hpp"

namespace kinemend {
namespace {

using test::one_smoother_model;
using test::small_motion_model;
using test::small_motion_take;

MotionTake swinging_take(std::size_t frames, double rate_hz, double noise_deg) {
  MotionTake take;
  take.frames = frames;
  take.channels = 6;
  take.frame_rate_hz = rate_hz;
  take.slots = {0, 1, 2, -1, -1, -1};
  take.is_position = {0, 0, 0, 1, 1, 1};
  Random random(7);
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t c = 0; c < 6; ++c) {
      const double time = static_cast<double>(f) / rate_hz;
      const double swing = 5 + 20 * std::sin(time * (2 + static_cast<double>(c)));
      take.values.push_back(static_cast<float>(swing + noise_deg * random.normal()));
    }
  }
  return take;
}

std::span<const float> frame_values(const MotionTake& take, std::size_t frame) {
  return std::span(take.values).subspan(frame * take.channels, take.channels);
}
std::span<const std::uint8_t> frame_marks(const MotionTake& take, std::size_t frame) {
  if (take.missing.empty()) return {};
  return std::span(take.missing).subspan(frame * take.channels, take.channels);
}

std::vector<MotionSteps> live_steps(const MotionTake& take) {
  LiveMotionSteps live(take.frame_rate_hz, take.is_position, take.expects_slow_noise);
  std::vector<MotionSteps> steps;
  MotionSteps step;
  for (std::size_t f = 0; f < take.frames; ++f) {
    live.push(frame_values(take, f), frame_marks(take, f));
    while (live.next_step(step)) steps.push_back(step);
  }
  live.end();
  while (live.next_step(step)) steps.push_back(step);
  return steps;
}

std::vector<float> live_filtered(const MotionNetwork& network, const MotionTake& take) {
  LiveMotionFilter filter(network, take.frame_rate_hz, take.slots, take.is_position,
                          take.expects_slow_noise);
  std::vector<float> result, row(take.channels);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const bool came = filter.push(frame_values(take, f), frame_marks(take, f), row);
    EXPECT_EQ(came, f >= filter.ahead());
    if (came) result.insert(result.end(), row.begin(), row.end());
  }
  while (filter.flush(row)) result.insert(result.end(), row.begin(), row.end());
  return result;
}

// The frames up to `last` after a still lead-in of two seconds or more.
MotionTake cut_take(const MotionTake& take, std::size_t last, std::size_t still) {
  MotionTake cut = take;
  cut.frames = still + last + 1;
  cut.values.clear();
  for (std::size_t f = 0; f < cut.frames; ++f) {
    const std::span<const float> row = frame_values(take, f < still ? 0 : f - still);
    cut.values.insert(cut.values.end(), row.begin(), row.end());
  }
  return cut;
}

TEST(LiveMotion, LooksAnEighthOfASecondAheadAndAtMost14FramesOrToTheNextStep) {
  EXPECT_EQ(live_motion_ahead(25), 3u);
  EXPECT_EQ(live_motion_ahead(60), 7u);
  EXPECT_EQ(live_motion_ahead(120), 14u);
  EXPECT_EQ(live_motion_ahead(240), 14u);
  EXPECT_EQ(live_motion_ahead(480), 17u);
  EXPECT_EQ(live_motion_ahead(1000), 34u);
}

TEST(LiveMotion, ReadsEachStepAsOfATakeThatEndsWhereItLooksAheadTo) {
  for (const double rate_hz : {60.0, 90.0, 120.0, 240.0}) {
    const MotionTake take = swinging_take(static_cast<std::size_t>(6 * rate_hz), rate_hz, 2);
    const std::vector<MotionSteps> steps = live_steps(take);
    ASSERT_EQ(steps.size(), take.steps());
    const auto frames_of_step = static_cast<std::size_t>(rate_hz / motion_steps_hz);
    const std::size_t ahead = live_motion_ahead(rate_hz) - frames_of_step;
    for (std::size_t s = 0; s < steps.size(); s += 7) {
      const std::size_t last = std::min(frames_of_step * s + ahead, take.frames - 1);
      const MotionTake cut = cut_take(take, last, 80 * frames_of_step);
      const MotionReader reader(cut);
      const MotionSteps expected = reader.steps(80 + s, 1);
      for (std::size_t c = 0; c < take.channels; ++c) {
        const std::size_t levels = c * motion_levels, scales = c * motion_scales;
        for (std::size_t i = 0; i < motion_levels; ++i) {
          ASSERT_NEAR(steps[s].levels[levels + i], expected.levels[levels + i], 1e-4);
          ASSERT_NEAR(steps[s].changes[levels + i], expected.changes[levels + i], 1e-3)
              << rate_hz << " Hz, step " << s << ", level " << i;
        }
        for (std::size_t i = 0; i + 1 < motion_scales; ++i)
          ASSERT_NEAR(steps[s].scales[scales + i], expected.scales[scales + i], 1e-3);
        for (std::size_t i = 0; i < motion_bands; ++i)
          ASSERT_NEAR(steps[s].features[c * motion_features + i],
                      expected.features[c * motion_features + i], 1e-3);
      }
    }
  }
}

TEST(LiveMotion, TellsTheStrengthsOfTheLast128Steps) {
  const MotionTake take = swinging_take(1200, 120, 1);
  const std::vector<MotionSteps> steps = live_steps(take);
  for (const std::size_t s : {std::size_t{0}, std::size_t{5}, std::size_t{290}}) {
    const std::size_t first = s < 128 ? 0 : s - 127;
    for (std::size_t c = 0; c < take.channels; ++c) {
      for (std::size_t band = 0; band < motion_bands; ++band) {
        double sum = 0;
        for (std::size_t i = first; i <= s; ++i) {
          const double feature = steps[i].features[c * motion_features + band];
          sum += std::exp(4 * (feature - 0.5));
        }
        const double expected = 0.25 * std::log(sum / static_cast<double>(s - first + 1)) + 0.5;
        EXPECT_NEAR(steps[s].take_features[c * motion_take_features + band], expected, 1e-3);
      }
    }
  }
}

TEST(LiveMotion, TheNetworkMakesTheSameStepByStepAsOfAllStepsAtOnce) {
  const MotionNetwork network = live_form(motion_network_of(small_motion_model()));
  const MotionTake take = swinging_take(900, 120, 2);
  const std::vector<MotionSteps> steps = live_steps(take);
  const std::vector<std::uint8_t> is_alive(take.channels, 1);
  MotionSteps all;
  all.resize(take.channels, steps.size());
  all.take_features.resize(take.channels * steps.size() * motion_take_features);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const auto put = [&](const std::vector<float>& from, std::vector<float>& to) {
      const std::size_t width = from.size() / take.channels;
      for (std::size_t c = 0; c < take.channels; ++c)
        std::copy_n(from.data() + c * width, width, to.data() + (c * steps.size() + s) * width);
    };
    put(steps[s].features, all.features);
    put(steps[s].take_features, all.take_features);
    put(steps[s].levels, all.levels);
    put(steps[s].changes, all.changes);
    put(steps[s].scales, all.scales);
  }
  const std::vector<float> expected = run(network, {take.slots, is_alive}, all);
  LiveMotionNetwork live(network, take.slots);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const std::span<const float> outputs = live.run(steps[s], is_alive);
    for (std::size_t c = 0; c < take.channels; ++c) {
      for (std::size_t i = 0; i < motion_outputs; ++i)
        ASSERT_NEAR(outputs[c * motion_outputs + i],
                    expected[(c * steps.size() + s) * motion_outputs + i], 2e-4)
            << "step " << s;
    }
  }
}

TEST(LiveMotion, AgreesWithLibTorchOnTheSameWeights) {
  const Model model = small_motion_model();
  const MotionNetwork network = live_form(motion_network_of(model));
  const MotionTake take = small_motion_take(model);
  const std::vector<double>& expected = model.tensors.at("live_outputs").values;
  const std::size_t count = expected.size() / take.channels / motion_outputs;
  const std::vector<MotionSteps> steps = live_steps(take);
  const std::vector<std::uint8_t> is_alive(take.channels, 1);
  LiveMotionNetwork live(network, take.slots);
  for (std::size_t s = 0; s < count; ++s) {
    const std::span<const float> outputs = live.run(steps[s], is_alive);
    for (std::size_t c = 0; c < take.channels; ++c) {
      for (std::size_t i = 0; i < motion_outputs; ++i)
        ASSERT_NEAR(outputs[c * motion_outputs + i], expected[(c * count + s) * motion_outputs + i],
                    1e-3);
    }
  }
}

TEST(LiveMotion, MixesTheLevelsOfATakeThatEndsWhereItLooksAheadTo) {
  constexpr std::size_t smoother = 7;
  const MotionNetwork network = live_form(motion_network_of(one_smoother_model(smoother)));
  for (const double rate_hz : {25.0, 60.0, 100.0, 120.0, 240.0}) {
    const MotionTake take = swinging_take(600, rate_hz, 2);
    const std::vector<float> result = live_filtered(network, take);
    ASSERT_EQ(result.size(), take.values.size());
    const SmootherBank bank(rate_hz);
    std::vector<float> level(take.channels);
    for (std::size_t f = 0; f < take.frames; f += 11) {
      const std::size_t last = std::min(f + live_motion_ahead(rate_hz), take.frames - 1);
      const MotionTake cut = cut_take(take, last, 400);
      const ExtendedChannels extended = bank.extended(cut.values, take.channels);
      bank.level(extended, smoother, static_cast<std::ptrdiff_t>(400 + f), 1, level);
      for (std::size_t c = 0; c < take.channels; ++c)
        ASSERT_NEAR(result[f * take.channels + c], level[c], 2e-4) << rate_hz << " Hz, frame " << f;
    }
  }
}

TEST(LiveMotion, GivesTheTakeBackWhereTheNetworkAsksForNoSmoother) {
  const MotionNetwork network = live_form(motion_network_of(one_smoother_model(0)));
  for (const double rate_hz : {25.0, 47.0, 120.0, 240.0}) {
    for (const std::size_t frames : {1, 2, 3, 9, 700}) {
      MotionTake take = swinging_take(frames, rate_hz, 1);
      for (std::size_t f = 0; f < frames; ++f) take.values[6 * f + 4] = 7;
      const std::vector<float> result = live_filtered(network, take);
      ASSERT_EQ(result.size(), take.values.size());
      for (std::size_t i = 0; i < result.size(); ++i)
        ASSERT_NEAR(result[i], take.values[i], 1e-4) << rate_hz << " Hz, " << frames << " frames";
    }
  }
}

TEST(LiveMotion, HoldsWhatIsMissingAndJoinsItByALineWhatNeverStandsThere) {
  const MotionNetwork network = live_form(motion_network_of(one_smoother_model(0)));
  MotionTake take = swinging_take(400, 120, 0);
  take.missing.assign(take.values.size(), 0);
  MotionTake other = take;
  const auto hide = [&](std::size_t channel, std::size_t first, std::size_t last) {
    for (std::size_t f = first; f <= last; ++f) {
      for (MotionTake* one : {&take, &other}) one->missing[6 * f + channel] = 1;
      other.values[6 * f + channel] = -400;
    }
  };
  hide(1, 100, 109);  // ends before its frames are output
  hide(2, 200, 259);
  hide(3, 0, 30);
  const std::vector<float> result = live_filtered(network, take);
  EXPECT_EQ(result, live_filtered(network, other));
  for (std::size_t f = 100; f < 110; ++f) {
    const float share = static_cast<float>(f - 99) / 11;
    const float from = take.values[6 * 99 + 1], to = take.values[6 * 110 + 1];
    EXPECT_NEAR(result[6 * f + 1], from + share * (to - from), 1e-3);
  }
  // Frames that were output before the end of the gap hold the last sample.
  for (std::size_t f = 200; f < 245; ++f)
    EXPECT_NEAR(result[6 * f + 2], take.values[6 * 199 + 2], 1e-3);
  for (std::size_t f = 0; f < 16; ++f) EXPECT_TRUE(std::isfinite(result[6 * f + 3]));
  EXPECT_NEAR(result[6 * 25 + 3], take.values[6 * 31 + 3], 1e-3);
}

}  // namespace
}  // namespace kinemend
