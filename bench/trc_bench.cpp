// Speed of reading and writing TRC on a single thread: a take of 4,500 frames x 41 markers with
// five decimals and every tenth sample missing. bytes_per_second refers to the file.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "io/text/cells.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"

namespace {

using namespace kinemend;

constexpr std::size_t frame_count = 4500, marker_count = 41;

double with_five_decimals(double value) { return std::round(value * 1e5) / 1e5; }

Take make_take() {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < marker_count; ++m) names.push_back(fmt::format("M{}", m));
  Take clip = make_marker_take(names, frame_count, 120);
  clip.unit = "mm";
  Random random(1);
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (random.chance(0.1)) continue;
    clip.observed[i] = 1;
    clip.positions[i] = {with_five_decimals(900 * random.normal()),
                         with_five_decimals(900 * random.normal()),
                         with_five_decimals(1000 + 300 * random.normal())};
  }
  return clip;
}

const std::string& take_text() {
  static const std::string text = write_take(make_take(), "trc");
  return text;
}

Take read_markers(std::string bytes) { return read_take(std::move(bytes), "take.trc", {}).take; }

void count_bytes(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(take_text().size()));
}

void read_trc_take(benchmark::State& state) {
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = take_text();
    state.ResumeTiming();
    Take clip = read_markers(std::move(bytes));
    benchmark::DoNotOptimize(clip.positions.data());
    state.PauseTiming();
    clip = {};
    state.ResumeTiming();
  }
  count_bytes(state);
}
BENCHMARK(read_trc_take)->Name("trc/read_trc_take")->Unit(benchmark::kMillisecond);

void parse_cells_only(benchmark::State& state) {
  const std::string& text = take_text();
  const std::size_t begin = text.find("\n1\t") + 1;
  std::vector<double> row(2 + 3 * marker_count);
  for (auto _ : state) {
    CellRows rows(text, begin, {});
    while (rows.next()) benchmark::DoNotOptimize(rows.read(row.data(), row.size()).cells);
  }
  count_bytes(state);
}
BENCHMARK(parse_cells_only)->Name("trc/parse_cells_only")->Unit(benchmark::kMillisecond);

void write_unchanged(benchmark::State& state) {
  const Take clip = read_markers(take_text());
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip, "trc").data());
  count_bytes(state);
}
BENCHMARK(write_unchanged)->Name("trc/write_unchanged")->Unit(benchmark::kMillisecond);

void write_all_changed(benchmark::State& state) {
  Take clip = read_markers(take_text());
  for (Vec3& p : clip.positions) p += {0.5, 0.25, 0.125};
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip, "trc").data());
  count_bytes(state);
}
BENCHMARK(write_all_changed)->Name("trc/write_all_changed")->Unit(benchmark::kMillisecond);

void write_plain_layout(benchmark::State& state) {
  const Take clip = make_take();
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip, "trc").data());
  count_bytes(state);
}
BENCHMARK(write_plain_layout)->Name("trc/write_plain_layout")->Unit(benchmark::kMillisecond);

}  // namespace
