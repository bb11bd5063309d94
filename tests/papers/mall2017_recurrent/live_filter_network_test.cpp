// Tests of a network of Mall et al. 2017 on a stream, against its result on whole takes.
#include "papers/mall2017_recurrent/live_filter_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "papers/mall2017_recurrent/random_filter_model.hpp"

namespace kinemend {
namespace {

using test::RandomNetwork;

constexpr std::size_t delay = LiveFilterNetwork::delay, period = LiveFilterNetwork::period;
constexpr std::size_t frame_count = 90;

// Random motion of joint channels about a turning root.
struct Motion {
  FilterTake take;
  std::vector<Quat> roots;
};

Motion motion(std::size_t channels, std::size_t frames = frame_count) {
  Random random(3);
  Motion made;
  made.take.frames = frames;
  made.take.channels = channels;
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t c = 0; c < channels; ++c) {
      const double t = static_cast<double>(f) / 20 + static_cast<double>(c);
      made.take.values.push_back(static_cast<float>(20 * std::sin(t) + random.uniform(-2, 2)));
    }
    made.roots.push_back(exp(Vec3{0.1 * std::sin(0.1 * static_cast<double>(f)),
                                  0.02 * static_cast<double>(f), random.uniform(0, 0.01)}));
  }
  made.take.missing.assign(frames * channels / 3, 0);
  return made;
}

// The first `frames` frames, in the form of `filter_take_of`.
FilterTake cut(const Motion& whole, std::size_t frames, double rate_hz) {
  FilterTake take;
  take.frames = frames;
  take.channels = whole.take.channels;
  take.values.assign(
      whole.take.values.begin(),
      whole.take.values.begin() + static_cast<std::ptrdiff_t>(frames * take.channels));
  take.missing.assign(frames * take.channels / 3, 0);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t before = f > 0 ? f - 1 : f, after = std::min(f + 1, frames - 1);
    const double steps = static_cast<double>(std::max<std::size_t>(after - before, 1));
    const Vec3 turn = rate_hz * degrees_per_radian / steps *
                      log(conjugate(whole.roots[before]) * whole.roots[after]);
    for (const double value : {turn.x, turn.y, turn.z})
      take.turning.push_back(static_cast<float>(value));
  }
  return take;
}

std::vector<float> live(LiveFilterNetwork& network, const Motion& motion) {
  const FilterTake& take = motion.take;
  std::vector<float> result, row(take.channels);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const LiveFilterNetwork::Input input{
        {take.values.data() + f * take.channels, take.channels},
        {take.missing.data() + f * take.channels / 3, take.channels / 3},
        motion.roots[f]};
    const bool came = network.push(input, row);
    EXPECT_EQ(came, f >= delay);
    if (came) result.insert(result.end(), row.begin(), row.end());
  }
  while (network.flush(row)) result.insert(result.end(), row.begin(), row.end());
  return result;
}

// The newest frame that the outputs for frame t use. A pass computes three outputs and starts when
// the first has 13 frames ahead; at the end, it uses all remaining frames.
std::size_t newest(std::size_t t, std::size_t frames, bool is_recurrent) {
  if (!is_recurrent) return std::min(t + delay, frames - 1);
  return std::min(t / period * period + delay + 1 - period, frames - 1);
}

// With one recurrent layer the carried state covers the whole past. Outputs equal those of the take
// up to the newest frame, provided the inputs of earlier frames do not change; roughness would
// change them.
TEST(LiveFilterNetwork, GivesWhatTheNetworkSaysOfTheTakeSoFar) {
  for (const RandomNetwork kind :
       {RandomNetwork{.layers = 1}, RandomNetwork{.layers = 0, .reach = 15}}) {
    const FilterNetwork network = filter_network_of(test::random_filter_model(kind));
    const Motion whole = motion(network.channels());
    LiveFilterNetwork stream(network, 120);
    const std::vector<float> result = live(stream, whole);
    ASSERT_EQ(result.size(), whole.take.values.size());
    for (std::size_t t = 0; t < frame_count; ++t) {
      // The filter uses all 15 frames ahead, even if the network used fewer.
      const std::size_t seen = newest(t, frame_count, kind.layers > 0) + 1;
      const FilterTake so_far = cut(whole, seen, 120);
      std::vector<float> outputs =
          run(network, filter_features(so_far, network.statistics, network.inputs));
      const FilterTake ahead = cut(whole, std::min(t + delay + 1, frame_count), 120);
      const std::size_t width = network.decoder.back().outputs();
      outputs.resize(ahead.frames * width);
      std::vector<float> wanted(ahead.values.size());
      apply_predicted_filter(
          network.head,
          {ahead.frames, ahead.channels, ahead.values, network.statistics.deviation, {}}, outputs,
          wanted);
      for (std::size_t c = 0; c < network.channels(); ++c)
        EXPECT_NEAR(result[t * network.channels() + c], wanted[t * network.channels() + c], 2e-4)
            << "frame " << t << " of " << kind.layers << " layers";
    }
  }
}

