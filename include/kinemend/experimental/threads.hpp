// How many threads the library uses, and work that every one of them does.
#pragma once

#include <cstddef>
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

}  // namespace kinemend
