// Tests of work spread over threads: each piece runs once, exceptions, nesting, and equal results
// with either thread library.
#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinemend/extend/system.hpp"

namespace kinemend {
namespace {

// Calls `law` with the thread library of the build, then with that of the standard library on one
// thread, on two, and on seven (more than most test machines have).
template <class Law>
void with_all_threads(const Law& law) {
  law();
  for (const std::size_t threads : {1, 2, 7}) {
    const StandardThreads standard(threads);
    EXPECT_EQ(thread_count(), threads);
    law();
  }
}

TEST(Parallel, DoesEveryIndexOnce) {
  with_all_threads([] {
    for (const std::size_t count : {0, 1, 2, 5, 1000}) {
      std::vector<std::atomic<int>> done(count);
      for_each_index(count, [&](std::size_t i) { ++done[i]; });
      for (const auto& times : done) EXPECT_EQ(times, 1);
    }
  });
}

TEST(Parallel, DoesEveryItemOfARangeOnce) {
  with_all_threads([] {
    for (const std::size_t least : {1, 3, 64, 5000}) {
      std::vector<std::atomic<int>> done(1000);
      for_each_range(10, done.size(), least, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) ++done[i];
      });
      for (std::size_t i = 0; i < done.size(); ++i) EXPECT_EQ(done[i], i < 10 ? 0 : 1);
    }
    for_each_range(5, 5, 1, [](std::size_t, std::size_t) { FAIL(); });
  });
}

TEST(Parallel, NestsWithoutWaitingForever) {
  with_all_threads([] {
    std::atomic<int> done{0};
    for_each_index(8, [&](std::size_t) {
      run_isolated([&] {
        for_each_index(8, [&](std::size_t) { for_each_index(4, [&](std::size_t) { ++done; }); });
      });
    });
    EXPECT_EQ(done, 256);
  });
}

TEST(Parallel, ThrowsWhatAPieceThrows) {
  with_all_threads([] {
    std::atomic<int> begun{0};
    const auto work = [&](std::size_t i) {
      ++begun;
      if (i == 3) throw std::runtime_error("three");
    };
    EXPECT_THROW(for_each_index(1000, work), std::runtime_error);
    EXPECT_GE(begun, 1);
    EXPECT_FALSE(work_is_cancelled());
    for_each_index(10, [&](std::size_t) { ++begun; });
  });
}

// The rounded sum of these depends on the order of addition.
TEST(Parallel, AddsInTheSameOrderWithEveryNumberOfThreads) {
  const auto sum = [] {
    return sum_in_halves<double>(10007, 64, [](std::size_t first, std::size_t last) {
      double part = 0;
      for (std::size_t i = first; i < last; ++i) part += std::sin(static_cast<double>(i)) * 1e10;
      return part;
    });
  };
  const double expected = sum();
  with_all_threads([&] { EXPECT_EQ(sum(), expected); });
  EXPECT_EQ(sum_in_halves<double>(0, 64, [](std::size_t, std::size_t) { return 1.0; }), 0);
}

TEST(Parallel, AppendsPiecesInOrder) {
  with_all_threads([] {
    constexpr std::size_t slots = 4;
    std::vector<std::string> pieces(slots);
    std::string out, expected;
    std::size_t number = 0, chosen = 0;
    PieceStages stages;
    stages.choose = [&](std::size_t slot) { pieces[slot] += ":" + std::to_string(chosen++); };
    stages.write = [&](std::size_t slot) { pieces[slot] += ";"; };
    stages.append = [&](std::size_t slot) { out += pieces[slot]; };
    const auto read = [&](std::size_t slot) {
      if (number == 101) return false;
      pieces[slot] = std::to_string(number++);
      return true;
    };
    for_each_piece(slots, read, stages);
    for (int i = 0; i < 101; ++i) expected += std::to_string(i) + ":" + std::to_string(i) + ";";
    EXPECT_EQ(out, expected);
  });
}

TEST(Parallel, ThrowsWhatAStageThrows) {
  with_all_threads([] {
    int read = 0;
    PieceStages stages;
    stages.append = [&](std::size_t) {
      if (read > 5) throw std::runtime_error("full");
    };
    EXPECT_THROW(for_each_piece(
                     3, [&](std::size_t) { return ++read < 100; }, stages),
                 std::runtime_error);
    EXPECT_LT(read, 100);
  });
}

TEST(Parallel, KeepsToTheLeastLimit) {
  with_all_threads([] {
    const std::size_t free_threads = thread_count();
    {
      const ThreadLimit two(2), one(1);
      std::atomic<int> at_once{0}, most{0};
      for_each_index(100, [&](std::size_t) {
        most = std::max<int>(most, ++at_once);
        --at_once;
      });
      EXPECT_EQ(most, 1);
    }
    EXPECT_EQ(thread_count(), free_threads);
  });
}

TEST(Parallel, EndsOnceItIsAskedTo) {
  with_all_threads([] {
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> done{0};
    const auto work = [&](std::size_t) {
      if (++done == 5) stop = true;
    };
    constexpr std::size_t count = 100000;
    for_each_index(count, work);
    EXPECT_EQ(done, count) << "nobody watches";
    stop = false;
    done = 0;
    {
      const StopWatch watch(stop);
      EXPECT_THROW(for_each_index(count, work), WorkStopped);
      EXPECT_LT(done, count);
      EXPECT_THROW(for_each_range(0, count, 1, [](std::size_t, std::size_t) {}), WorkStopped);
      EXPECT_THROW(for_each_parallel(2, 2, [](std::size_t) {}), WorkStopped);
    }
    for_each_parallel(2, 2, [](std::size_t) {});
  });
}

TEST(Parallel, WorkWithinWorkIsAskedToo) {
  with_all_threads([] {
    std::atomic<bool> stop{false};
    std::atomic<std::size_t> done{0};
    const StopWatch watch(stop);
    EXPECT_THROW(for_each_index(50,
                                [&](std::size_t) {
                                  for_each_index(1000, [&](std::size_t) {
                                    if (++done == 3) stop = true;
                                  });
                                }),
                 WorkStopped);
    EXPECT_LT(done, 50000u);
  });
}

TEST(Parallel, CallsTheWorkOfEveryThread) {
  with_all_threads([] {
    std::atomic<std::size_t> called{0};
    on_every_thread([&] { ++called; });
    EXPECT_EQ(called, thread_count());
  });
}

}  // namespace
}  // namespace kinemend
