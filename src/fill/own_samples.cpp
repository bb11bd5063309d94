// The methods that fill a track from its own samples.
#include <fmt/format.h>

#include <algorithm>

#include "fill/cycles.hpp"
#include "fill/marker_group.hpp"
#include "fill/methods.hpp"

namespace kinemend::fill {

namespace {

// Not swept. The number of other cycles that a method needs.
constexpr std::size_t least_cycles_of_joints = 1, least_cycles_of_markers = 2;
constexpr std::size_t most_cycle_companions = 12,
                      most_cycle_shape_frames = 128;  // of a mean shape

}  // namespace

// squad (Shoemake 1987): slerp(slerp(a, b, t), slerp(a', b', t), 2 t (1 - t)). Its inner rotations
// a' = a Exp((L v - d) / 2) and b' = b Exp((d - L w) / 2), with d = Log(a^-1 b), give the curve the
// velocities v and w at its ends, L steps apart.
bool fill_by_squad(Track& track, FrameSpan span, const JointContext& context) {
  const CurveSettings settings = context.curve();
  const EndState before = state_before(track, span, settings);
  const EndState behind = state_behind(track, span, settings);
  if (track.is_position || !before.known || !behind.known) {
    return fill_with_curve(track, span, Curve::hermite, settings);
  }
  const Quat a = track.rotation(span.first - 1);
  const Quat b = align_hemisphere(track.rotation(span.last + 1), a);
  const Vec3 d = log(conjugate(a) * b);
  const auto length = static_cast<double>(span.length() + 1);
  const Quat inner_a = a * exp(0.5 * (length * before.velocity - d));
  const Quat inner_b = b * exp(0.5 * (d - length * behind.velocity));
  for (std::size_t f = span.first; f <= span.last; ++f) {
    const double t = static_cast<double>(f - span.first + 1) / length;
    const Quat q = slerp(slerp(a, b, t), slerp(inner_a, inner_b, t), 2 * t * (1 - t));
    track.values[f] = track.chart.vector_of(f, q);
  }
  return true;
}

std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve) {
  Track track = track_around(samples, gap);
  if (std::find(track.observed.begin(), track.observed.end(), 1) == track.observed.end()) {
    return {};
  }
  const FrameSpan span = within(track, gap.span);
  fill_with_curve(track, span, curve, {.frame_rate_hz = samples.frame_rate_hz});
  return values_in(track, span);
}

Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request,
                      Curve curve, std::string_view name) {
  const double length_s = static_cast<double>(gap.span.length()) / samples.frame_rate_hz;
  const double longest_s = request.longest_gap_s > 0 ? request.longest_gap_s : longest_curve_s;
  if (!request.lenient) {
    if (gap.span.first == 0 || gap.span.last + 1 == samples.frames) {
      return Filling::refused(name, "the gap is at an end of the take");
    }
    if (length_s > longest_s) {
      return Filling::refused(
          name, fmt::format("the gap of {:.2f} s is longer than {:.2f} s", length_s, longest_s));
    }
  }
  Filling filling{curve_positions(samples, gap, curve), std::string(name)};
  filling.is_evidence = false;
  return filling.made() ? filling : Filling::refused(name, "the marker is never seen");
}

bool fill_joint_by_cycles(Track& track, FrameSpan span, const JointContext& context) {
  return fill_by_cycles(track, span, context.curve(), least_cycles_of_joints);
}

// The marker's track is expressed in the frame of reference of the rest of the body, so that a
// cycle may happen elsewhere and in another direction. The whole body is used: its shape is placed
// alike in every cycle, however the gap's marker moves.
Filling fill_marker_by_cycles(const Samples& samples, const MarkerGap& gap, const MarkerRequest&) {
  constexpr std::string_view name = "cyclic";
  std::vector<std::size_t> markers;
  for (const Companion& companion : companions_of(samples, gap, helpers_of(samples, gap))) {
    if (markers.size() < most_cycle_companions) markers.push_back(companion.marker);
  }
  MarkerGroup body(markers, std::vector<double>(markers.size(), 1.0));
  std::vector<std::size_t> whole;
  for (std::size_t f = 0; f < samples.frames; ++f) {
    if (samples.sees(f, markers)) whole.push_back(f);
  }
  if (!markers.empty() && !whole.empty())
    body.fit_shape(samples, evenly(whole, most_cycle_shape_frames));
  std::vector<Placement> placements(samples.frames);
  Track track{std::vector<Vec3>(samples.frames), std::vector<std::uint8_t>(samples.frames)};
  for (const std::size_t f : whole) {
    if (!markers.empty()) placements[f] = body.placement(samples, f);
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    track.observed[f] = 1;
    track.values[f] = placements[f].to_local(samples.at(f, gap.marker));
  }
  if (!fill_by_cycles(track, gap.span, {.frame_rate_hz = samples.frame_rate_hz},
                      least_cycles_of_markers)) {
    return Filling::refused(name, "no two other times of the take show the same movement");
  }
  Filling filling{values_in(track, gap.span), std::string(name)};
  for (std::size_t i = 0; i < filling.values.size(); ++i)
    filling.values[i] = placements[gap.span.first + i].to_world(filling.values[i]);
  return filling;
}

}  // namespace kinemend::fill
