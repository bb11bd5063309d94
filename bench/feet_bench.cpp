// Speed of finding contacts and cleaning feet in takes of 31 joints at 120 Hz whose root wanders.
#include <benchmark/benchmark.h>

#include <cmath>

#include "kinemend/feet.hpp"
#include "kinemend/lab/synth.hpp"

namespace {

kinemend::Take sliding_walk(std::size_t frames) {
  kinemend::Take clip = kinemend::synthesize(
      {.motion = "walk", .duration_s = (static_cast<double>(frames) + 1) / 120});
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.root_position(f).x += 5 * std::sin(0.02 * static_cast<double>(f));
  return clip;
}

void clean_feet(benchmark::State& state) {
  const auto frames = static_cast<std::size_t>(state.range(0));
  const kinemend::Take clip = sliding_walk(frames);
  kinemend::FeetSettings settings;
  settings.mode = kinemend::FeetMode::force;
  for (auto _ : state) {
    state.PauseTiming();
    kinemend::Take cleaned = clip;
    state.ResumeTiming();
    benchmark::DoNotOptimize(kinemend::clean_feet(cleaned, settings));
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(frames));
}
BENCHMARK(clean_feet)
    ->Name("feet/clean_feet")
    ->Arg(500)
    ->Arg(5000)
    ->Arg(50000)
    ->Unit(benchmark::kMillisecond);

void find_contacts(benchmark::State& state) {
  const kinemend::Take clip = sliding_walk(5000);
  for (auto _ : state) benchmark::DoNotOptimize(kinemend::find_contacts(clip));
}
BENCHMARK(find_contacts)->Name("feet/find_contacts")->Unit(benchmark::kMillisecond);

}  // namespace
