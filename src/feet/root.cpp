// Finds the least lowering in each frame and smooths it over time.
#include "base/portable.hpp"
#include "feet/steps.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace kinemend::feet {

namespace {

// Returns the least lowering that brings the ankle within reach; 0 if lowering does not help.
double drop_for(const LegPose& pose, const Reach& reach, const FootTarget& target, Up up) {
  // The largest lowering as a share of the leg's length, and how upright the leg must be. Chosen by
  // hand, not swept.
  constexpr double most_share = 0.1, least_cosine = 0.5;
  const Vec3 ankle_at = target.place - rotate(target.rotation, target.pivot);
  const Vec3 way = ankle_at - pose.hip_at;
  const double beyond = dot(way, way) - reach.easy * reach.easy;
  const double below = -along(way, up);
  if (beyond <= 0 || below < least_cosine * norm(way)) return 0;
  const double root = std::sqrt(std::max(below * below - beyond, 0.0));
  return std::min(below - root, most_share * reach.most);
}

std::vector<double> running_maximum(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> result(values.size());
  std::deque<std::size_t> candidates;
  std::size_t next = 0;
  for (std::size_t f = 0; f < values.size(); ++f) {
    for (; next < values.size() && next <= f + reach; ++next) {
      while (!candidates.empty() && values[candidates.back()] <= values[next])
        candidates.pop_back();
      candidates.push_back(next);
    }
    while (candidates.front() + reach < f) candidates.pop_front();
    result[f] = values[candidates.front()];
  }
  return result;
}

// Returns a mean with the weights of a raised cosine; the ends are repeated.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> weights(reach + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= reach; ++k) {
    weights[k] = 1 + portable::cos(pi * static_cast<double>(k) / static_cast<double>(reach + 1));
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  std::vector<double> result(values.size());
  for (std::ptrdiff_t f = 0; f <= last; ++f) {
    double total = 0;
    for (std::ptrdiff_t k = -static_cast<std::ptrdiff_t>(reach);
         k <= static_cast<std::ptrdiff_t>(reach); ++k) {
      total += weights[static_cast<std::size_t>(std::abs(k))] *
               values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(f + k, 0, last))];
    }
    result[static_cast<std::size_t>(f)] = total / sum;
  }
  return result;
}

}  // namespace

std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s) {
  std::vector<double> needed(motion.frames);
  bool any = false;
  for (std::size_t f = 0; f < motion.frames; ++f) {
    for (std::size_t l = 0; l < motion.legs(); ++l) {
      const std::size_t i = f * motion.legs() + l;
      if (targets[i].hold < 1 || !targets[i].moves) continue;
      const double drop = drop_for(motion.poses[i], reaches[i], targets[i], up);
      needed[f] = std::max(needed[f], drop);
      any = any || drop > 0;
    }
  }
  if (!any) return needed;
  // The mean of a maximum over its own width is never below the input.
  const auto reach =
      static_cast<std::size_t>(std::max(1L, std::lround(blend_s * motion.frame_rate_hz / 2)));
  return smoothed(running_maximum(needed, reach), reach);
}

}  // namespace kinemend::feet
