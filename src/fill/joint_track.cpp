#include "fill/joint_track.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace kinemend::fill {

namespace {

// Mean angular velocity (radians a frame) over the observed steps from `frame` in one direction.
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

// The turn from `before` to `behind` that a gap holds.
Vec3 turn_through(std::span<const Quat> rotations, std::span<const std::uint8_t> observed,
                  std::size_t before, std::size_t behind, double frame_rate_hz) {
  // A whole turn more has to agree this much better with the velocities than the shortest way.
  constexpr double clearly = 0.5;
  const auto window =
      std::max<std::size_t>(2, static_cast<std::size_t>(std::lround(0.05 * frame_rate_hz)));
  const Vec3 shortest = log(conjugate(rotations[before]) * rotations[behind]);
  const double angle = norm(shortest);
  if (angle < 1e-6) return shortest;
  const Vec3 velocity = 0.5 * (mean_velocity(rotations, observed, before, false, window) +
                               mean_velocity(rotations, observed, behind, true, window));
  const Vec3 expected = static_cast<double>(behind - before) * velocity;
  Vec3 best = shortest;
  double least = clearly * norm(expected - shortest);
  for (const double turns : {-1.0, 1.0}) {
    const Vec3 longer = ((angle + turns * 2 * pi) / angle) * shortest;
    if (norm(expected - longer) >= least) continue;
    least = norm(expected - longer);
    best = longer;
  }
  return best;
}

// The reference runs through the span as through a gap, and what comes behind it moves along.
void hide_from_chart(JointTrack& track, FrameSpan span, TakeEnds ends, double frame_rate_hz) {
  RotationChart& chart = track.chart;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    if (ends.at_start || ends.at_end) {
      const std::size_t side = ends.at_start ? span.last + 1 : span.first - 1;
      chart.reference[f] = chart.reference[side];
      chart.path[f] = chart.path[side];
    }
  }
  if (ends.at_start || ends.at_end) return;
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
    track.set(f, track.at(f) + moved);
  }
}

Vec3& position_at(Clip& clip, std::size_t position, std::size_t frame) {
  if (position == 0) return clip.root_positions[frame];
  return clip.joint_translations[frame * clip.translated_joints.size() + position - 1];
}

std::size_t position_index(const Clip& clip, std::size_t joint) {
  if (joint == 0) return 0;
  const auto& joints = clip.translated_joints;
  const auto found = std::find(joints.begin(), joints.end(), static_cast<std::int32_t>(joint));
  return 1 + static_cast<std::size_t>(found - joints.begin());
}

void store_rotation(const JointTrack& track, std::size_t frame, Clip& clip) {
  const RotationOrder order = clip.skeleton.rotation_order(track.joint);
  Quat rotation = track.rotation(frame);
  if (order.count == 1 || order.count == 2) {
    rotation = from_euler(to_euler(rotation, order), order);
  }
  const std::size_t before = frame > 0 ? frame - 1 : frame;
  clip.rotation(frame, track.joint) =
      align_hemisphere(rotation, clip.rotation(before, track.joint));
  clip.observed[frame * clip.joint_count() + track.joint] = 1;
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

JointTrack rotation_track(const Clip& clip, std::size_t joint) {
  JointTrack track;
  track.joint = joint;
  const std::size_t frames = clip.frame_count();
  std::vector<Quat> rotations(frames);
  track.observed.resize(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    rotations[f] = clip.rotation(f, joint);
    track.observed[f] = clip.is_observed(f, joint) ? 1 : 0;
  }
  track.chart = make_rotation_chart(rotations, track.observed, clip.frame_rate_hz);
  track.values.resize(3 * frames);
  for (std::size_t f = 0; f < frames; ++f) track.set(f, track.chart.path[f]);
  return track;
}

JointTrack position_track(const Clip& clip, std::size_t position) {
  JointTrack track;
  track.is_position = true;
  track.joint = position == 0 ? 0 : static_cast<std::size_t>(clip.translated_joints[position - 1]);
  const std::size_t frames = clip.frame_count();
  track.values.resize(3 * frames);
  track.observed.resize(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    track.set(f, position == 0
                     ? clip.root_positions[f]
                     : clip.joint_translations[f * clip.translated_joints.size() + position - 1]);
    track.observed[f] = clip.is_position_observed(f, position) ? 1 : 0;
  }
  return track;
}

JointTrack hide_span(const JointTrack& track, FrameSpan span, TakeEnds ends, std::size_t reach,
                     double frame_rate_hz) {
  const std::size_t first = ends.at_start ? span.first : span.first - std::min(reach, span.first);
  const std::size_t end =
      ends.at_end ? span.last + 1 : std::min(span.last + 1 + reach, track.observed.size());
  const auto part_of = [&](const auto& values, std::size_t width) {
    const auto at = [&](std::size_t frame) {
      return values.begin() + static_cast<std::ptrdiff_t>(width * frame);
    };
    return std::decay_t<decltype(values)>(at(first), at(end));
  };
  JointTrack part{track.joint, track.is_position,        track.first_frame + first,
                  {},          part_of(track.values, 3), part_of(track.observed, 1)};
  const FrameSpan hidden{span.first - first, span.last - first};
  std::fill_n(part.observed.begin() + static_cast<std::ptrdiff_t>(hidden.first), hidden.length(),
              std::uint8_t{0});
  if (track.is_position) return part;
  part.chart = {part_of(track.chart.reference, 1), part_of(track.chart.path, 1)};
  hide_from_chart(part, hidden, ends, frame_rate_hz);
  return part;
}

void store_span(const JointTrack& track, FrameSpan span, Clip& clip) {
  const std::size_t positions = 1 + clip.translated_joints.size();
  const std::size_t position = track.is_position ? position_index(clip, track.joint) : 0;
  for (std::size_t f = span.first; f <= span.last; ++f) {
    if (!track.is_position) {
      store_rotation(track, f, clip);
      continue;
    }
    position_at(clip, position, f) = track.at(f);
    clip.observed_positions[f * positions + position] = 1;
  }
}

}  // namespace kinemend::fill
