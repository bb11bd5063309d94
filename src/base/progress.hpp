// Reports the progress of parallel work to one callback.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace kinemend {

/// Reports the progress of some work to a callback, as a rising share (0..1) in visible steps.
/// Thread-safe: the callback gets one call at a time. Without a callback it does nothing.
class ShareProgress {
 public:
  explicit ShareProgress(const std::function<void(double)>& tell) : tell_(tell) {}
  ShareProgress(const ShareProgress&) = delete;
  ShareProgress& operator=(const ShareProgress&) = delete;

  /// Begins the next part of the work, which ends at the share `done` and has `steps` steps.
  void begin_part(double done, std::size_t steps) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    from_ = to_;
    to_ = done;
    steps_ = steps;
    count_ = 0;
    report(from_);
  }

  /// One step of the part is done. More steps than announced are ignored.
  void step() {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    if (count_ < steps_) ++count_;
    const double share =
        steps_ > 0 ? static_cast<double>(count_) / static_cast<double>(steps_) : 0.0;
    report(from_ + share * (to_ - from_));
  }
  /// Sets the completed share, for work that knows it.
  void reach(double done) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    report(done);
  }

 private:
  void report(double done) {
    // Share of all work; chosen by hand.
    constexpr double least_step = 0.005;
    if (done < told_ + least_step) return;
    told_ = done;
    tell_(done);
  }

  const std::function<void(double)>& tell_;
  std::mutex mutex_;
  double told_ = 0, from_ = 0, to_ = 0;
  std::size_t steps_ = 0, count_ = 0;
};

}  // namespace kinemend
