// Measures the processor time of single frames, for benchmarks of live cleaning.
#pragma once

#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace kinemend::bench {

/// Measures the time of single live frames. The counters are the median and the 99th percentile,
/// because a mean says little about a stream.
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
  // Measures this thread only, so that other load does not matter.
  static double thread_ms() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  std::vector<double> milliseconds_;
};

}  // namespace kinemend::bench
