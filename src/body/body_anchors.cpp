// Fits the shape of a layout to the anchors of each frame and finds heading, place and floor.
#include "body/body_anchors.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "body/body_frame.hpp"
#include "motion/rotation.hpp"

namespace kinemend::representation {

namespace {

// Returns the rotation that turns the expected vectors, about their centre, onto the seen ones.
Quat fitted_rotation(const std::vector<Anchor>& anchors, const RigidFit& fit) {
  rotation::Matrix4 sum{};
  double size = 0;
  for (const Anchor& anchor : anchors) {
    const Vec3 a = anchor.expected - fit.expected_centre, b = anchor.seen - fit.seen_centre;
    const Vec3 c = cross(a, b);
    const std::array<double, 3> av{a.x, a.y, a.z}, bv{b.x, b.y, b.z}, cv{c.x, c.y, c.z};
    const double d = dot(a, b);
    size += norm(a) * norm(b);
    sum[0][0] += d;
    for (std::size_t i = 0; i < 3; ++i) {
      sum[0][i + 1] += cv[i];
      sum[i + 1][0] += cv[i];
      for (std::size_t j = 0; j < 3; ++j)
        sum[i + 1][j + 1] += av[i] * bv[j] + av[j] * bv[i] - (i == j ? d : 0);
    }
  }
  // The eigensolver requires a semidefinite matrix.
  for (std::size_t i = 0; i < 4; ++i) sum[i][i] += size;
  return rotation::leading_eigenvector(sum);
}

std::optional<RigidFit> least_squares(const std::vector<Anchor>& anchors) {
  if (anchors.size() < least_anchors) return std::nullopt;
  RigidFit fit;
  for (const Anchor& anchor : anchors) {
    fit.seen_centre += anchor.seen;
    fit.expected_centre += anchor.expected;
  }
  const double share = 1.0 / static_cast<double>(anchors.size());
  fit.seen_centre = share * fit.seen_centre;
  fit.expected_centre = share * fit.expected_centre;
  for (const Anchor& anchor : anchors) {
    const Vec3 a = anchor.expected - fit.expected_centre;
    fit.spread += dot(a, a);
  }
  if (!(fit.spread > 0)) return std::nullopt;
  fit.rotation = fitted_rotation(anchors, fit);
  return fit;
}

// Removes anchors that lie far from where the fit expects them, and returns whether any was
// removed.
bool drop_strangers(const RigidFit& fit, double body_height, std::vector<Anchor>& anchors) {
  // Anchors farther off than both limits are removed: a share of the body height, and a multiple of
  // the median distance. Chosen by hand, not swept.
  constexpr double least_share = 0.05, times_median = 4;
  std::vector<double> distances;
  distances.reserve(anchors.size());
  for (const Anchor& anchor : anchors)
    distances.push_back(norm(anchor.seen - fit.seen_at(anchor.expected)));
  std::vector<double> sorted(distances);
  const double limit = std::max(least_share * body_height, times_median * median_of(sorted));
  std::vector<Anchor> kept;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    if (distances[i] <= limit) kept.push_back(anchors[i]);
  }
  const bool any = kept.size() < anchors.size() && kept.size() >= least_anchors;
  if (any) anchors = std::move(kept);
  return any;
}

// Returns the shape's point that represents the body: on its vertical axis, at the mean height of
// the anchors.
Vec3 body_centre(const BodyLayout& layout) {
  double height = 0;
  int anchors = 0;
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (layout.anchors[i] == 0) continue;
    height += layout.shape[i].y;
    ++anchors;
  }
  return {0, anchors > 0 ? height / anchors : 0, 0};
}

}  // namespace

TurnAboutY::TurnAboutY(double angle) : cosine_(portable::cos(angle)), sine_(portable::sin(angle)) {}

std::optional<RigidFit> fit_rigidly(std::vector<Anchor> anchors, double body_height) {
  auto fit = least_squares(anchors);
  if (fit && drop_strangers(*fit, body_height, anchors)) fit = least_squares(anchors);
  return fit;
}

std::optional<RigidFit> fit_frame(const Take& clip, const BodyLayout& layout,
                                  const BodyMatch& match, std::size_t frame) {
  std::vector<Anchor> anchors;
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    const auto marker = static_cast<std::size_t>(match.tracks[i]);
    if (layout.anchors[i] == 0 || match.tracks[i] < 0 || !clip.is_observed(frame, marker)) continue;
    anchors.push_back({upright_position(clip, match.upright, frame, marker),
                       match.body_height * layout.shape[i]});
  }
  return fit_rigidly(std::move(anchors), match.body_height);
}

void follow_anchors(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    double floor, BodyChannels& channels) {
  const std::size_t frames = clip.frame_count();
  const Vec3 centre = match.body_height * body_centre(layout);
  std::vector<double> headings(frames), turned(frames), placed(frames);
  std::vector<Vec3> places(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const auto fit = fit_frame(clip, layout, match, f);
    if (!fit) continue;
    const Heading heading = heading_of(fit->rotation);
    headings[f] = heading.angle;
    places[f] = fit->seen_at(centre);
    placed[f] = fit->spread / (match.body_height * match.body_height);
    turned[f] = placed[f] * heading.weight;
  }
  follow(layout, std::move(headings), turned, std::move(places), placed, clip.frame_rate_hz, floor,
         channels);
}

double low_level(const Take& clip, Quat upright, std::span<const std::int32_t> markers) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const std::size_t frames = clip.frame_count();
  std::vector<double> lowest(frames, infinity);
  for (const std::int32_t index : markers) {
    const auto marker = static_cast<std::size_t>(index);
    std::vector<double> heights(frames), seen(frames);
    for (std::size_t f = 0; f < frames; ++f) {
      if (!clip.is_observed(f, marker)) continue;
      heights[f] = upright_position(clip, upright, f, marker).y;
      seen[f] = 1;
    }
    heights = smooth_trend(std::move(heights), seen, clip.frame_rate_hz, floor_mean_s);
    for (std::size_t f = 0; f < frames; ++f) {
      if (seen[f] > 0) lowest[f] = std::min(lowest[f], heights[f]);
    }
  }
  std::erase(lowest, infinity);
  return quantile_of(lowest, floor_quantile);
}

double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match) {
  if (!match.feet.empty()) {
    // If the lowest markers of the layout are missing, the remaining ones lie higher.
    double lowest = std::numeric_limits<double>::infinity(), known = lowest;
    for (std::size_t i = 0; i < layout.track_count(); ++i) {
      lowest = std::min(lowest, layout.means[i].y);
      if (std::find(match.feet.begin(), match.feet.end(), match.tracks[i]) != match.feet.end())
        known = std::min(known, layout.means[i].y);
    }
    return low_level(clip, match.upright, match.feet) - match.body_height * (known - lowest);
  }
  std::vector<double> floors;
  for (std::size_t i = 0; i < layout.track_count(); ++i) {
    if (layout.anchors[i] == 0 || match.tracks[i] < 0) continue;
    const auto marker = static_cast<std::size_t>(match.tracks[i]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, marker)) continue;
      floors.push_back(upright_position(clip, match.upright, f, marker).y -
                       match.body_height * layout.means[i].y);
    }
  }
  return median_of(floors);
}

}  // namespace kinemend::representation
