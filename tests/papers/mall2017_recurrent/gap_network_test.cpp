// Tests of gaps filled by networks of known output.
#include "papers/mall2017_recurrent/filter_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinemend/extend/signal.hpp"
#include "kinemend/lab/synth.hpp"
#include "papers/mall2017_recurrent/filter_support.hpp"

namespace kinemend {
namespace {

constexpr std::size_t channel = 10, first = 60, last = 130;  // a gap of track 3

struct TakeWithGap {
  BodyLayout layout;
  BodyChannels channels;
};

TakeWithGap with_gap() {
  SynthOptions options;
  options.duration_s = 2;
  options.frame_rate_hz = 120;
  const Take clip = synthesize(options);
  BodyLayoutBuilder builder;
  builder.add(clip);
  TakeWithGap take{builder.finish(), {}};
  take.channels = encode_body(clip, take.layout, match_body(take.layout, clip));
  for (std::size_t f = first; f < last; ++f) {
    for (std::size_t c = 9; c < 12; ++c) {
      take.channels.observed[f * take.channels.poses.channels + c] = 0;
      take.channels.poses(f, c) = 0;
    }
  }
  return take;
}

FilterNetwork network_of(const TakeWithGap& take, double output) {
  return filter_network_of(
      test::constant_filter_model(take.layout, FilterHead::residual, output, {false, true}));
}

PoseMatrix straight_lines(const TakeWithGap& take) {
  std::vector<std::uint8_t> missing;
  for (const std::uint8_t seen : take.channels.observed) missing.push_back(seen == 0 ? 1 : 0);
  PoseMatrix poses = take.channels.poses;
  fill_linear(poses, missing);
  return poses;
}

TEST(GapNetwork, ThatAddsNothingLeavesStraightLines) {
  const TakeWithGap take = with_gap();
  const PoseMatrix filled = filled_by_network(network_of(take, 0), take.layout, take.channels);
  EXPECT_EQ(filled.values, straight_lines(take).values);
}

TEST(GapNetwork, AddsInTheMiddleOfAGapAndMeetsItsEnds) {
  const TakeWithGap take = with_gap();
  const PoseMatrix lines = straight_lines(take);
  const PoseMatrix filled = filled_by_network(network_of(take, 5), take.layout, take.channels);
  EXPECT_NEAR(filled(95, channel) - lines(95, channel), 5, 1);
  for (const std::size_t f : {first, last - 1})
    EXPECT_NEAR(filled(f, channel) - lines(f, channel), 0, 0.02) << "frame " << f;
}

TEST(GapNetwork, KeepsWhatWasMeasured) {
  const TakeWithGap take = with_gap();
  const PoseMatrix filled = filled_by_network(network_of(take, 5), take.layout, take.channels);
  for (std::size_t i = 0; i < filled.values.size(); ++i) {
    if (take.channels.observed[i] == 0) continue;
    EXPECT_EQ(filled.values[i], take.channels.poses.values[i]) << "number " << i;
  }
}

TEST(GapNetwork, FillsATakeAtAnotherRateAlike) {
  TakeWithGap take = with_gap();
  const PoseMatrix same = filled_by_network(network_of(take, 5), take.layout, take.channels);
  FilterNetwork slower = network_of(take, 5);
  slower.rate_hz = 50;
  const PoseMatrix other = filled_by_network(slower, take.layout, take.channels);
  for (std::size_t i = 0; i < same.values.size(); ++i)
    ASSERT_NEAR(same.values[i], other.values[i], 1e-4) << "number " << i;
}

}  // namespace
}  // namespace kinemend
