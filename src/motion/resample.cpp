// Converts a take to another frame rate by cubic interpolation.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/motion.hpp"
#include "motion/conversions.hpp"

namespace kinemend {

namespace {

// Limits memory; chosen by hand.
constexpr double most_samples = 1e8;

// Position of a new frame among the old frames: `share` (0 to 1) from `before` to `before + 1`.
struct Place {
  std::size_t before = 0;
  double share = 0;
};

std::vector<Place> places(std::size_t frames, std::size_t tracks, double old_rate, double rate) {
  check_frame_rate(rate);
  if (frames == 0) return {};
  // Not swept.
  constexpr double rounding = 1e-6;  // share of a frame that the rates may be off by rounding
  const double step = old_rate / rate, last = static_cast<double>(frames - 1);
  const double count = std::floor(last / step + rounding) + 1;
  if (count * static_cast<double>(std::max<std::size_t>(tracks, 1)) > most_samples) {
    throw Error(ErrorKind::usage,
                fmt::format("{} Hz would make {:.3g} frames of this take", rate, count));
  }
  std::vector<Place> result(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double at = std::min(static_cast<double>(i) * step, last), whole = std::round(at);
    const bool on_frame = std::fabs(at - whole) <= rounding;
    const double before = on_frame ? whole : std::floor(at);
    result[i] = {static_cast<std::size_t>(before), on_frame ? 0.0 : at - before};
  }
  return result;
}

// Catmull-Rom: weights of the samples -1, 0, 1, 2 at `u` between 0 and 1.
std::array<double, 4> cubic_weights(double u) {
  const double u2 = u * u, u3 = u2 * u;
  return {-0.5 * u3 + u2 - 0.5 * u, 1.5 * u3 - 2.5 * u2 + 1, -1.5 * u3 + 2 * u2 + 0.5 * u,
          0.5 * u3 - 0.5 * u2};
}

// The four frames around a place. An outer frame is missing if the take ends or its sample is not
// observed; it is then extrapolated linearly.
struct Neighbours {
  std::size_t outer_before, before, after, outer_after;
  bool has_outer_before, has_outer_after;
};

template <class IsObserved>
Neighbours neighbours_of(std::size_t before, std::size_t frames, IsObserved is_observed) {
  const std::size_t after = before + 1;
  const bool earlier = before > 0 && is_observed(before - 1);
  const bool later = after + 1 < frames && is_observed(after + 1);
  return {earlier ? before - 1 : before, before, after, later ? after + 1 : after, earlier, later};
}

template <class At>
Vec3 interpolate_position(const Neighbours& n, double u, At at) {
  const Vec3 p0 = at(n.before), p1 = at(n.after);
  const Vec3 earlier = n.has_outer_before ? at(n.outer_before) : p0 - (p1 - p0);
  const Vec3 later = n.has_outer_after ? at(n.outer_after) : p1 + (p1 - p0);
  const auto w = cubic_weights(u);
  return w[0] * earlier + w[1] * p0 + w[2] * p1 + w[3] * later;
}

template <class At>
Quat interpolate_rotation(const Neighbours& n, double u, At at) {
  const Quat base = at(n.before);
  const auto vector_to = [&](std::size_t frame) { return log(conjugate(base) * at(frame)); };
  const Vec3 next = vector_to(n.after);
  const Vec3 earlier = n.has_outer_before ? vector_to(n.outer_before) : -next;
  const Vec3 later = n.has_outer_after ? vector_to(n.outer_after) : 2.0 * next;
  const auto w = cubic_weights(u);
  return normalized(base * exp(w[0] * earlier + w[2] * next + w[3] * later));
}

bool always(std::size_t) { return true; }

// Compares two rates to six digits.
bool is_own_rate(double own, double rate) { return std::fabs(rate - own) <= 5e-6 * own; }

// Renumbers the first frame. Frame 1 of the trial keeps its time, and the number is rounded. Events
// are timed from frame 1 and keep their moment in the motion.
void renumber(const Take& clip, Take& result) {
  const double before_s = static_cast<double>(clip.first_frame - 1) / clip.frame_rate_hz;
  result.first_frame = clip.first_frame;
  if (clip.first_frame > 1) result.first_frame = 1 + std::llround(before_s * result.frame_rate_hz);
  const double after_s = static_cast<double>(result.first_frame - 1) / result.frame_rate_hz;
  constexpr double rounding_s = 1e-9;
  if (std::fabs(after_s - before_s) < rounding_s) return;
  for (MarkerEvent& event : result.events) event.time_s += after_s - before_s;
}

void resample_rotations(const Take& clip, const std::vector<Place>& at, Take& result) {
  const std::size_t joints = clip.joint_count(), frames = clip.frame_count();
  result.rotations.resize(at.size() * joints);
  if (!clip.observed.empty()) result.observed.resize(at.size() * joints);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto [before, share] = at[i];
    for (std::size_t j = 0; j < joints; ++j) {
      const auto seen = [&](std::size_t f) { return clip.is_observed(f, j); };
      Quat& rotation = result.rotations[i * joints + j];
      rotation = clip.rotation(before, j);
      if (share > 0) {
        rotation = interpolate_rotation(neighbours_of(before, frames, seen), share,
                                        [&](std::size_t f) { return clip.rotation(f, j); });
      }
      if (!clip.observed.empty()) {
        result.observed[i * joints + j] = seen(before) && (share == 0 || seen(before + 1));
      }
    }
  }
}

std::vector<Vec3> resample_positions(const std::vector<Vec3>& values, std::size_t width,
                                     std::size_t frames, const std::vector<Place>& at) {
  std::vector<Vec3> result(at.size() * width);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto [before, share] = at[i];
    for (std::size_t k = 0; k < width; ++k) {
      result[i * width + k] =
          share == 0 ? values[before * width + k]
                     : interpolate_position(neighbours_of(before, frames, always), share,
                                            [&](std::size_t f) { return values[f * width + k]; });
    }
  }
  return result;
}

