// Speed of matching, encoding and decoding takes of 31 joints and of 38 markers as channels of a
// body. The arguments are the rate in hertz and the duration in seconds.
#include <benchmark/benchmark.h>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"

namespace {

kinemend::Take take(const benchmark::State& state) {
  return kinemend::synthesize({.motion = "stroll",
                               .duration_s = static_cast<double>(state.range(1)),
                               .frame_rate_hz = static_cast<double>(state.range(0))});
}

kinemend::BodyLayout layout_of(const kinemend::Take& clip) {
  kinemend::BodyLayoutBuilder builder;
  builder.add(clip);
  return builder.finish();
}

void match(benchmark::State& state, const kinemend::Take& clip) {
  const kinemend::BodyLayout layout = layout_of(clip);
  for (auto _ : state) benchmark::DoNotOptimize(kinemend::match_body(layout, clip));
}

void encode(benchmark::State& state, const kinemend::Take& clip) {
  const kinemend::BodyLayout layout = layout_of(clip);
  const kinemend::BodyMatch match = kinemend::match_body(layout, clip);
  for (auto _ : state) benchmark::DoNotOptimize(kinemend::encode_body(clip, layout, match));
}

void decode(benchmark::State& state, kinemend::Take clip) {
  const kinemend::BodyLayout layout = layout_of(clip);
  const kinemend::BodyMatch match = kinemend::match_body(layout, clip);
  const kinemend::BodyChannels channels = kinemend::encode_body(clip, layout, match);
  for (auto _ : state) kinemend::decode_body(channels, layout, match, clip);
}

void match_joints(benchmark::State& state) { match(state, take(state)); }
void encode_joints(benchmark::State& state) { encode(state, take(state)); }
void decode_joints(benchmark::State& state) { decode(state, take(state)); }
void match_markers(benchmark::State& state) {
  match(state, kinemend::joint_markers(take(state), true));
}
void encode_markers(benchmark::State& state) {
  encode(state, kinemend::joint_markers(take(state), true));
}
void decode_markers(benchmark::State& state) {
  decode(state, kinemend::joint_markers(take(state), true));
}

void sizes(benchmark::internal::Benchmark* bench) {
  bench->Args({30, 10})->Args({120, 10})->Args({120, 100})->Unit(benchmark::kMillisecond);
}
BENCHMARK(match_joints)->Name("body/match_joints")->Apply(sizes);
BENCHMARK(encode_joints)->Name("body/encode_joints")->Apply(sizes);
BENCHMARK(decode_joints)->Name("body/decode_joints")->Apply(sizes);
BENCHMARK(match_markers)->Name("body/match_markers")->Apply(sizes);
BENCHMARK(encode_markers)->Name("body/encode_markers")->Apply(sizes);
BENCHMARK(decode_markers)->Name("body/decode_markers")->Apply(sizes);

}  // namespace
