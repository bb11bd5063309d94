// Blends tracks with their input; a repaired sample that is blended in part gets the residuals of
// its measured neighbours.
#include "clean/changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/frame_span.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

namespace {

/// How far the input of a sample can be trusted.
enum class Evidence : std::uint8_t {
  measured,
  repaired,  ///< measured, but replaced by the cleaner
  missing
};

// Chosen by hand, not swept.
constexpr std::size_t most_neighbours = 8;

// The mean of some residuals at their mean frame.
struct Side {
  double frame = 0;
  Vec3 residual;
  bool found = false;
};

class Neighbours {
 public:
  Neighbours(const std::vector<Evidence>& evidence,
             const std::function<Vec3(std::size_t)>& residual)
      : evidence_(evidence), residual_(residual) {}

  // Uses frames before `end`, the nearest first.
  Side before(std::size_t end) const {
    Sum sum;
    for (std::size_t f = end; f-- > 0 && sum.count < most_neighbours;) add(f, sum);
    return sum.mean();
  }
  Side from(std::size_t begin) const {
    Sum sum;
    for (std::size_t f = begin; f < evidence_.size() && sum.count < most_neighbours; ++f)
      add(f, sum);
    return sum.mean();
  }

 private:
  struct Sum {
    std::size_t count = 0;
    double frames = 0;
    Vec3 residuals;

    Side mean() const {
      if (count == 0) return {};
      const double share = 1 / static_cast<double>(count);
      return {share * frames, share * residuals, true};
    }
  };

  void add(std::size_t frame, Sum& sum) const {
    if (evidence_[frame] != Evidence::measured) return;
    sum.frames += static_cast<double>(frame);
    sum.residuals += residual_(frame);
    ++sum.count;
  }

