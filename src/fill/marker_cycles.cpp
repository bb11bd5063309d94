#include <algorithm>
#include <cmath>

#include "fill/marker_group.hpp"
#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

constexpr double beside_s = 0.25;
constexpr double least_cycle_s = 0.3;
constexpr std::size_t most_cycles = 4;
constexpr std::size_t most_companions = 12;
// Cycles are alike when they differ beside the gap by less than this share of the marker's
// movement.
constexpr double largest_mismatch = 0.35;

// The marker's track in the frame of reference of the rest of the body.
struct BodyTrack {
  std::vector<Placement> placements;
  std::vector<Vec3> local;
  std::vector<std::uint8_t> seen;  ///< the marker and the body
  std::vector<std::uint8_t> placed;
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
  if (!markers.empty() && !whole.empty()) body.fit_shape(samples, evenly(whole, 128));
  BodyTrack track;
  track.placements.resize(samples.frames);
  track.local.resize(samples.frames);
  track.seen.resize(samples.frames);
  track.placed.resize(samples.frames);
  for (const std::size_t f : whole) {
    track.placed[f] = 1;
    track.placements[f] = markers.empty() ? Placement{} : body.placement(samples, f);
    if (!samples.sees(f, gap.marker) || gap.covers(f)) continue;
    track.seen[f] = 1;
    track.local[f] = track.placements[f].to_local(samples.at(f, gap.marker));
  }
  return track;
}

double movement_of(const BodyTrack& track) {
  Vec3 sum;
  double squares = 0, count = 0;
  for (std::size_t f = 0; f < track.local.size(); ++f) {
    if (!track.seen[f]) continue;
    sum += track.local[f];
    squares += dot(track.local[f], track.local[f]);
    count += 1;
  }
  return count > 0 ? std::sqrt(std::max(0.0, squares / count - dot(sum, sum) / count / count)) : 0;
}

struct Cycle {
  std::ptrdiff_t shift = 0;
  double mismatch = 0;
};

// How unlike the frames beside the gap are to those `shift` frames later, an offset aside; negative
// where the marker is not seen there.
double mismatch_of(const BodyTrack& track, const std::vector<std::size_t>& beside, Span span,
                   std::ptrdiff_t shift) {
  const auto moved = [&](std::size_t f) {
    return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(f) + shift);
  };
  if (static_cast<std::ptrdiff_t>(beside.front()) + shift < 0 ||
      moved(beside.back()) >= track.local.size()) {
    return -1;
  }
  for (std::size_t f = span.first; f <= span.last; ++f) {
    if (!track.seen[moved(f)]) return -1;
  }
  Vec3 sum;
  double squares = 0;
  for (const std::size_t f : beside) {
    if (!track.seen[moved(f)]) return -1;
    const Vec3 off = track.local[f] - track.local[moved(f)];
    sum += off;
    squares += dot(off, off);
  }
  const auto count = static_cast<double>(beside.size());
  return std::sqrt(std::max(0.0, squares / count - dot(sum, sum) / count / count));
}

// The shifts at which the mismatch is least among those around them, best first.
std::vector<Cycle> cycles_of(const Samples& samples, const BodyTrack& track,
                             const std::vector<std::size_t>& beside, Span span, double largest) {
  const auto frames = static_cast<std::ptrdiff_t>(samples.frames);
  const auto apart = static_cast<std::ptrdiff_t>(samples.frames_in(least_cycle_s, 2));
  std::vector<Cycle> found;
  for (std::ptrdiff_t shift = -frames; shift <= frames; ++shift) {
    if (std::abs(shift) < apart) continue;
    const double mismatch = mismatch_of(track, beside, span, shift);
    if (mismatch < 0 || mismatch > largest) continue;
    if (!found.empty() && shift - found.back().shift < apart) {
      if (mismatch < found.back().mismatch) found.back() = {shift, mismatch};
    } else {
      found.push_back({shift, mismatch});
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Cycle& a, const Cycle& b) { return a.mismatch < b.mismatch; });
  if (found.size() > most_cycles) found.resize(most_cycles);
  return found;
}

}  // namespace

Filling fill_by_cycles(const Samples& samples, const MarkerGap& gap, const MarkerRequest& request) {
  constexpr std::string_view name = "cyclic";
  const BodyTrack track = track_in_body(samples, gap);
  const std::size_t reach = samples.frames_in(beside_s, 4);
  std::vector<std::size_t> beside = frames_beside(samples, gap, reach, reach);
  std::erase_if(beside, [&](std::size_t f) { return track.seen[f] == 0; });
  if (beside.size() < 4) {
    return Filling::refused(name, "the marker is hardly seen beside the gap");
  }
  const double largest = request.lenient ? std::numeric_limits<double>::infinity()
                                         : largest_mismatch * movement_of(track);
  const std::vector<Cycle> cycles = cycles_of(samples, track, beside, gap.span, largest);
  if (cycles.size() < (request.lenient ? 1U : 2U)) {
    return Filling::refused(name, "no two other times of the take show the same movement");
  }
  const std::size_t first = beside.front() < gap.span.first ? beside.front() : gap.span.first;
  const std::size_t last = std::max(beside.back(), gap.span.last);
  std::vector<Vec3> guess;
  for (std::size_t f = first; f <= last; ++f) {
    Vec3 sum;
    for (const Cycle& cycle : cycles) {
      sum += track.local[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(f) + cycle.shift)];
    }
    guess.push_back(track.placements[f].to_world((1 / static_cast<double>(cycles.size())) * sum));
  }
  return {meet_ends(samples, gap, first, guess), std::string(name), {}, 0, false};
}

}  // namespace kinemend::fill
