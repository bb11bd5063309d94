#include "representation/body_anchors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "representation/body_trend.hpp"

namespace kinemend::representation {

namespace {

constexpr std::size_t least_anchors = 3;

std::optional<Standing> least_squares(const std::vector<Anchor>& anchors) {
  if (anchors.size() < least_anchors) return std::nullopt;
  Vec3 seen, expected;
  for (const Anchor& anchor : anchors) {
    seen += anchor.seen;
    expected += anchor.expected;
  }
  const double share = 1.0 / static_cast<double>(anchors.size());
  seen = share * seen;
  expected = share * expected;
  double along = 0, across = 0;
  Standing standing;
  for (const Anchor& anchor : anchors) {
    const Vec3 a = anchor.expected - expected, b = anchor.seen - seen;
    along += a.x * b.x + a.z * b.z;
    across += a.z * b.x - a.x * b.z;
    standing.spread += a.x * a.x + a.z * a.z;
  }
  if (!(standing.spread > 0) || (along == 0 && across == 0)) return std::nullopt;
  standing.heading = std::atan2(across, along);
  standing.place = seen - TurnAboutY(standing.heading)(expected);
  standing.place.y = 0;
  return standing;
}

// Anchors that lie far from where the fit expects them.
bool drop_strangers(const Standing& standing, double stature, std::vector<Anchor>& anchors) {
  constexpr double least_share = 0.05, times_median = 4;
  const TurnAboutY turn(standing.heading);
  std::vector<double> distances;
  for (const Anchor& anchor : anchors) {
    Vec3 away = anchor.seen - standing.place - turn(anchor.expected);
    away.y = 0;
    distances.push_back(norm(away));
  }
  std::vector<double> sorted(distances);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double limit = std::max(least_share * stature, times_median * *middle);
  std::vector<Anchor> kept;
  for (std::size_t i = 0; i < anchors.size(); ++i) {
    if (distances[i] <= limit) kept.push_back(anchors[i]);
  }
  const bool any = kept.size() < anchors.size() && kept.size() >= least_anchors;
  if (any) anchors = std::move(kept);
  return any;
}

double quantile(std::vector<double> values, double share) {
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace

TurnAboutY::TurnAboutY(double angle) : cosine_(std::cos(angle)), sine_(std::sin(angle)) {}

std::optional<Standing> fit_standing(std::vector<Anchor> anchors, double stature) {
  auto standing = least_squares(anchors);
  if (standing && drop_strangers(*standing, stature, anchors)) standing = least_squares(anchors);
  return standing;
}

void follow_anchors(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match,
                    double floor, BodyChannels& channels) {
  const std::size_t frames = clip.frame_count();
  std::vector<double> headings(frames), x(frames), z(frames), known(frames);
  std::vector<Anchor> anchors;
  for (std::size_t f = 0; f < frames; ++f) {
    anchors.clear();
    for (std::size_t i = 0; i < layout.part_count(); ++i) {
      const auto marker = static_cast<std::size_t>(match.parts[i]);
      if (layout.anchors[i] == 0 || match.parts[i] < 0 || !clip.is_observed(f, marker)) continue;
      anchors.push_back(
          {upright_position(clip, match.upright, f, marker), match.stature * layout.means[i]});
    }
    const auto standing = fit_standing(anchors, match.stature);
    if (!standing) continue;
    headings[f] = standing->heading;
    x[f] = standing->place.x;
    z[f] = standing->place.z;
    known[f] = standing->spread / (match.stature * match.stature);
  }
  continue_angles(headings, known);
  const double rate = clip.frame_rate_hz;
  channels.headings = smooth_trend(std::move(headings), known, rate, layout.trend_s);
  x = smooth_trend(std::move(x), known, rate, layout.trend_s);
  z = smooth_trend(std::move(z), known, rate, layout.trend_s);
  channels.places.resize(frames);
  for (std::size_t f = 0; f < frames; ++f) channels.places[f] = {x[f], floor, z[f]};
}

double low_level(const MarkerClip& clip, Quat upright, std::span<const std::int32_t> markers) {
  constexpr double smoothing_s = 0.1;
  constexpr double low = 0.2;  // share of the frames in which the lowest marker is lower still
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
    heights = smooth_trend(std::move(heights), seen, clip.frame_rate_hz, smoothing_s);
    for (std::size_t f = 0; f < frames; ++f) {
      if (seen[f] > 0) lowest[f] = std::min(lowest[f], heights[f]);
    }
  }
  std::erase(lowest, infinity);
  return lowest.empty() ? 0 : quantile(std::move(lowest), low);
}

double floor_height(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match) {
  if (!match.feet.empty()) {
    // Where the lowest of the layout's markers are missing, those that are left stand higher.
    double lowest = std::numeric_limits<double>::infinity(), known = lowest;
    for (std::size_t i = 0; i < layout.part_count(); ++i) {
      lowest = std::min(lowest, layout.means[i].y);
      if (std::find(match.feet.begin(), match.feet.end(), match.parts[i]) != match.feet.end())
        known = std::min(known, layout.means[i].y);
    }
    return low_level(clip, match.upright, match.feet) - match.stature * (known - lowest);
  }
  std::vector<double> floors;
  for (std::size_t i = 0; i < layout.part_count(); ++i) {
    if (layout.anchors[i] == 0 || match.parts[i] < 0) continue;
    const auto marker = static_cast<std::size_t>(match.parts[i]);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      if (!clip.is_observed(f, marker)) continue;
      floors.push_back(upright_position(clip, match.upright, f, marker).y -
                       match.stature * layout.means[i].y);
    }
  }
  return floors.empty() ? 0 : quantile(std::move(floors), 0.5);
}

}  // namespace kinemend::representation
