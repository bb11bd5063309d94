// Speed of reading and writing BVH on a single thread: a take of 10,000 frames x 96 channels with
// four decimals, as in the CMU files. bytes_per_second refers to the file.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "io/motion/motion_columns.hpp"
#include "io/motion/motion_rows.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"

namespace {

using namespace kinemend;

constexpr std::size_t frame_count = 10000, joint_count = 31;

// Smooth joint angles, so that the digits are like those of a real take.
Take make_take() {
  Take clip;
  const RotationOrder order = parse_rotation_order("ZYX");
  for (std::size_t j = 0; j < joint_count; ++j) {
    const std::int32_t parent = j == 0 ? -1 : static_cast<std::int32_t>(j % 5 == 1 ? 0 : j - 1);
    clip.skeleton.add_joint("joint" + std::to_string(j), parent, {0, 1.5, 0},
                            make_channels(j == 0, order));
  }
  clip.frame_rate_hz = 120;
  Random random(1);
  std::vector<double> phases;
  for (std::size_t i = 0; i < 3 * joint_count; ++i) phases.push_back(random.uniform(0, 2 * pi));
  for (std::size_t f = 0; f < frame_count; ++f) {
    const double t = static_cast<double>(f) / 120;
    clip.positions.push_back({10 * std::sin(t), 17 + std::sin(3 * t), 8 * t});
    for (std::size_t j = 0; j < joint_count; ++j) {
      std::array<double, 3> angles{};
      for (std::size_t i = 0; i < 3; ++i) {
        const double amplitude = j % 7 == 3 ? 0 : 0.7;
        angles[i] = amplitude * std::sin(2 * t + phases[3 * j + i]);
      }
      clip.rotations.push_back(from_euler(angles, order));
    }
  }
  return clip;
}

// Writes six decimals in the plain layout and cuts them to four.
const std::string& take_text() {
  static const std::string text = [] {
    const std::string six = write_take(make_take());
    const std::size_t data = six.find('\n', six.find("Frame Time"));
    std::string four = six.substr(0, data);
    std::size_t decimals = 0;
    for (std::size_t i = data; i < six.size(); ++i) {
      const char c = six[i];
      const bool digit = c >= '0' && c <= '9';
      decimals = c == '.' ? 1 : digit && decimals > 0 ? decimals + 1 : 0;
      if (decimals <= 5) four += c;
    }
    return four;
  }();
  return text;
}

void count_bytes(benchmark::State& state, std::size_t bytes) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(bytes));
}

void read_bvh_take(benchmark::State& state) {
  const std::string& text = take_text();
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = text;
    state.ResumeTiming();
    TakeResult result = read_joints(std::move(bytes), "take.bvh");
    benchmark::DoNotOptimize(result.take.rotations.data());
    state.PauseTiming();
    result = {};
    state.ResumeTiming();
  }
  count_bytes(state, text.size());
}
BENCHMARK(read_bvh_take)->Name("io/read_bvh_take")->Unit(benchmark::kMillisecond);

void parse_numbers_only(benchmark::State& state) {
  const std::string& text = take_text();
  const std::size_t begin = text.find('\n', text.find("Frame Time"));
  std::vector<double> row(3 + 3 * joint_count);
  for (auto _ : state) {
    MotionRows rows(text.data() + begin, text.data() + text.size(), CommaStyle::none);
    while (rows.next(row.data(), row.size()) == row.size()) benchmark::DoNotOptimize(row.data());
  }
  count_bytes(state, text.size());
}
BENCHMARK(parse_numbers_only)->Name("io/parse_numbers_only")->Unit(benchmark::kMillisecond);

void angles_to_quaternions_only(benchmark::State& state) {
  const Take clip = make_take();
  MotionColumns columns(clip.skeleton);
  const std::size_t block = columns.block_frames();
  std::vector<double> rows(block * columns.count());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = 80 * std::sin(static_cast<double>(i));
  std::vector<Quat> rotations(block * joint_count);
  for (auto _ : state) {
    columns.decode_rotations(rows.data(), block, rotations.data());
    benchmark::DoNotOptimize(rotations.data());
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(rotations.size()));
}
BENCHMARK(angles_to_quaternions_only)->Name("io/angles_to_quaternions_only");

void write_unchanged(benchmark::State& state) {
  const Take clip = read_joints(take_text(), "take.bvh").take;
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip).data());
  count_bytes(state, take_text().size());
}
BENCHMARK(write_unchanged)->Name("io/write_unchanged")->Unit(benchmark::kMillisecond);

void write_one_joint_changed(benchmark::State& state) {
  Take clip = read_joints(take_text(), "take.bvh").take;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.rotation(f, 5) = clip.rotation(f, 5) * exp({0.01, 0, 0});
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip).data());
  count_bytes(state, take_text().size());
}
BENCHMARK(write_one_joint_changed)
    ->Name("io/write_one_joint_changed")
    ->Unit(benchmark::kMillisecond);

void write_all_changed(benchmark::State& state) {
  Take clip = read_joints(take_text(), "take.bvh").take;
  for (Quat& q : clip.rotations) q = q * exp({0.01, 0.02, -0.01});
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.root_position(f) += {0.01, 0.01, 0.01};
  for (auto _ : state) benchmark::DoNotOptimize(write_take(clip).data());
  count_bytes(state, take_text().size());
}
BENCHMARK(write_all_changed)->Name("io/write_all_changed")->Unit(benchmark::kMillisecond);

void write_plain_layout(benchmark::State& state) {
  const Take clip = make_take();
  std::size_t bytes = 0;
  for (auto _ : state) bytes = write_take(clip).size();
  count_bytes(state, bytes);
}
BENCHMARK(write_plain_layout)->Name("io/write_plain_layout")->Unit(benchmark::kMillisecond);

}  // namespace