  const std::vector<Evidence>& evidence_;
  const std::function<Vec3(std::size_t)>& residual_;
};

Vec3 between(const Side& before, const Side& after, double frame) {
  if (!before.found || !after.found) return before.found ? before.residual : after.residual;
  const double share = (frame - before.frame) / (after.frame - before.frame);
  return before.residual + share * (after.residual - before.residual);
}

/// `observed` and `stated` may be empty: all are observed, and no action is stated.
std::vector<Evidence> evidence_of(std::size_t frames, const std::vector<std::uint8_t>& observed,
                                  const std::vector<Action>& stated) {
  std::vector<Evidence> evidence(frames, Evidence::measured);
  for (std::size_t f = 0; f < frames; ++f) {
    const Action action = stated.empty() ? Action::kept : stated[f];
    if (action == Action::despiked || action == Action::filled) evidence[f] = Evidence::repaired;
    if (!observed.empty() && observed[f] == 0) evidence[f] = Evidence::missing;
  }
  return evidence;
}

/// A repaired sample has no input of its own to blend with. It gets the residual (from the cleaned
/// value to the input) of its neighbours instead: on the straight line between the mean residuals
/// of the eight nearest measured samples on either side, or the mean of the only side that has any.
/// White noise nearly vanishes in such a mean; a bend that smoothing cuts, or a foot that is moved,
/// is kept. `residual(f)` is called for measured samples only. Returns one vector for each frame,
/// zero if it was not repaired; empty if no sample was repaired.
std::vector<Vec3> residuals_of_repaired(const std::vector<Evidence>& evidence,
                                        const std::function<Vec3(std::size_t)>& residual) {
  const std::size_t frames = evidence.size();
  if (std::find(evidence.begin(), evidence.end(), Evidence::repaired) == evidence.end()) return {};
  const Neighbours neighbours(evidence, residual);
  std::vector<Vec3> residuals(frames);
  for (std::size_t f = 0; f < frames;) {
    std::size_t end = f;
    while (end < frames && evidence[end] == Evidence::repaired) ++end;
    if (end == f) {
      ++f;
      continue;
    }
    const Side before = neighbours.before(f), after = neighbours.from(end);
    for (; f < end; ++f) residuals[f] = between(before, after, static_cast<double>(f));
  }
  return residuals;
}

// Smaller changes are rounding errors: the sample keeps its input value and its digits. Not swept.
constexpr double least_change_rad = 1e-9 * radians_per_degree;

Quat turned_towards(Quat from, Quat to, double weight, double limit) {
  const Vec3 turn = log(conjugate(from) * to);
  const double angle = norm(turn);
  const double share = angle * weight > limit ? limit / angle : weight;
  return normalized(from * exp(share * turn));
}

// Turns in the same way about the joint's own axes, so that its channels can hold the result.
// `angles` are those of the previous frame.
Quat turned_within_axes(Quat from, Quat to, double weight, double limit, RotationOrder order,
                        std::array<double, 3>& angles) {
  const auto start = to_euler_near(from, order, angles);
  const auto end = to_euler_near(to, order, start);
  angles = start;
  const auto at = [&](double share) {
    std::array<double, 3> blended{};
    for (std::size_t i = 0; i < order.count; ++i) {
      blended[i] = start[i] + share * (end[i] - start[i]);
    }
    return from_euler(blended, order);
  };
  // By definition.
  constexpr double rounding = 1 + 1e-12;
  double share = weight;
  Quat result = at(share);
  for (int step = 0; step < 50; ++step) {
    const double angle = angle_between(from, result);
    if (angle <= limit * rounding) return result;
    share *= limit / angle;
    result = at(share);
  }
  return from;
}

// Returns the angle between two rotations. Small angles, nearly all, use the arc sine's series,
// which is an order of magnitude faster.
double turn_between(Quat a, Quat b) {
  // Up to this value the series below is exact to rounding. Not swept.
  constexpr double small = 0.01;  // of sin(angle / 4)^2: 23 degrees
  const Quat nearest = align_hemisphere(b, a);
  const Quat d{a.w - nearest.w, a.x - nearest.x, a.y - nearest.y, a.z - nearest.z};
  const double x2 = dot(d, d) / 4;
  if (x2 > small) return angle_between(a, b);
  const double series =
      1 + x2 * (1.0 / 6 + x2 * (3.0 / 40 + x2 * (15.0 / 336 + x2 * (105.0 / 3456))));
  return 4 * std::sqrt(x2) * series;
}

Action action_of(const std::vector<Action>& stated, std::size_t frame, bool changed) {
  const Action action = stated.empty() ? Action::kept : stated[frame];
  if (!changed) return action == Action::refused ? action : Action::kept;
  return action == Action::kept || action == Action::refused ? Action::denoised : action;
}

// Blends one position and returns how far it moved.
double blend_position(Vec3 from, Vec3& to, double weight, std::array<bool, 3> axes, double least) {
  Vec3 shift = weight * (to - from);
  if (!axes[0]) shift.x = 0;
  if (!axes[1]) shift.y = 0;
  if (!axes[2]) shift.z = 0;
  const double distance = norm(shift);
  if (distance < least) {
    to = from;
    return 0;
  }
  const Vec3 result = weight < 1 ? from + shift : to;
  to = {axes[0] ? result.x : from.x, axes[1] ? result.y : from.y, axes[2] ? result.z : from.z};
  return distance;
}

// Whether some sample is changed only partly.
bool goes_part_way(const std::vector<double>& weights) {
  return std::any_of(weights.begin(), weights.end(), [](double w) { return w > 0 && w < 1; });
}

// Blends repaired samples. A repair is never blended with the value that it replaced, but moved as
// a blend of weight `weight` would move it if its input were like its neighbours'.
struct RepairBlend {
  std::vector<Evidence> evidence;
  std::vector<Vec3> residuals;

  // Returns the residual of a repaired sample; null for any other sample.
  const Vec3* residual(std::size_t frame, double weight) const {
    const bool repaired =
        weight > 0 && weight < 1 && !residuals.empty() && evidence[frame] == Evidence::repaired;
    return repaired ? &residuals[frame] : nullptr;
  }
};

Vec3 residual_of(Quat before, Quat after) { return log(conjugate(after) * before); }
Vec3 residual_of(Vec3 before, Vec3 after) { return before - after; }

template <class Sample>
RepairBlend repair_blend(const std::vector<double>& weights, const TrackEdit<Sample>& track) {
  if (!goes_part_way(weights)) return {};
  RepairBlend blend{evidence_of(weights.size(), track.observed, track.stated), {}};
  blend.residuals = residuals_of_repaired(
      blend.evidence, [&](std::size_t f) { return residual_of(track.before[f], track.after[f]); });
  return blend;
}

}  // namespace

