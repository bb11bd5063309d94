#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "noisy_walk.hpp"
#include "priors/recurrent_filter.hpp"

// The method `recurrent`: whole takes, the network alone, and how long the model takes to load.
namespace {

using kinemend::Clip;

void clean_take(benchmark::State& state) {
  const Clip take = kinemend::bench::noisy_walk(static_cast<double>(state.range(0)), 10, 0);
  const std::unique_ptr<kinemend::Cleaner> cleaner = kinemend::make_recurrent();
  for (auto _ : state) {
    Clip clip = take;
    clean_in_place(*cleaner, clip);
    benchmark::DoNotOptimize(clip.local_rotations.data());
  }
  state.counters["ms per frame"] = benchmark::Counter(
      1e-3 * static_cast<double>(take.frame_count()),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(clean_take)->ArgName("Hz")->Arg(30)->Arg(120)->Unit(benchmark::kMillisecond);

// 1,200 frames at the model's rate.
void network_alone(benchmark::State& state) {
  const kinemend::RecurrentNetwork network =
      kinemend::recurrent_network_of(*kinemend::shipped_model("recurrent"));
  constexpr std::size_t frames = 1200;
  const std::size_t steps = frames / kinemend::recurrent_step;
  const std::vector<float> features(steps * network.input.inputs(), 0.1F);
  for (auto _ : state) benchmark::DoNotOptimize(run(network, features).data());
  state.counters["ms per frame"] = benchmark::Counter(
      1e-3 * frames, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
BENCHMARK(network_alone)->Unit(benchmark::kMillisecond);

void load_model(benchmark::State& state) {
  std::string bytes;
  for (const kinemend::ShippedModel& model : kinemend::shipped_models()) {
    if (model.method == "recurrent") bytes = model.bytes;
  }
  for (auto _ : state) {
    const kinemend::Model model = kinemend::parse_model(bytes, "recurrent");
    benchmark::DoNotOptimize(kinemend::recurrent_network_of(model).blocks.size());
  }
}
BENCHMARK(load_model)->Unit(benchmark::kMillisecond);

}  // namespace
