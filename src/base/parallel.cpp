// Spreads work over threads: those of oneTBB if the library is built with it, else a pool.
#include "base/parallel.hpp"

#ifdef KINEMEND_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "kinemend/extend/system.hpp"

// Threads of the standard library, which start when they are first needed, for systems without
// oneTBB.
namespace kinemend::pool {

namespace {

// One call of for_each_index. It lives on the stack of the caller, which outlasts its helpers.
struct Job {
  std::size_t count = 0;
  const IndexWork* work = nullptr;
  Job* around = nullptr;  // the job that this one is part of
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_cancelled{false};
  std::size_t helpers = 0;   // under the pool's mutex
  std::exception_ptr error;  // under the pool's mutex
};

thread_local Job* current_job = nullptr;

bool is_cancelled_around(const Job* job) {
  for (; job != nullptr; job = job->around) {
    if (job->is_cancelled) return true;
  }
  return false;
}

std::size_t hardware_threads() {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  return 1;
#else
  return std::max(1U, std::thread::hardware_concurrency());
#endif
}

class Pool {
 public:
  Pool() : most_(hardware_threads()) {}
  ~Pool() {
    {
      const std::lock_guard lock(mutex_);
      ends_ = true;
    }
    work_came_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  std::size_t thread_count() {
    const std::lock_guard lock(mutex_);
    return limit();
  }

  std::size_t set_thread_count(std::size_t count) {
    const std::lock_guard lock(mutex_);
    return std::exchange(most_, count);
  }

  void add_limit(std::size_t most) {
    const std::lock_guard lock(mutex_);
    limits_.insert(std::max<std::size_t>(1, most));
  }

  void remove_limit(std::size_t most) {
    const std::lock_guard lock(mutex_);
    limits_.erase(limits_.find(std::max<std::size_t>(1, most)));
  }

  void run(Job& job) {
    offer(job);
    work_on(job);
    withdraw(job);
    if (job.error) std::rethrow_exception(job.error);
  }

 private:
  std::size_t limit() const { return limits_.empty() ? most_ : std::min(most_, *limits_.begin()); }

  void offer(Job& job) {
    {
      const std::lock_guard lock(mutex_);
      jobs_.push_back(&job);
      while (threads_.size() + 1 < limit()) threads_.emplace_back([this] { help(); });
    }
    work_came_.notify_all();
  }

  // Waits until no helper is left.
  void withdraw(Job& job) {
    std::unique_lock lock(mutex_);
    remove(job);
    helper_left_.wait(lock, [&] { return job.helpers == 0; });
  }

  void remove(Job& job) { std::erase(jobs_, &job); }

  void work_on(Job& job) {
    Job* const before = current_job;
    current_job = &job;
    for (std::size_t i = job.next++; i < job.count; i = job.next++) {
      if (is_cancelled_around(&job)) break;
      try {
        (*job.work)(i);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!job.error) job.error = std::current_exception();
        job.is_cancelled = true;
      }
    }
    current_job = before;
  }

  void help() {
    std::unique_lock lock(mutex_);
    for (;;) {
      work_came_.wait(lock, [&] { return ends_ || (!jobs_.empty() && busy_ + 1 < limit()); });
      if (ends_) return;
      // The innermost job first: others wait for it.
      Job& job = *jobs_.back();
      if (job.next >= job.count) {
        remove(job);
        continue;
      }
      ++job.helpers;
      ++busy_;
      lock.unlock();
      work_on(job);
      lock.lock();
      --busy_;
      --job.helpers;
      remove(job);
      helper_left_.notify_all();
    }
  }

  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable work_came_, helper_left_;
  std::vector<std::thread> threads_;
  std::vector<Job*> jobs_;
  std::multiset<std::size_t> limits_;
  std::size_t busy_ = 0;  // helpers at work
  bool ends_ = false;
};

Pool& the_pool() {
  static Pool pool;
  return pool;
}

// Returns the number of threads under the current limits, including the caller.
std::size_t thread_count() { return the_pool().thread_count(); }
// Sets the number without limits; 0: the number of hardware threads. Returns the previous number.
std::size_t set_thread_count(std::size_t count) {
  return the_pool().set_thread_count(count == 0 ? hardware_threads() : count);
}
void add_limit(std::size_t most) { the_pool().add_limit(most); }
void remove_limit(std::size_t most) { the_pool().remove_limit(most); }
// Works like `work_is_cancelled`.
bool is_cancelled() { return is_cancelled_around(current_job); }

// Works like `kinemend::for_each_index`. A thread that waits for the rest of its own work does no
// other.
void for_each_index(std::size_t count, const IndexWork& work) {
  if (count < 2 || thread_count() < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  Job job;
  job.count = count;
  job.work = &work;
  job.around = current_job;
  the_pool().run(job);
}

}  // namespace

}  // namespace kinemend::pool

namespace kinemend {

namespace {

#ifdef KINEMEND_TBB
std::atomic<bool> uses_pool{false};
#else
constexpr bool uses_pool = true;
#endif

// The stop flag of the `StopWatch` of this thread; null: none.
thread_local const std::atomic<bool>* watched_stop = nullptr;

void end_if_stopped() {
  if (watched_stop != nullptr && *watched_stop) throw WorkStopped();
}

// Makes a piece of work, on any thread, watch the stop flag of the thread that spread it.
class WatchOf {
 public:
  explicit WatchOf(const std::atomic<bool>* stop) : before_(std::exchange(watched_stop, stop)) {}
  ~WatchOf() { watched_stop = before_; }
  WatchOf(const WatchOf&) = delete;
  WatchOf& operator=(const WatchOf&) = delete;

