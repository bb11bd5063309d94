// Time of one live frame for every live method: a noisy walk of 31 joints at 120 Hz.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "frame_times.hpp"
#include "kinemend/extend/sessions.hpp"
#include "kinemend/io.hpp"
#include "kinemend/live.hpp"
#include "kinemend/methods.hpp"
#include "noisy_walk.hpp"

namespace {

using namespace kinemend;

using bench::FrameTimes;

void push_frame(benchmark::State& state, const LiveMethod& method) {
  const Take clip = bench::noisy_walk(120, 10, 0);
  const auto cleaner = make_cleaner(method.name, method.options);
  const auto stream = make_stream(*cleaner, clip);
  const TakeView view = view_of(clip);
  std::vector<Frame> frames;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) frames.push_back(frame_of(view, f));
  Frame out;
  std::size_t next = 0;
  FrameTimes times;
  for (auto _ : state) {
    times.measure([&] { stream->push(frames[next], out); });
    benchmark::DoNotOptimize(out.rotations.data());
    next = (next + 1) % frames.size();
  }
  times.tell(state);
  state.counters["delay_frames"] = static_cast<double>(stream->latency_frames());
}

// The same from an input line of text to an output line of text.
void feed_line(benchmark::State& state, const LiveMethod& method) {
  const std::string take = write_take(bench::noisy_walk(120, 10, 0));
  const std::size_t motion = take.find('\n', take.find("Frame Time:")) + 1;
  const auto cleaner = make_cleaner(method.name, method.options);
  std::size_t bytes = 0;
  LiveSession session(*cleaner, {}, [&](const LivePiece& piece) { bytes += piece.text.size(); });
  session.feed(std::string_view(take).substr(0, motion));
  std::size_t place = motion;
  FrameTimes times;
  for (auto _ : state) {
    const std::size_t end = take.find('\n', place) + 1;
    times.measure([&] { session.feed(std::string_view(take).substr(place, end - place)); });
    place = end < take.size() ? end : motion;
  }
  benchmark::DoNotOptimize(bytes);
  times.tell(state);
}

[[maybe_unused]] const int registered = [] {
  for (const LiveMethod& method : live_methods()) {
    benchmark::RegisterBenchmark(("live/push/" + method.name).c_str(), push_frame, method)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark(("live/feed/" + method.name).c_str(), feed_line, method)
        ->Unit(benchmark::kMicrosecond);
  }
  return 0;
}();

}  // namespace