std::vector<double> frame_weights(const CleanSettings& settings, std::size_t frames,
                                  std::size_t first_frame, double frame_rate_hz) {
  std::vector<double> weights(frames - first_frame, settings.strength);
  if (!settings.range) return weights;
  // The time over which a change fades in and out inside a range. Chosen by hand, not swept.
  constexpr double slope_s = 0.1;
  const auto [first, last] = *settings.range;
  const auto slope = static_cast<double>(frames_in(slope_s, frame_rate_hz, 0) + 1);
  for (std::size_t f = first_frame; f < frames; ++f) {
    double share = f >= first && f <= last ? 1.0 : 0.0;
    if (share > 0 && first > first_frame) {
      share = std::min(share, static_cast<double>(f - first + 1) / slope);
    }
    if (share > 0 && last + 1 < frames) {
      share = std::min(share, static_cast<double>(last - f + 1) / slope);
    }
    weights[f - first_frame] *= smooth_step(share);
  }
  return weights;
}

std::array<bool, 3> position_axes(const std::vector<Channel>& channels) {
  std::array<bool, 3> axes{};
  for (const Channel channel : channels) {
    if (!is_rotation(channel)) axes[static_cast<std::size_t>(axis_of(channel))] = true;
  }
  return axes;
}

TrackChanges blend(TrackEdit<Quat>& track, RotationOrder order, double most_change,
                   const std::vector<double>& weights) {
  const std::size_t frames = weights.size();
  TrackChanges changes{std::vector<double>(frames), std::vector<Action>(frames, Action::kept)};
  const RepairBlend repairs = repair_blend(weights, track);
  std::array<double, 3> angles{};
  for (std::size_t f = 0; f < frames; ++f) {
    const Quat from = track.before[f];
    Quat& result = track.after[f];
    double angle = 0;
    if (weights[f] > 0 && result != from) {
      const bool seen = track.is_observed(f);
      const double limit = seen ? most_change : 2 * pi;
      // A value in a gap is not motion, so the result is not blended with it.
      double weight = seen ? weights[f] : 1;
      if (const Vec3* residual = repairs.residual(f, weight)) {
        result = normalized(result * exp((1 - weight) * *residual));
        weight = 1;
      }
      angle = turn_between(from, result);
      if (order.count < 3) {
        result = turned_within_axes(from, result, weight, limit, order, angles);
        angle = angle_between(from, result);
      } else if (weight < 1 || angle > limit) {
        result = turned_towards(from, result, weight, limit);
        angle = std::min(angle * weight, limit);
      }
    }
    if (angle < least_change_rad) result = from, angle = 0;
    changes.amounts[f] = angle * degrees_per_radian;
    changes.actions[f] = action_of(track.stated, f, angle > 0);
  }
  return changes;
}

TrackChanges blend(TrackEdit<Vec3>& track, const PositionLimits& limits,
                   const std::vector<double>& weights) {
  const std::size_t frames = weights.size();
  TrackChanges changes{std::vector<double>(frames), std::vector<Action>(frames, Action::kept)};
  const RepairBlend repairs = repair_blend(weights, track);
  for (std::size_t f = 0; f < frames; ++f) {
    const bool seen = track.is_observed(f);
    if (!seen && limits.gaps == GapTreatment::cut) {
      const bool filled = !track.stated.empty() && track.stated[f] == Action::filled;
      if (filled && weights[f] > 0) changes.actions[f] = Action::filled;
      continue;
    }
    double weight = seen || weights[f] <= 0 ? weights[f] : 1;
    if (const Vec3* residual = repairs.residual(f, weight)) {
      track.after[f] += (1 - weight) * *residual;
      weight = 1;
    }
    const double way = norm(track.after[f] - track.before[f]);
    if (way * weight > limits.most) weight = limits.most / way;
    changes.amounts[f] =
        blend_position(track.before[f], track.after[f], weight, limits.axes, limits.least);
    changes.actions[f] = action_of(track.stated, f, changes.amounts[f] > 0);
  }
  return changes;
}

}  // namespace kinemend