 private:
  const std::atomic<bool>* before_;
};

IndexWork watched(const IndexWork& work) {
  return [&work, stop = watched_stop](std::size_t i) {
    const WatchOf watch(stop);
    end_if_stopped();
    work(i);
  };
}

// A range of a long take can take a minute, so it is processed in parts that check for a stop.
RangeWork watched(const RangeWork& work, std::size_t least) {
  return [&work, least, stop = watched_stop](std::size_t first, std::size_t last) {
    constexpr std::size_t most_parts = 64;
    const std::size_t length = last - first;
    const std::size_t parts =
        std::clamp<std::size_t>(length / std::max<std::size_t>(1, least), 1, most_parts);
    const WatchOf watch(stop);
    for (std::size_t i = 0; i < parts; ++i) {
      end_if_stopped();
      work(first + length * i / parts, first + length * (i + 1) / parts);
    }
  };
}

void for_each_range_in_pool(std::size_t first, std::size_t last, std::size_t least,
                            const RangeWork& work) {
  // For speed, not swept.
  constexpr std::size_t parts_per_thread = 4;  // so that a thread that ends early finds more work
  if (first >= last) return;
  const std::size_t count = last - first;
  const std::size_t most_parts = std::max<std::size_t>(1, count / std::max<std::size_t>(1, least));
  const std::size_t parts = std::min(most_parts, parts_per_thread * pool::thread_count());
  pool::for_each_index(parts, [&](std::size_t i) {
    work(first + count * i / parts, first + count * (i + 1) / parts);
  });
}

void for_each_piece_in_pool(std::size_t slots, const std::function<bool(std::size_t)>& read,
                            const PieceStages& stages) {
  for (bool goes_on = true; goes_on;) {
    std::size_t count = 0;
    const std::size_t at_once = stages.write ? slots : 1;
    while (count < at_once && (goes_on = read(count))) {
      if (stages.choose) stages.choose(count);
      ++count;
    }
    if (stages.write) pool::for_each_index(count, stages.write);
    for (std::size_t slot = 0; slot < count; ++slot) stages.append(slot);
  }
}

#ifdef KINEMEND_TBB
void for_each_piece_in_tbb(std::size_t slots, const std::function<bool(std::size_t)>& read,
                           const PieceStages& stages) {
  using tbb::filter_mode;
  using Slot = std::size_t*;
  std::vector<std::size_t> numbers(slots);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  std::size_t entered = 0;
  const auto enter = [&](tbb::flow_control& control) -> Slot {
    const Slot slot = &numbers[entered++ % slots];
    if (read(*slot)) return slot;
    control.stop();
    return nullptr;
  };
  const auto append = [&](Slot slot) { stages.append(*slot); };
  tbb::filter<void, Slot> chain(filter_mode::serial_in_order, enter);
  const auto add = [&](filter_mode mode, const IndexWork& work) {
    const auto step = [&work](Slot slot) {
      work(*slot);
      return slot;
    };
    if (work) chain = chain & tbb::filter<Slot, Slot>(mode, step);
  };
  add(filter_mode::serial_in_order, stages.choose);
  add(filter_mode::parallel, stages.write);
  const tbb::filter<Slot, void> last(filter_mode::serial_in_order, append);
  tbb::this_task_arena::isolate([&] { tbb::parallel_pipeline(slots, chain & last); });
}
#endif

void add_halves(std::size_t first, std::size_t last, std::size_t most,
                std::vector<IndexRange>& ranges) {
  if (last - first <= most) {
    ranges.emplace_back(first, last);
    return;
  }
  const std::size_t middle = first + (last - first) / 2;
  add_halves(first, middle, most, ranges);
  add_halves(middle, last, most, ranges);
}

}  // namespace

struct ThreadLimit::Held {
  explicit Held(std::size_t limit) : most(limit) { pool::add_limit(most); }
  ~Held() { pool::remove_limit(most); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  std::size_t most;
#ifdef KINEMEND_TBB
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, most};
#endif
};

ThreadLimit::ThreadLimit(std::size_t most) : held_(std::make_unique<Held>(most)) {}
ThreadLimit::~ThreadLimit() = default;

std::size_t thread_count() {
#ifdef KINEMEND_TBB
  if (!uses_pool) return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
#endif
  return pool::thread_count();
}

StopWatch::StopWatch(const std::atomic<bool>& stop) : before_(std::exchange(watched_stop, &stop)) {}
StopWatch::~StopWatch() { watched_stop = before_; }

namespace {

void for_each_index_unwatched(std::size_t count, const IndexWork& work) {
#ifdef KINEMEND_TBB
  if (!uses_pool) return tbb::parallel_for(std::size_t{0}, count, work);
#endif
  pool::for_each_index(count, work);
}

void for_each_range_unwatched(std::size_t first, std::size_t last, std::size_t least,
                              const RangeWork& work) {
#ifdef KINEMEND_TBB
  if (!uses_pool) {
    return tbb::parallel_for(tbb::blocked_range<std::size_t>(first, last, least),
                             [&](const auto& range) { work(range.begin(), range.end()); });
  }
#endif
  for_each_range_in_pool(first, last, least, work);
}

}  // namespace

void for_each_index(std::size_t count, const IndexWork& work) {
  if (watched_stop == nullptr) return for_each_index_unwatched(count, work);
  for_each_index_unwatched(count, watched(work));
}

void for_each_parallel(std::size_t count, std::size_t samples, const IndexWork& work) {
  // For speed, not swept.
  constexpr std::size_t worth_threads = 4096;
  end_if_stopped();
  if (samples < worth_threads || count < 2) {
    for (std::size_t i = 0; i < count; ++i) work(i);
    return;
  }
  for_each_index(count, work);
}

void for_each_range(std::size_t first, std::size_t last, std::size_t least, const RangeWork& work) {
  if (watched_stop == nullptr) return for_each_range_unwatched(first, last, least, work);
  for_each_range_unwatched(first, last, least, watched(work, least));
}

bool work_is_cancelled() {
#ifdef KINEMEND_TBB
  if (!uses_pool) return tbb::is_current_task_group_canceling();
#endif
  return pool::is_cancelled();
}

void for_each_piece(std::size_t slots, const std::function<bool(std::size_t slot)>& read,
                    const PieceStages& stages) {
#ifdef KINEMEND_TBB
  if (!uses_pool) return for_each_piece_in_tbb(slots, read, stages);
#endif
  for_each_piece_in_pool(slots, read, stages);
}

std::vector<IndexRange> halved_ranges(std::size_t first, std::size_t last, std::size_t most) {
  std::vector<IndexRange> ranges;
  if (first < last) add_halves(first, last, std::max<std::size_t>(1, most), ranges);
  return ranges;
}

void on_every_thread(const std::function<void()>& work) {
  for_each_index(thread_count(), [&](std::size_t) { work(); });
}

void run_isolated(const std::function<void()>& work) {
#ifdef KINEMEND_TBB
  if (!uses_pool) return tbb::this_task_arena::isolate(work);
#endif
  work();
}

StandardThreads::StandardThreads(std::size_t threads)
    : threads_before_(pool::set_thread_count(threads)), used_before_(uses_pool) {
#ifdef KINEMEND_TBB
  uses_pool = true;
#endif
}

StandardThreads::~StandardThreads() {
#ifdef KINEMEND_TBB
  uses_pool = used_before_;
#endif
  pool::set_thread_count(threads_before_);
}

}  // namespace kinemend
