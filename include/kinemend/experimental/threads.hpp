// How many threads the library uses, and work that every one of them does.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace kinemend {

/// While it lives, the library uses at most `most` threads, the caller's among them. Where several
/// limits live at once, the least holds. `most`: 1 or more.
class ThreadLimit {
 public:
  explicit ThreadLimit(std::size_t most);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

/// Number of threads that work is spread over, 1 or more.
std::size_t thread_count();

/// Calls `work` as many times as there are threads, in parallel where threads are free. The work
/// shares out what there is to do. Throws what `work` throws first.
void on_every_thread(const std::function<void()>& work);

/// Calls `work`. While it waits for its own threads, this thread does no work of other callers.
void run_isolated(const std::function<void()>& work);

/// Work was asked to end before it was done.
class WorkStopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the work was stopped"; }
};

/// While it lives, work that this thread does and spreads over threads throws `WorkStopped` soon
/// after `stop` has become true. What the work was given is then as any exception leaves it. `stop`
/// outlives it.
class StopWatch {
 public:
  explicit StopWatch(const std::atomic<bool>& stop);
  ~StopWatch();
  StopWatch(const StopWatch&) = delete;
  StopWatch& operator=(const StopWatch&) = delete;

 private:
  const std::atomic<bool>* before_;
};

}  // namespace kinemend