// At the first frame no state is carried, so any network equals that of the take so far, with all
// inputs. The same holds for dense layers alone, except for the roughness of earlier frames.
TEST(LiveFilterNetwork, SeesTheRoughnessOfTheFramesThatThereAre) {
  for (const std::size_t layers : {1u, 2u}) {
    const RandomNetwork kind{.layers = layers, .has_roughness = true};
    const FilterNetwork network = filter_network_of(test::random_filter_model(kind));
    const Motion whole = motion(network.channels(), 40);
    LiveFilterNetwork stream(network, 120);
    const std::vector<float> result = live(stream, whole);
    const FilterTake so_far = cut(whole, newest(0, 40, true) + 1, 120);
    std::vector<float> outputs =
        run(network, filter_features(so_far, network.statistics, network.inputs));
    const FilterTake ahead = cut(whole, delay + 1, 120);
    outputs.resize(ahead.values.size());
    std::vector<float> wanted(ahead.values.size());
    apply_predicted_filter(
        network.head,
        {ahead.frames, ahead.channels, ahead.values, network.statistics.deviation, {}}, outputs,
        wanted);
    for (std::size_t c = 0; c < network.channels(); ++c) EXPECT_NEAR(result[c], wanted[c], 2e-4);
  }
}

TEST(LiveFilterNetwork, IsNearWhatTheNetworkMakesOfTheWholeTake) {
  const RandomNetwork kind{.layers = 2, .has_roughness = true};
  const FilterNetwork network = filter_network_of(test::random_filter_model(kind));
  const Motion whole = motion(network.channels());
  LiveFilterNetwork stream(network, 120);
  const std::vector<float> result = live(stream, whole);
  const std::vector<float> wanted = filtered(network, cut(whole, frame_count, 120));
  double difference = 0, size = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    difference += std::pow(static_cast<double>(result[i] - wanted[i]), 2);
    size += std::pow(static_cast<double>(wanted[i] - whole.take.values[i]), 2);
  }
  EXPECT_GT(size, 0);
  EXPECT_LT(std::sqrt(difference / size), 0.2);
}

TEST(LiveFilterNetwork, GivesEveryFrameOfATakeShorterThanItsDelayAndOfNone) {
  const FilterNetwork network = filter_network_of(test::random_filter_model({.layers = 2}));
  for (const std::size_t frames : {0u, 1u, 2u, 7u, 15u, 16u, 18u}) {
    LiveFilterNetwork stream(network, 120);
    const Motion whole = motion(network.channels(), frames);
    EXPECT_EQ(live(stream, whole).size(), whole.take.values.size());
    // Where no pass starts before the end, all outputs use the whole take.
    if (frames == 0 || frames + period > delay + 1) continue;
    LiveFilterNetwork again(network, 120);
    const std::vector<float> result = live(again, whole);
    const std::vector<float> wanted = filtered(network, cut(whole, frames, 120));
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(result[i], wanted[i], 2e-4);
  }
}

TEST(LiveFilterNetwork, StartsAfreshWhenReset) {
  for (const RandomNetwork kind : {RandomNetwork{.layers = 2, .has_roughness = true},
                                   RandomNetwork{.layers = 0, .reach = 15}}) {
    const FilterNetwork network = filter_network_of(test::random_filter_model(kind));
    const Motion whole = motion(network.channels());
    LiveFilterNetwork stream(network, 120);
    const std::vector<float> first = live(stream, whole);
    stream.reset();
    EXPECT_EQ(live(stream, whole), first);
  }
}

TEST(LiveFilterNetwork, BridgesAGapThatEndsBeforeItsFramesComeOut) {
  const FilterNetwork network =
      filter_network_of(test::random_filter_model({.layers = 0, .is_narrow = true}));
  Motion whole = motion(network.channels());
  for (std::size_t f = 0; f < frame_count; ++f) {
    for (std::size_t c = 0; c < 3; ++c)
      whole.take.values[f * network.channels() + c] = static_cast<float>(f);
  }
  const std::size_t tracks = network.channels() / 3;
  for (std::size_t f = 30; f < 40; ++f) {
    whole.take.missing[f * tracks] = 1;
    for (std::size_t c = 0; c < 3; ++c) whole.take.values[f * network.channels() + c] = 1e6F;
  }
  for (std::size_t f = 50; f < 80; ++f) whole.take.missing[f * tracks] = 1;
  LiveFilterNetwork stream(network, 120);
  const std::vector<float> result = live(stream, whole);
  const auto at = [&](std::size_t f) { return result[f * network.channels()]; };
  for (std::size_t f = 28; f < 42; ++f) EXPECT_NEAR(at(f), static_cast<float>(f), 0.01F) << f;
  for (std::size_t f = 50; f < 65; ++f) EXPECT_NEAR(at(f), 49, 0.01F) << f;
  for (std::size_t f = 66; f < 80; ++f) {  // then it nears frame 80
    EXPECT_GT(at(f), at(f - 1)) << f;
    EXPECT_LT(at(f), 80) << f;
  }
}

TEST(LiveFilterNetwork, RefusesWhatItCannotRun) {
  EXPECT_THROW(LiveFilterNetwork(
                   filter_network_of(test::random_filter_model({.layers = 0, .reach = 16})), 120),
               Error);
  FilterNetwork strided = filter_network_of(test::random_filter_model({.layers = 1}));
  strided.stride = 4;
  EXPECT_THROW(LiveFilterNetwork(strided, 120), Error);
}

}  // namespace
}  // namespace kinemend
