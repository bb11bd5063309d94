// A mailbox between the worker thread and the thread that talks to Python.
#include "running.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "kinemend/extend/system.hpp"

namespace kinemend::python {

namespace {

// Maximum delay until Ctrl-C is noticed.
constexpr std::chrono::milliseconds between_looks(20);

struct News {
  std::string stage;
  double done = 0;
};

class Mailbox {
 public:
  explicit Mailbox(bool has_reader) : has_reader_(has_reader) {}

  void stop() { stopped_ = true; }
  const std::atomic<bool>& stopped() const { return stopped_; }
  void put(std::string_view stage, double done) {
    if (stopped_) throw WorkStopped();
    if (!has_reader_) return;
    {
      const std::lock_guard lock(mutex_);
      news_.push_back({std::string(stage), done});
    }
    changed_.notify_one();
  }
  void end(std::exception_ptr error) {
    {
      const std::lock_guard lock(mutex_);
      error_ = std::move(error);
      ended_ = true;
    }
    changed_.notify_one();
  }
  /// Returns whether the work has ended; moves news since the last call to `news`.
  bool wait(std::vector<News>& news) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, between_looks, [&] { return ended_ || !news_.empty(); });
    news = std::exchange(news_, {});
    return ended_;
  }
  /// Valid after the end.
  const std::exception_ptr& error() const { return error_; }

 private:
  const bool has_reader_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<News> news_;
  std::exception_ptr error_;
  bool ended_ = false;
};

// The exception that Python raises for the news or for a signal.
std::optional<py::error_already_set> look(const py::object& progress,
                                          const std::vector<News>& news) {
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    for (const News& one : news) progress(one.stage, one.done);
  } catch (const py::error_already_set& error) {
    return error;
  }
  return std::nullopt;
}

}  // namespace

void run_watched(const py::object& progress, const std::function<void(const Tell& tell)>& work) {
  Mailbox box(!progress.is_none());
  std::thread worker([&] {
    std::exception_ptr error;
    try {
      const StopWatch watch(box.stopped());
      work([&](std::string_view stage, double done) { box.put(stage, done); });
    } catch (...) {
      error = std::current_exception();
    }
    box.end(std::move(error));
  });
  std::optional<py::error_already_set> raised;
  for (bool ended = false; !ended;) {
    std::vector<News> news;
    {
      const py::gil_scoped_release release;
      ended = box.wait(news);
      if (ended) worker.join();
    }
    if (raised) continue;
    raised = look(progress, news);
    if (raised) box.stop();
  }
  if (raised) throw py::error_already_set(*raised);
  if (box.error()) std::rethrow_exception(box.error());
}

}  // namespace kinemend::python
