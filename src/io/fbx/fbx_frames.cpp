// Distinguishes baked takes, with a key per frame, from takes that are keyed by hand.
#include "io/fbx/fbx_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "kinemend/experimental/frame_rate.hpp"

namespace kinemend {

namespace {

// How far a key may lie from its frame, as a share of the step: programs round times.
constexpr double grid_tolerance = 0.02;
// Motion is baked at 10 Hz or more; slower regular keys are set by hand.
constexpr double least_baked_rate_hz = 10;
constexpr double same_rate = 1e-3;

struct FbxSpan {
  std::int64_t first = 0;
  std::int64_t last = 0;
};

bool lies_on_grid(const std::vector<std::int64_t>& times, double step) {
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double off = static_cast<double>(times[k] - times[0]) - static_cast<double>(k) * step;
    if (std::fabs(off) > grid_tolerance * step) return false;
  }
  return true;
}

class FbxFrameFinder {
 public:
  FbxFrameFinder(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                 const std::vector<std::size_t>& curves, std::size_t most_frames)
      : tree_(tree), scene_(scene), motion_(motion), most_(most_frames) {
    for (const std::size_t c : curves) {
      if (motion.curves[c].key_count() > 1 && !motion.curves[c].is_constant())
        moving_.push_back(&motion.curves[c]);
    }
    if (!moving_.empty()) return;
    for (const std::size_t c : curves) {
      if (motion.curves[c].key_count() > 1) moving_.push_back(&motion.curves[c]);
    }
  }

  FbxFrames find() {
    FbxFrames frames;
    frames.rate_hz = scene_.frame_rate_hz;
    frames.step_ticks = scene_.ticks_per_second / frames.rate_hz;
    if (moving_.empty()) {
      frames.times.push_back(motion_.curves.empty() ? 0 : motion_.curves.front().times->front());
      return frames;
    }
    FbxSpan span{moving_.front()->times->front(), moving_.front()->times->back()};
    for (const FbxCurve* curve : moving_) {
      span.first = std::min(span.first, curve->times->front());
      span.last = std::max(span.last, curve->times->back());
    }
    if (!take_keys(span, frames)) lay_grid(span, frames);
    for (const FbxCurve* curve : moving_) frames.resampled += is_baked(*curve, frames) ? 0 : 1;
    return frames;
  }

 private:
  // Returns the keys that most curves have.
  const std::vector<std::int64_t>& common_times() const {
    using Kind = std::array<std::int64_t, 3>;
    std::map<Kind, std::pair<std::size_t, const FbxCurve*>> kinds;
    for (const FbxCurve* curve : moving_) {
      const auto& times = *curve->times;
      auto& kind = kinds[{static_cast<std::int64_t>(times.size()), times.front(), times.back()}];
      ++kind.first;
      kind.second = curve;
    }
    const FbxCurve* best = moving_.front();
    std::size_t most = 0;
    for (const auto& [kind, found] : kinds) {
      if (found.first < most) continue;
      most = found.first;
      best = found.second;
    }
    return *best->times;
  }

  // Uses the keys that most curves have if they form a grid over the whole span.
  bool take_keys(FbxSpan span, FbxFrames& frames) const {
    const std::vector<std::int64_t>& times = common_times();
    const double step =
        static_cast<double>(times.back() - times.front()) / static_cast<double>(times.size() - 1);
    const double rate_hz = scene_.ticks_per_second / step;
    const bool is_mode = std::fabs(rate_hz / scene_.frame_rate_hz - 1) < same_rate;
    if (times.front() != span.first || times.back() != span.last || !lies_on_grid(times, step) ||
        !is_usable_frame_rate(rate_hz) || (rate_hz < least_baked_rate_hz && !is_mode))
      return false;
    check_count(static_cast<double>(times.size()));
    FbxFrames found;
    found.times = times;
    found.step_ticks = step;
    found.rate_hz = is_mode ? scene_.frame_rate_hz : std::round(rate_hz * 1e6) / 1e6;
    const auto baked = std::count_if(moving_.begin(), moving_.end(), [&](const FbxCurve* curve) {
      return is_baked(*curve, found);
    });
    if (2 * static_cast<std::size_t>(baked) < moving_.size() && !is_mode) return false;
    frames = std::move(found);
    return true;
  }

  void lay_grid(FbxSpan span, FbxFrames& frames) const {
    const double length = static_cast<double>(span.last) - static_cast<double>(span.first);
    const double steps = std::floor(length / frames.step_ticks + grid_tolerance);
    check_count(steps + 1);
    const auto count = static_cast<std::size_t>(steps) + 1;
    for (std::size_t i = 0; i < count; ++i) {
      const double ticks = static_cast<double>(i) * frames.step_ticks;
      frames.times.push_back(span.first + static_cast<std::int64_t>(std::llround(ticks)));
    }
  }

  void check_count(double count) const {
    if (count <= static_cast<double>(most_)) return;
    throw tree_.error_at(tree_.records[moving_.front()->record].begin,
                         fmt::format("the keys span {:.0f} frames: too much memory for a file of "
                                     "{} bytes",
                                     count, tree_.bytes.size()));
  }

  const FbxTree& tree_;
  const FbxScene& scene_;
  const FbxMotion& motion_;
  std::size_t most_;
  std::vector<const FbxCurve*> moving_;
};

}  // namespace

bool is_baked(const FbxCurve& curve, const FbxFrames& frames) {
  if (curve.key_count() != frames.times.size()) return false;
  const std::vector<std::int64_t>& times = *curve.times;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const double off = static_cast<double>(times[k] - frames.times[k]);
    if (std::fabs(off) > grid_tolerance * frames.step_ticks) return false;
  }
  return true;
}

FbxFrames find_fbx_frames(const FbxTree& tree, const FbxScene& scene, const FbxMotion& motion,
                          const std::vector<std::size_t>& curves, std::size_t most_frames) {
  return FbxFrameFinder(tree, scene, motion, curves, most_frames).find();
}

}  // namespace kinemend
