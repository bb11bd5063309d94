// Limits and counts the threads of the library, runs work on all of them, and stops work.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>

namespace kinemend {

/// During its lifetime the library uses at most `most` threads, including the caller's. If several
/// limits exist, the smallest applies. `most`: 1 or more.
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

/// Returns the number of threads that share the work, 1 or more.
std::size_t thread_count();

/// Calls `work` once per thread, in parallel if threads are free. The calls divide the work among
/// themselves. Throws the first exception of `work`.
void on_every_thread(const std::function<void()>& work);

/// Calls `work`. While this thread waits for its own tasks, it does not run tasks of other callers.
void run_isolated(const std::function<void()>& work);

/// Thrown by work that was asked to stop early.
class WorkStopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the work was stopped"; }
};

/// During its lifetime, work of this thread, and its tasks on other threads, throws `WorkStopped`
/// soon after `stop` becomes true. The data of the work is left as by any other exception. `stop`
/// must outlive this object.
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
