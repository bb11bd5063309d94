#pragma once

#include <cstddef>
#include <functional>
#include <mutex>

namespace kinemend {

/// How far some work is, which may be told of from any thread: tells on, one call at a time, shares
/// (0..1) that rise, in steps that can be seen. Without a callback it does nothing.
class ShareProgress {
 public:
  explicit ShareProgress(const std::function<void(double)>& tell) : tell_(tell) {}
  ShareProgress(const ShareProgress&) = delete;
  ShareProgress& operator=(const ShareProgress&) = delete;

  /// What follows is the part from where the last one ended up to `done`, in so many steps.
  void begin_part(double done, std::size_t steps) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    from_ = to_;
    to_ = done;
    steps_ = steps;
    count_ = 0;
    report(from_);
  }

  /// One step of the part is done; more of them than were announced count for nothing.
  void step() {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    if (count_ < steps_) ++count_;
    const double share =
        steps_ > 0 ? static_cast<double>(count_) / static_cast<double>(steps_) : 0.0;
    report(from_ + share * (to_ - from_));
  }
  /// So far, where the work itself knows.
  void reach(double done) {
    if (!tell_) return;
    const std::lock_guard lock(mutex_);
    report(done);
  }

 private:
  void report(double done) {
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
