#include <algorithm>

#include "fill/cycles.hpp"
#include "fill/marker_group.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

constexpr std::size_t most_companions = 12;
constexpr std::size_t least_cycles = 2;

// The marker's track in the frame of reference of the rest of the body, so that a cycle may be
// walked elsewhere and in another direction.
struct BodyTrack {
  std::vector<Placement> placements;   // F
  std::vector<double> values;          // F x 3
  std::vector<std::uint8_t> observed;  // F: the marker and the body

  Track track() { return {values, 3, observed}; }
};

BodyTrack track_in_body(const Samples& samples, const MarkerGap& gap) {
  std::vector<std::size_t> markers;
  for (const Companion& companion : companions_of(samples, gap, helpers_of(samples, gap))) {
    if (markers.size() < most_companions) markers.push_back(companion.marker);
  }
  MarkerGroup body(markers, std::vector<double>(markers.size(), 1.0));
  std::vector<std::size_t> whole;
  for (std::size_t f = 0; f < samples.frames; ++f) {
    if (body.seen_in(samples, f)) whole.push_back(f);
  }
  // The body as a whole: by its shape it is placed alike in every cycle, however the gap's marker
  // moves.
  if (!markers.empty() && !whole.empty()) body.fit_shape(samples, evenly(whole, 128));
  BodyTrack track{std::vector<Placement>(samples.frames), std::vector<double>(3 * samples.frames),
                  std::vector<std::uint8_t>(samples.frames)};
  for (const std::size_t f : whole) {
    if (!markers.empty()) track.placements[f] = body.placement(samples, f);
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    const Vec3 local = track.placements[f].to_local(samples.at(f, gap.marker));
    track.observed[f] = 1;
    track.values[3 * f] = local.x;
    track.values[3 * f + 1] = local.y;
    track.values[3 * f + 2] = local.z;
  }
  return track;
}

}  // namespace

Filling fill_by_cycles(const Samples& samples, const MarkerGap& gap, const MarkerRequest&) {
  constexpr std::string_view name = "cyclic";
  const CurveSettings settings{.frame_rate_hz = samples.frame_rate_hz};
  BodyTrack body = track_in_body(samples, gap);
  const std::vector<Cycle> cycles = find_cycles(body.track(), gap.span, settings);
  if (cycles.size() < least_cycles) {
    return Filling::refused(name, "no two other times of the take show the same movement");
  }
  fill_with_cycles(body.track(), gap.span, cycles, settings);
  Filling filling{{}, std::string(name)};
  for (std::size_t f = gap.span.first; f <= gap.span.last; ++f) {
    const Vec3 local{body.values[3 * f], body.values[3 * f + 1], body.values[3 * f + 2]};
    filling.positions.push_back(body.placements[f].to_world(local));
  }
  return filling;
}

}  // namespace kinemend::fill
