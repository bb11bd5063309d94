// Runs independent pieces of work in parallel if that is faster, and reports their progress to one
// callback.
#pragma once

#include <cstddef>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace kinemend {

using IndexWork = std::function<void(std::size_t)>;
/// Work on the items [first, last).
using RangeWork = std::function<void(std::size_t first, std::size_t last)>;

/// Calls `work(i)` for each i below `count`, in parallel if `samples` (the total amount of work) is
/// large enough. `work(i)` must write only to its own data.
void for_each_parallel(std::size_t count, std::size_t samples, const IndexWork& work);

/// Calls `work(i)` for each i below `count`, in parallel. After the first exception, which is
/// rethrown, no further piece begins.
void for_each_index(std::size_t count, const IndexWork& work);

/// Calls `work` for ranges that together are [first, last), in parallel. A range has at least about
/// `least` items; where the ranges end depends on the number of threads.
void for_each_range(std::size_t first, std::size_t last, std::size_t least, const RangeWork& work);

/// Whether a piece of work that runs beside this one, or around it, has thrown.
bool work_is_cancelled();

/// The stages of each piece of a long text or file; only a limited number of pieces is held at a
/// time.
struct PieceStages {
  IndexWork choose;  ///< in order; may be empty
  IndexWork write;   ///< in any order, in parallel; may be empty
  IndexWork append;  ///< in order
};
/// `read(slot)` fills a slot below `slots` with the next piece, in order. It returns false
/// after the last piece.
/// A slot is filled again only after its piece was appended. Stages of different pieces may
/// run at the same time.
void for_each_piece(std::size_t slots, const std::function<bool(std::size_t slot)>& read,
                    const PieceStages& stages);

using IndexRange = std::pair<std::size_t, std::size_t>;
/// [first, last) in ranges of at most `most` items, found by halving, in order. They do not depend
/// on the number of threads.
std::vector<IndexRange> halved_ranges(std::size_t first, std::size_t last, std::size_t most);

/// The sum of `summand(first, last)` over ranges of at most `most` items that together are
/// [0, count), added in an order that does not depend on the number of threads.
template <class Sum, class Summand>
Sum sum_in_halves(std::size_t count, std::size_t most, const Summand& summand) {
  const std::vector<IndexRange> ranges = halved_ranges(0, count, most);
  std::vector<Sum> sums(ranges.size());
  for_each_index(ranges.size(), [&](std::size_t i) {
    sums[i] = Sum{} + summand(ranges[i].first, ranges[i].second);
  });
  std::size_t used = 0;
  const auto total = [&](const auto& self, std::size_t first, std::size_t last) -> Sum {
    if (last - first <= most) return sums[used++];
    const std::size_t middle = first + (last - first) / 2;
    const Sum left = self(self, first, middle);
    return left + self(self, middle, last);
  };
  return count == 0 ? Sum{} : total(total, 0, count);
}

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

/// While it lives, threads of the standard library do the work, even if the library is built with
/// oneTBB. For tests and measurements; not while other work runs.
class StandardThreads {
 public:
  /// `threads`: 0: the number of hardware threads.
  explicit StandardThreads(std::size_t threads = 0);
  ~StandardThreads();
  StandardThreads(const StandardThreads&) = delete;
  StandardThreads& operator=(const StandardThreads&) = delete;

 private:
  std::size_t threads_before_;
  [[maybe_unused]] bool used_before_;
};

}  // namespace kinemend
