#include "io/c3d_gaps.hpp"

#include <algorithm>

namespace kinemend {

namespace {

constexpr double steps_of_a_jump = 20;

// One marker's path.
class MarkerPath {
 public:
  MarkerPath(const MarkerClip& clip, std::size_t marker) : clip_(clip), marker_(marker) {}

  std::size_t frames() const { return clip_.frame_count(); }
  bool is_seen(std::size_t frame) const { return clip_.is_observed(frame, marker_); }
  double distance(std::size_t frame) const { return norm(clip_.position(frame, marker_)); }
  bool is_zero(std::size_t frame) const { return is_seen(frame) && distance(frame) == 0; }
  bool is_elsewhere(std::size_t frame) const { return is_seen(frame) && distance(frame) > 0; }

  // From frame to frame where it is elsewhere in both; 0 where it never is.
  double usual_step() const {
    std::vector<double> steps;
    for (std::size_t f = 1; f < frames(); ++f) {
      if (is_elsewhere(f - 1) && is_elsewhere(f))
        steps.push_back(norm(clip_.position(f, marker_) - clip_.position(f - 1, marker_)));
    }
    if (steps.empty()) return 0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
  }

 private:
  const MarkerClip& clip_;
  std::size_t marker_;
};

void find_in_path(const MarkerPath& path, std::size_t marker, double resolution,
                  std::vector<C3dZeroGap>& gaps) {
  double jump = -1;
  double before = -1;    // distance where it was last elsewhere; negative where it never was
  std::size_t next = 0;  // where it is elsewhere again
  for (std::size_t f = 0; f < path.frames(); ++f) {
    if (path.is_elsewhere(f)) before = path.distance(f);
    if (!path.is_zero(f)) continue;
    std::size_t last = f;
    while (last < path.frames() && path.is_zero(last)) ++last;
    next = std::max(next, last);
    while (next < path.frames() && !path.is_elsewhere(next)) ++next;
    const double after = next < path.frames() ? path.distance(next) : -1;
    if (jump < 0) jump = steps_of_a_jump * std::max(path.usual_step(), resolution);
    const bool never_elsewhere = before < 0 && after < 0;
    if (never_elsewhere ? path.frames() > 1 : std::max(before, after) > jump)
      gaps.push_back({marker, f, last});
    f = last - 1;
  }
}

}  // namespace

std::vector<C3dZeroGap> find_zero_gaps(const MarkerClip& clip, double resolution) {
  std::vector<C3dZeroGap> gaps;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (!clip.is_position.empty() && clip.is_position[m] == 0) continue;
    find_in_path({clip, m}, m, resolution, gaps);
  }
  return gaps;
}

void apply_zero_gaps(const std::vector<C3dZeroGap>& gaps, MarkerClip& clip) {
  for (const C3dZeroGap& gap : gaps) {
    for (std::size_t f = gap.first; f < gap.last; ++f) {
      const std::size_t sample = f * clip.marker_count() + gap.marker;
      clip.observed[sample] = 0;
      if (!clip.residuals.empty()) clip.residuals[sample] = -1;
    }
  }
}

}  // namespace kinemend
