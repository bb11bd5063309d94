// Measures the processor time of single frames, for benchmarks of live cleaning.
#pragma once

#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinemend::bench {

/// How long one frame takes live. A mean says little of a stream, so that the median and the 99th
/// percentile are counters.
class FrameTimes {
 public:
  template <class Work>
  void measure(const Work& work) {
    const double start = thread_ms();
    work();
    milliseconds_.push_back(thread_ms() - start);
  }
  void tell(benchmark::State& state) {
    std::sort(milliseconds_.begin(), milliseconds_.end());
    const auto of_share = [&](double share) {
      return milliseconds_[static_cast<std::size_t>(share *
                                                    static_cast<double>(milliseconds_.size() - 1))];
    };
    state.counters["median_ms"] = of_share(0.5);
    state.counters["p99_ms"] = of_share(0.99);
  }

 private:
  // Of this thread alone: what else the machine does is no part of it.
  static double thread_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  std::vector<double> milliseconds_;
};

}  // namespace kinemend::bench
