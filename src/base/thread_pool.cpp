// Shares the indices of a job among the threads of a pool, which start when they are first needed.
#include "base/thread_pool.hpp"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

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

}  // namespace

std::size_t thread_count() { return the_pool().thread_count(); }
std::size_t set_thread_count(std::size_t count) {
  return the_pool().set_thread_count(count == 0 ? hardware_threads() : count);
}
void add_limit(std::size_t most) { the_pool().add_limit(most); }
void remove_limit(std::size_t most) { the_pool().remove_limit(most); }
bool is_cancelled() { return is_cancelled_around(current_job); }

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

}  // namespace kinemend::pool
