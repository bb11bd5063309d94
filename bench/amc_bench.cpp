// Speed of reading and writing AMC on a single thread: a take of 10,000 frames with a skeleton like
// those of the CMU files and six significant digits. bytes_per_second refers to the file.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "io/acclaim/amc.hpp"
#include "kinemend/io.hpp"

namespace {

using namespace kinemend;

constexpr int frame_count = 10000, bone_count = 28;

const char* dofs_of(int bone) {
  constexpr const char* dofs[] = {"rx ry rz", "rx", "rx rz", "rx ry rz", "ry rz", "rx", "rx rz"};
  return dofs[bone % 7];
}

int dof_count(int bone) { return static_cast<int>(std::string_view(dofs_of(bone)).size() + 1) / 3; }

const std::string& skeleton_text() {
  static const std::string text = [] {
    std::string asf =
        ":version 1.10\n:units\n  mass 1.0\n  length 0.45\n  angle deg\n:root\n"
        "  order TX TY TZ RX RY RZ\n  axis XYZ\n  position 0 0 0\n  orientation 0 0 0\n:bonedata\n";
    std::string hierarchy = ":hierarchy\n  begin\n";
    for (int b = 0; b < bone_count; ++b) {
      asf += fmt::format(
          "  begin\n id {}\n name bone{}\n direction 0 1 0\n length 2\n axis {} 0 20 XYZ\n dof {}\n"
          " end\n",
          b + 1, b, 10 * (b % 9), dofs_of(b));
      hierarchy +=
          b % 6 == 0 ? fmt::format("root bone{}\n", b) : fmt::format("bone{} bone{}\n", b - 1, b);
    }
    return asf + hierarchy + "end\n";
  }();
  return text;
}

const std::string& take_text() {
  static const std::string text = [] {
    std::string amc = ":FULLY-SPECIFIED\n:DEGREES\n";
    for (int f = 0; f < frame_count; ++f) {
      const double t = f / 120.0;
      amc += fmt::format("{}\nroot {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g}\n", f + 1,
                         10 * std::sin(t), 17 + std::sin(3 * t), 8 * t, 5 * std::sin(t),
                         3 * std::sin(2 * t), 4 * std::cos(t));
      for (int b = 0; b < bone_count; ++b) {
        amc += fmt::format("bone{}", b);
        for (int d = 0; d < dof_count(b); ++d) {
          amc += fmt::format(" {:.6g}", 40 * std::sin(2 * t + b + 0.3 * d));
        }
        amc += '\n';
      }
    }
    return amc;
  }();
  return text;
}

Take read_take() { return read_amc(take_text(), "take.amc", skeleton_text(), "take.asf", {}).take; }

void count_bytes(benchmark::State& state) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(take_text().size()));
}

void read_amc_take(benchmark::State& state) {
  const std::string& text = take_text();
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = text;
    state.ResumeTiming();
    TakeResult result = read_amc(std::move(bytes), "take.amc", skeleton_text(), "take.asf", {});
    benchmark::DoNotOptimize(result.take.rotations.data());
    state.PauseTiming();
    result = {};
    state.ResumeTiming();
  }
  count_bytes(state);
}
BENCHMARK(read_amc_take)->Name("amc/read_amc_take")->Unit(benchmark::kMillisecond);

void write_amc_unchanged(benchmark::State& state) {
  const Take clip = read_take();
  for (auto _ : state) benchmark::DoNotOptimize(write_amc(clip).data());
  count_bytes(state);
}
BENCHMARK(write_amc_unchanged)->Name("amc/write_amc_unchanged")->Unit(benchmark::kMillisecond);

void write_amc_all_changed(benchmark::State& state) {
  Take clip = read_take();
  for (Quat& q : clip.rotations) q = q * exp({0.01, 0.02, -0.01});
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.root_position(f) += {0.01, 0.01, 0.01};
  for (auto _ : state) benchmark::DoNotOptimize(write_amc(clip).data());
  count_bytes(state);
}
BENCHMARK(write_amc_all_changed)->Name("amc/write_amc_all_changed")->Unit(benchmark::kMillisecond);

}  // namespace
