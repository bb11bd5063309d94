// Makes tracks from takes, hides spans of them, and builds charts through gaps.
#include "fill/track.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>

namespace kinemend::fill {

namespace {

// Not swept. A turn longer by a whole turn is chosen if its distance from the velocities, taken
// over this window, is at most this share of the shortest turn's.
constexpr double clearly_shorter = 0.5;
constexpr double turn_window_s = 0.05;

// Returns the mean angular velocity (radians a frame) over the observed steps from `frame` in one
// direction.
Vec3 mean_velocity(std::span<const Quat> rotations, std::span<const std::uint8_t> observed,
                   std::size_t frame, bool forward, std::size_t window) {
  Vec3 sum;
  double count = 0;
  for (std::size_t k = 0; k < window; ++k) {
    const std::size_t from = forward ? frame + k : frame - k - 1;
    if (forward ? from + 1 >= rotations.size() : frame < k + 1) break;
    if (!observed[from] || !observed[from + 1]) break;
    sum += log(conjugate(rotations[from]) * rotations[from + 1]);
    count += 1;
  }
  return count > 0 ? (1 / count) * sum : Vec3{};
}

// Returns the rotation vector of the turn that a gap makes from `before` to `behind`.
Vec3 turn_through(std::span<const Quat> rotations, std::span<const std::uint8_t> observed,
                  std::size_t before, std::size_t behind, double frame_rate_hz) {
  const std::size_t window = frames_in(turn_window_s, frame_rate_hz, 2);
  const Vec3 shortest = log(conjugate(rotations[before]) * rotations[behind]);
  const double angle = norm(shortest);
  if (angle < 1e-6) return shortest;
  const Vec3 velocity = 0.5 * (mean_velocity(rotations, observed, before, false, window) +
                               mean_velocity(rotations, observed, behind, true, window));
  const Vec3 expected = static_cast<double>(behind - before) * velocity;
  Vec3 best = shortest;
  double least = clearly_shorter * norm(expected - shortest);
  for (const double turns : {-1.0, 1.0}) {
    const Vec3 longer = ((angle + turns * 2 * pi) / angle) * shortest;
    if (norm(expected - longer) >= least) continue;
    least = norm(expected - longer);
    best = longer;
  }
  return best;
}

// The reference crosses the span as it would a gap, and later frames move along.
void hide_from_chart(Track& track, FrameSpan span, TakeEnds ends, double frame_rate_hz) {
  RotationChart& chart = track.chart;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    if (ends.any()) {
      const std::size_t side = ends.at_start ? span.last + 1 : span.first - 1;
      chart.reference[f] = chart.reference[side];
      chart.path[f] = chart.path[side];
    }
  }
  if (ends.any()) return;
  const std::size_t before = span.first - 1, behind = span.last + 1;
  const Vec3 turn = turn_through(chart.reference, track.observed, before, behind, frame_rate_hz);
  const Vec3 moved = chart.path[before] + turn - chart.path[behind];
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = static_cast<double>(f - before) / static_cast<double>(behind - before);
    chart.reference[f] = chart.reference[before] * exp(t * turn);
    chart.path[f] = chart.path[before] + t * turn;
  }
  for (std::size_t f = behind; f < chart.path.size(); ++f) {
    chart.path[f] += moved;
    track.values[f] += moved;
  }
}

}  // namespace

