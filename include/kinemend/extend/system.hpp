// Limits and counts the threads of the library, runs work on all of them, and stops work. The
// version of the library, and a hash that shows whether bytes have changed.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

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

/// Returns the version as "1.2.3": major, minor and patch version.
std::string_view version() noexcept;

/// Returns 128 bits of XXH3 as 32 hexadecimal digits, the same on every machine. It does not
/// protect against deliberate collisions.
std::string content_hash(std::string_view bytes);

inline constexpr std::size_t content_hash_digits = 32;

}  // namespace kinemend
