// Smooths heels and toes as much as their noise requires.
#include "feet/soles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"

namespace kinemend::feet {

namespace {

ContactThresholds thresholds_of(const ContactSettings& s) {
  return {s.begin_height, s.keep_height, s.begin_speed, s.keep_speed};
}

// Means are taken over 20 to 100 ms on either side (docs/feet-details.md, "Jitter"). Chosen by
// hand, not swept.
constexpr double least_mean_s = 0.02, most_mean_s = 0.1;

// Returns the noise of a coordinate in one frame, from third differences, in which motion is small.
double noise_of(const BodyPoints& body, std::size_t point) {
  constexpr double of_third_differences = 4.4721359549995796;  // the root of 1 + 9 + 9 + 1
  std::vector<double> differences;
  for (std::size_t f = 3; f < body.frames; ++f) {
    const Vec3 third = body.at(f, point) - 3.0 * body.at(f - 1, point) +
                       3.0 * body.at(f - 2, point) - body.at(f - 3, point);
    differences.push_back(std::fabs(third.x));
    differences.push_back(std::fabs(third.y));
    differences.push_back(std::fabs(third.z));
  }
  return deviations_per_median * median_of(differences) / of_third_differences;
}

// Returns the reach at which the noise of speeds is well below the threshold of slow.
double least_reach_s(const BodyPoints& body, std::size_t point, double slow) {
  // The share of the threshold that the noise of speeds may have. Chosen by hand, not swept.
  constexpr double share = 0.3;
  const double allowed = share * slow * body.height;
  if (!(allowed > 0)) return least_mean_s;
  const double needed_s = std::sqrt(2.0) * noise_of(body, point) / allowed / 2;
  return std::clamp(needed_s, least_mean_s, most_mean_s);
}

// Returns the speed of the slower frames in which the point is at its standing level.
double standing_speed(const SolePoint& point, double low) {
  // Chosen by hand, not swept.
  constexpr double slower_share = 0.2;  // quantile
  std::vector<double> speeds;
  for (std::size_t f = 0; f < point.heights.size(); ++f) {
    if (point.seen[f] != 0 && point.heights[f] < point.level + low)
      speeds.push_back(point.speeds[f]);
  }
  return quantile_of(speeds, slower_share);
}

// The jitter left by a filter is not white; it shows as feet that are never at rest. Smoothing is
// increased while it slows them. In short stands, as in running, more smoothing would mix them with
// the swing.
SolePoint quiet_sole_point(const BodyPoints& body, std::size_t point, Up up,
                           const ContactSettings& settings) {
  // The share of the threshold at which a foot is well at rest; the growth of the window; and the
  // share by which a wider one must slow standing feet. Chosen by hand, not swept.
  constexpr double quiet = 0.35, times = 1.6, least_gain = 0.15;
  const double low = settings.begin_height * body.height;
  double reach_s = least_reach_s(body, point, settings.begin_speed);
  SolePoint best = sole_point(body, point, up, thresholds_of(settings), reach_s);
  double speed = standing_speed(best, low);
  while (speed > quiet * settings.begin_speed * body.height && reach_s < most_mean_s) {
    reach_s = std::min(times * reach_s, most_mean_s);
    SolePoint next = sole_point(body, point, up, thresholds_of(settings), reach_s);
    const double slower = standing_speed(next, low);
    if (slower > (1 - least_gain) * speed) break;
    best = std::move(next);
    speed = slower;
  }
  return best;
}

// A faster body rolls its feet faster, and its stands are so short that smoothing mixes them with
// the swing.
std::vector<double> paces_of(const LegMotion& motion, Up up) {
  // Chosen by hand, not swept.
  constexpr double walk = 1.2;     // body heights a second: from 2 m/s on people run
  constexpr double reach_s = 0.1;  // on either side, over which the speed is measured
  const auto reach = static_cast<std::size_t>(std::lround(reach_s * motion.frame_rate_hz));
  std::vector<Vec3> hips(motion.frames);
  for (std::size_t i = 0; i < motion.poses.size(); ++i)
    hips[i / motion.legs()] += (1.0 / static_cast<double>(motion.legs())) * motion.poses[i].hip_at;
  std::vector<double> paces(motion.frames, 1);
  for (std::size_t f = 0; f < motion.frames; ++f) {
    const std::size_t first = f < reach ? 0 : f - reach;
    const std::size_t last = std::min(f + reach, motion.frames - 1);
    if (last == first) continue;
    const Vec3 way = level_part(hips[last] - hips[first], up);
    const double speed = norm(way) * motion.frame_rate_hz / static_cast<double>(last - first);
    paces[f] = std::max(1.0, speed / (walk * motion.height));
  }
  return paces;
}

}  // namespace

Soles find_soles(const LegMotion& motion, Up up, const ContactSettings& settings) {
  Soles soles;
  soles.body = sole_points(motion);
  soles.up = up;
  soles.height = motion.height;
  for (std::size_t p = 0; p < soles.body.points; ++p)
    soles.has.push_back(motion.models[p / 2].has[p % 2] ? 1 : 0);
  soles.paces = paces_of(motion, up);
  soles.points.resize(soles.body.points);
  for_each_index(soles.body.points, [&](std::size_t p) {
    soles.points[p] = quiet_sole_point(soles.body, p, up, settings);
  });
  return soles;
}

}  // namespace kinemend::feet