RotationChart make_rotation_chart(std::span<const Quat> rotations,
                                  std::span<const std::uint8_t> observed, double frame_rate_hz) {
  const std::size_t frames = rotations.size();
  RotationChart chart{{rotations.begin(), rotations.end()}, std::vector<Vec3>(frames)};
  std::size_t first = 0;
  while (first < frames && !observed[first]) ++first;
  if (first == frames) return chart;
  std::fill_n(chart.reference.begin(), first, rotations[first]);
  for (std::size_t last = first, f = first + 1; f <= frames; ++f) {
    if (f < frames && !observed[f]) continue;
    if (f == frames) {
      for (std::size_t k = last + 1; k < f; ++k) {
        chart.reference[k] = rotations[last];
        chart.path[k] = chart.path[last];
      }
      break;
    }
    const bool is_gap = f > last + 1;
    const Vec3 turn = is_gap ? turn_through(rotations, observed, last, f, frame_rate_hz)
                             : log(conjugate(rotations[last]) * rotations[f]);
    for (std::size_t k = last + 1; k <= f; ++k) {
      const double t = static_cast<double>(k - last) / static_cast<double>(f - last);
      if (k < f) chart.reference[k] = rotations[last] * exp(t * turn);
      chart.path[k] = chart.path[last] + t * turn;
    }
    last = f;
  }
  return chart;
}

Track rotation_track(const Take& clip, std::size_t joint) {
  Track track;
  track.is_position = false;
  track.joint = joint;
  const std::size_t frames = clip.frame_count();
  std::vector<Quat> rotations(frames);
  track.observed.resize(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    rotations[f] = clip.rotation(f, joint);
    track.observed[f] = clip.is_observed(f, joint) ? 1 : 0;
  }
  track.chart = make_rotation_chart(rotations, track.observed, clip.frame_rate_hz);
  track.values = track.chart.path;
  return track;
}

Track position_track(const Take& clip, std::size_t position) {
  const std::size_t frames = clip.frame_count();
  Track track{std::vector<Vec3>(frames), std::vector<std::uint8_t>(frames)};
  if (position > 0) track.joint = static_cast<std::size_t>(clip.translated_joints[position - 1]);
  for (std::size_t f = 0; f < frames; ++f) {
    track.values[f] = clip.position(f, position);
    track.observed[f] = clip.is_position_observed(f, position) ? 1 : 0;
  }
  return track;
}

FrameSpan surroundings(FrameSpan span, TakeEnds ends, std::size_t reach, std::size_t frames) {
  return {ends.at_start ? span.first : span.first - std::min(reach, span.first),
          ends.at_end ? span.last : std::min(span.last + reach, frames - 1)};
}

Track part_of(const Track& track, FrameSpan kept) {
  const auto cut = [&](const auto& values) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(kept.first);
    return std::decay_t<decltype(values)>(first,
                                          first + static_cast<std::ptrdiff_t>(kept.length()));
  };
  Track part{cut(track.values), cut(track.observed), track.is_position};
  part.joint = track.joint;
  part.first_frame = track.first_frame + kept.first;
  if (!track.is_position) part.chart = {cut(track.chart.reference), cut(track.chart.path)};
  return part;
}

Track hide_span(const Track& track, FrameSpan span, TakeEnds ends, std::size_t reach,
                double frame_rate_hz) {
  const FrameSpan kept = surroundings(span, ends, reach, track.frames());
  Track part = part_of(track, kept);
  const FrameSpan hidden{span.first - kept.first, span.last - kept.first};
  for (std::size_t f = hidden.first; f <= hidden.last; ++f) part.observed[f] = 0;
  if (!track.is_position) hide_from_chart(part, hidden, ends, frame_rate_hz);
  return part;
}

Track without_span(const Track& track, FrameSpan span, double frame_rate_hz) {
  Track other = track;
  for (std::size_t f = span.first; f <= span.last; ++f) other.observed[f] = 0;
  if (track.is_position) return other;
  other.chart = make_rotation_chart(track.chart.reference, other.observed, frame_rate_hz);
  other.values = other.chart.path;
  return other;
}

std::vector<std::size_t> evenly(const std::vector<std::size_t>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<std::size_t> chosen(most);
  for (std::size_t i = 0; i < most; ++i) {
    chosen[i] = frames[(2 * i + 1) * frames.size() / (2 * most)];
  }
  return chosen;
}

std::vector<std::size_t> frames_of(FrameSpan span, std::size_t most) {
  std::vector<std::size_t> frames(span.length());
  std::iota(frames.begin(), frames.end(), span.first);
  return evenly(frames, most);
}

}  // namespace kinemend::fill
