// Distinguishes zeros of missing markers from markers that rest at the origin, by their jumps.
#include "io/table/marker_zeros.hpp"

#include <algorithm>
#include <optional>

#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// See docs/formats/c3d.md and trc.md. Chosen by hand, not swept.
constexpr double steps_of_a_jump = 20;
// The finest resolution of a measurement. Chosen by hand, not swept.
constexpr double finest_resolution_m = 1e-4;
constexpr double metres_of_unknown_unit = 0.001;
// For a marker whose usual step is not known. Chosen by hand, not swept.
constexpr double longest_jump_m = 0.05;

// One marker's path.
class MarkerPath {
 public:
  MarkerPath(const Take& clip, std::size_t marker, const std::vector<std::uint8_t>& is_measured)
      : clip_(clip), marker_(marker), is_measured_(is_measured) {}

  std::size_t frames() const { return clip_.frame_count(); }
  bool is_seen(std::size_t frame) const { return clip_.is_observed(frame, marker_); }
  double distance(std::size_t frame) const { return norm(clip_.position(frame, marker_)); }
  bool is_zero(std::size_t frame) const {
    return is_seen(frame) && clip_.position(frame, marker_) == Vec3{} && !is_measured(frame);
  }
  bool is_elsewhere(std::size_t frame) const { return is_seen(frame) && !is_zero(frame); }

  // Returns the usual step between frames in which the marker is away from the origin; empty if
  // there are none.
  std::optional<double> usual_step() const {
    std::vector<double> steps;
    for (std::size_t f = 1; f < frames(); ++f) {
      if (is_elsewhere(f - 1) && is_elsewhere(f))
        steps.push_back(norm(clip_.position(f, marker_) - clip_.position(f - 1, marker_)));
    }
    if (steps.empty()) return std::nullopt;
    return upper_median_of(steps);
  }

 private:
  bool is_measured(std::size_t frame) const {
    return !is_measured_.empty() && is_measured_[frame * clip_.marker_count() + marker_] != 0;
  }

  const Take& clip_;
  std::size_t marker_;
  const std::vector<std::uint8_t>& is_measured_;
};

// Returns the longest possible step of the marker.
double longest_step(const MarkerPath& path, double resolution, double metre) {
  const std::optional<double> usual = path.usual_step();
  if (!usual) return std::max(longest_jump_m * metre, steps_of_a_jump * resolution);
  return steps_of_a_jump * std::max({*usual, resolution, finest_resolution_m * metre});
}

void find_in_path(const MarkerPath& path, std::size_t marker, double resolution, double metre,
                  std::vector<ZeroGap>& gaps) {
  double jump = -1;
  double before = -1;    // distance of its last position away from the origin; negative: none
  std::size_t next = 0;  // frame in which it is away from the origin again
  for (std::size_t f = 0; f < path.frames(); ++f) {
    if (path.is_elsewhere(f)) before = path.distance(f);
    if (!path.is_zero(f)) continue;
    std::size_t last = f;
    while (last < path.frames() && path.is_zero(last)) ++last;
    next = std::max(next, last);
    while (next < path.frames() && !path.is_elsewhere(next)) ++next;
    const double after = next < path.frames() ? path.distance(next) : -1;
    if (jump < 0) jump = longest_step(path, resolution, metre);
    // A marker that is always at the origin has no jump.
    if (std::max(before, after) > jump) gaps.push_back({marker, f, last});
    f = last - 1;
  }
}

// Returns the markers that are at the origin in every frame; empty for a clip that marks missing
// samples in another way.
std::vector<std::size_t> never_elsewhere(const Take& clip,
                                         const std::vector<std::uint8_t>& is_measured) {
  std::vector<std::size_t> markers;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!clip.holds_positions(m)) continue;
    const MarkerPath path(clip, m, is_measured);
    bool always_zero = true;
    for (std::size_t f = 0; f < path.frames(); ++f) {
      if (!path.is_seen(f)) return {};
      always_zero = always_zero && path.is_zero(f);
    }
    if (always_zero) markers.push_back(m);
  }
  return markers;
}

}  // namespace

std::vector<ZeroGap> find_zero_gaps(const Take& clip, double resolution,
                                    const std::vector<std::uint8_t>& is_measured) {
  std::vector<ZeroGap> gaps;
  // Few takes have zeros.
  if (std::find(clip.positions.begin(), clip.positions.end(), Vec3{}) == clip.positions.end())
    return gaps;
  const double unit_m = metres_per_unit(clip.unit);
  const double metre = 1 / (unit_m > 0 ? unit_m : metres_of_unknown_unit);
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (clip.holds_positions(m)) find_in_path({clip, m, is_measured}, m, resolution, metre, gaps);
  }
  // A single marker may really be at the origin, unless zeros mean missing samples elsewhere in the
  // clip; two markers cannot be in one place.
  const std::vector<std::size_t> still = never_elsewhere(clip, is_measured);
  if (clip.frame_count() < 2 || (still.size() < 2 && gaps.empty())) return gaps;
  for (const std::size_t m : still) gaps.push_back({m, 0, clip.frame_count()});
  return gaps;
}

std::size_t sample_count(const std::vector<ZeroGap>& gaps) {
  std::size_t samples = 0;
  for (const ZeroGap& gap : gaps) samples += gap.last - gap.first;
  return samples;
}

void mark_missing(const std::vector<ZeroGap>& gaps, Take& clip) {
  for (const ZeroGap& gap : gaps) {
    for (std::size_t f = gap.first; f < gap.last; ++f) {
      const std::size_t sample = f * clip.marker_count() + gap.marker;
      clip.observed[sample] = 0;
      if (!clip.residuals.empty()) clip.residuals[sample] = -1;
    }
  }
}

MissingZeros mark_zeros_missing(Take& clip) {
  const std::vector<ZeroGap> gaps = find_zero_gaps(clip);
  mark_missing(gaps, clip);
  MissingZeros found{sample_count(gaps), clip.frame_count()};
  for (const ZeroGap& gap : gaps) found.first_frame = std::min(found.first_frame, gap.first);
  return found;
}

}  // namespace kinemend