Take resample_joints(const Take& clip, double frame_rate_hz) {
  const std::vector<Place> at =
      places(clip.frame_count(), clip.joint_count(), clip.frame_rate_hz, frame_rate_hz);
  if (is_own_rate(clip.frame_rate_hz, frame_rate_hz)) return clip;
  Take result = slice(clip, 0, 0);
  result.frame_rate_hz = frame_rate_hz;
  resample_rotations(clip, at, result);
  result.positions = resample_positions(clip.positions, clip.point_count(), clip.frame_count(), at);
  return result;
}

Take resample_markers(const Take& clip, double frame_rate_hz) {
  const std::size_t markers = clip.marker_count(), frames = clip.frame_count();
  const std::vector<Place> at = places(frames, markers, clip.frame_rate_hz, frame_rate_hz);
  // A file with only analog samples has no motion to convert.
  if (markers == 0 || is_own_rate(clip.frame_rate_hz, frame_rate_hz)) return clip;
  Take result = make_marker_take(clip.names, at.size(), frame_rate_hz);
  result.is_position = clip.is_position;
  result.unit = clip.unit;
  result.events = clip.events;
  TakeChange change;
  change.resampled = true;
  result.source = {clip.source.name, clip.source.format, document_after(clip.source, change)};
  renumber(clip, result);
  if (!clip.residuals.empty()) result.residuals.assign(at.size() * markers, -1.0F);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const auto [before, share] = at[i];
    for (std::size_t m = 0; m < markers; ++m) {
      const auto seen = [&](std::size_t f) { return clip.is_observed(f, m); };
      if (!seen(before) || (share > 0 && !seen(before + 1))) continue;
      const std::size_t sample = i * markers + m;
      result.observed[sample] = 1;
      result.positions[sample] = clip.position(before, m);
      if (share > 0) {
        result.positions[sample] =
            interpolate_position(neighbours_of(before, frames, seen), share,
                                 [&](std::size_t f) { return clip.position(f, m); });
      }
      if (!clip.residuals.empty()) result.residuals[sample] = clip.residuals[before * markers + m];
    }
  }
  return result;
}

}  // namespace

Take resample(const Take& take, double frame_rate_hz) {
  return take.has_joints() ? resample_joints(take, frame_rate_hz)
                           : resample_markers(take, frame_rate_hz);
}

}  // namespace kinemend
