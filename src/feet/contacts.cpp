// Smooths heels and toes as much as their noise requires, finds their contacts with the floor, and
// checks given contacts.
#include "feet/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "base/quantiles.hpp"
#include "feet/clean_legs.hpp"
#include "feet/contact_network.hpp"
#include "kinemend/error.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace feet {

namespace {

ContactThresholds thresholds_of(const ContactSettings& s) {
  return {s.begin_height, s.keep_height, s.begin_speed, s.keep_speed};
}

// Means are taken over 20 to 100 ms on either side (docs/details/feet.md, "Jitter"). Chosen by
// hand, not swept.
constexpr double least_mean_s = usual_reach_s, most_mean_s = 0.1;

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
std::vector<double> paces_of(const BodyPoints& body, Up up) {
  // Chosen by hand, not swept.
  constexpr double walk = 1.2;     // body heights a second: from 2 m/s on people run
  constexpr double reach_s = 0.1;  // on either side, over which the speed is measured
  const std::size_t reach = frames_in(reach_s, body.frame_rate_hz, 0);
  std::vector<double> paces(body.frames, 1);
  for (std::size_t f = 0; f < body.frames; ++f) {
    const std::size_t first = f < reach ? 0 : f - reach;
    const std::size_t last = std::min(f + reach, body.frames - 1);
    if (last == first) continue;
    const Vec3 way = level_part(body.centres[last] - body.centres[first], up);
    const double speed = norm(way) * body.frame_rate_hz / static_cast<double>(last - first);
    paces[f] = std::max(1.0, speed / (walk * body.height));
  }
  return paces;
}

}  // namespace

Soles find_soles(BodyPoints heels_and_toes, Up up, const ContactSettings& settings) {
  Soles soles;
  soles.body = std::move(heels_and_toes);
  soles.up = up;
  soles.height = soles.body.height;
  soles.has.assign(soles.body.points, 1);
  soles.paces = paces_of(soles.body, up);
  soles.points.resize(soles.body.points);
  for_each_index(soles.body.points, [&](std::size_t p) {
    soles.points[p] = quiet_sole_point(soles.body, p, up, settings);
  });
  return soles;
}

Soles find_soles(const LegMotion& motion, Up up, const ContactSettings& settings) {
  Soles soles = find_soles(sole_points(motion), up, settings);
  for (std::size_t p = 0; p < soles.has.size(); ++p)
    soles.has[p] = motion.models[p / 2].has[p % 2] ? 1 : 0;
  return soles;
}

namespace {

std::vector<FrameSpan> spans_of(const std::vector<std::uint8_t>& flags, std::size_t most_between) {
  return runs_where(
      flags.size(), [&](std::size_t f) { return flags[f] != 0; }, most_between);
}

// Returns the height of a foot's lower part.
std::vector<double> lowest_of(const Soles& soles, std::size_t leg) {
  std::vector<double> lowest = soles.points[2 * leg].heights;
  if (soles.has[2 * leg + 1] == 0) return lowest;
  for (std::size_t f = 0; f < lowest.size(); ++f)
    lowest[f] = std::min(lowest[f], soles.points[2 * leg + 1].heights[f]);
  return lowest;
}

class ThresholdFinder {
 public:
  ThresholdFinder(const Soles& soles, const ContactSettings& settings)
      : soles_(soles), settings_(settings) {
    for (std::size_t l = 0; l < soles.legs(); ++l) {
      lowest_.push_back(lowest_of(soles, l));
      const double heel = soles.points[2 * l].level;
      const double toe = soles.has[2 * l + 1] != 0 ? soles.points[2 * l + 1].level : heel;
      floors_.push_back(std::min(heel, toe));
    }
  }

  std::vector<FrameSpan> find(std::size_t point) const {
    const SolePoint& sole = soles_.points[point];
    const std::size_t leg = point / 2;
    const double height = soles_.height;
    std::vector<double> speeds(sole.speeds.size());
    for (std::size_t f = 0; f < speeds.size(); ++f) speeds[f] = sole.speeds[f] / soles_.paces[f];
    std::vector<std::uint8_t> slow(speeds.size());
    bool is_slow = false;
    for (std::size_t f = 0; f < slow.size(); ++f) {
      const double limit = is_slow ? settings_.keep_speed : settings_.begin_speed;
      is_slow = sole.seen[f] != 0 && speeds[f] < limit * height;
      slow[f] = is_slow;
    }
    // Heel and toe of one foot may have different levels.
    const double above = sole.level - floors_[leg];
    const double offset = above < settings_.begin_height * height ? above : 0;
    std::vector<double> levels(slow.size(), sole.level);
    for (const auto& [first, last] : spans_of(slow, 0)) {
      const double level = level_of(leg, first, last) + offset;
      std::fill(levels.begin() + static_cast<std::ptrdiff_t>(first),
                levels.begin() + static_cast<std::ptrdiff_t>(last + 1), level);
    }
    const std::vector<std::uint8_t> down =
        touches(sole, levels, speeds, height, thresholds_of(settings_));
    // Neither a shorter break nor a shorter contact counts.
    const std::size_t least = frames_in(settings_.least_s);
    const auto is_short = [&](const FrameSpan& span) { return span.length() < least; };
    std::vector<FrameSpan> spans = spans_of(down, least - 1);
    std::erase_if(spans, is_short);
    for (FrameSpan& span : spans) span = trimmed(sole, span);
    std::erase_if(spans, is_short);
    return spans;
  }

 private:
  // Returns the frames of a time, at least two.
  std::size_t frames_in(double seconds) const {
    return kinemend::frames_in(seconds, soles_.body.frame_rate_hz, 2);
  }

  // Returns the height of the floor under a foot that is slow in these frames.
  double level_of(std::size_t leg, std::size_t first, std::size_t last) const {
    const auto begin = lowest_[leg].begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = lowest_[leg].begin() + static_cast<std::ptrdiff_t>(last + 1);
    std::vector<double> heights(begin, end);
    const double low = median_of(heights);
    if (low < floors_[leg] + settings_.begin_height * soles_.height)
      return std::min(low, floors_[leg]);
    return is_step(leg, first, last) ? low : floors_[leg];
  }

  // Whether a foot is at rest and carries the body, and therefore stands on a step.
  bool is_step(std::size_t leg, std::size_t first, std::size_t last) const {
    // The least time of a stand, and of the part of it in which the foot is the lowest
    // (docs/details/feet.md, "Level"); the distance is in body heights. Chosen by hand, not swept.
    constexpr double least_s = 0.15, least_lowest_s = 0.1, most_travel = 0.02;
    if (last - first + 1 < frames_in(least_s)) return false;
    std::vector<double> heights;
    std::size_t lowest = 0;
    for (std::size_t f = first; f <= last; ++f) {
      heights.push_back(lowest_[leg][f]);
      const bool is_lowest = std::all_of(lowest_.begin(), lowest_.end(), [&](const auto& other) {
        return lowest_[leg][f] < other[f] + settings_.begin_height * soles_.height;
      });
      lowest += is_lowest ? 1 : 0;
    }
    if (lowest < frames_in(least_lowest_s)) return false;
    const double low = quantile_of(heights, 0.1);
    if (quantile_of(heights, 0.9) - low > settings_.begin_height * soles_.height) return false;
    return std::any_of(soles_.points.begin() + static_cast<std::ptrdiff_t>(2 * leg),
                       soles_.points.begin() + static_cast<std::ptrdiff_t>(2 * leg + 2),
                       [&](const SolePoint& point) {
                         const std::size_t margin = (last - first) / 5;
                         const Vec3 travel = point.path[last - margin] - point.path[first + margin];
                         return norm(travel) < most_travel * soles_.height;
                       });
  }

  // Removes the ends during which the part lands or leaves, because it is faster than its median or
  // at another height.
  FrameSpan trimmed(const SolePoint& sole, FrameSpan span) const {
    // See docs/details/feet.md, "Ends": body heights a second, and body heights (1 cm). Chosen by
    // hand, not swept.
    constexpr double times_median = 2.5, sure_speed = 0.05, sure_height = 0.006;
    std::size_t first = span.first, last = span.last;
    const auto part = [&](const std::vector<double>& values) {
      return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(first),
                                 values.begin() + static_cast<std::ptrdiff_t>(last + 1));
    };
    std::vector<double> speeds = part(sole.speeds), heights = part(sole.heights);
    const double limit = std::max(sure_speed * soles_.height, times_median * median_of(speeds));
    const double level = median_of(heights);
    const auto moves = [&](std::size_t f) {
      return sole.speeds[f] > limit ||
             std::fabs(sole.heights[f] - level) > sure_height * soles_.height;
    };
    while (first < last && moves(first)) ++first;
    while (last > first && moves(last)) --last;
    return {first, last};
  }

  const Soles& soles_;
  const ContactSettings& settings_;
  std::vector<std::vector<double>> lowest_;  // for each leg
  std::vector<double> floors_;               // for each leg, its usual level
};

[[noreturn]] void refuse(const std::string& message) { throw Error(ErrorKind::usage, message); }

}  // namespace

FoundContacts find_contacts(const Soles& soles, const ContactSettings& settings) {
  const ThresholdFinder finder(soles, settings);
  FoundContacts found;
  for (std::size_t p = 0; p < soles.points.size(); ++p) {
    if (soles.has[p] == 0) continue;
    for (const auto& [first, last] : finder.find(p))
      found.contacts.push_back({p / 2, static_cast<FootPart>(p % 2), first, last});
  }
  const auto network = shipped_contact_network(Lookahead::whole);
  if (network == nullptr || soles.body.frame_rate_hz < least_contact_rate_hz) return found;
  FoundContacts likely = likely_contacts(*network, soles, found.contacts, settings);
  found.expected_s = likely.expected_s;
  if (settings.finder == ContactFinder::thresholds) return found;
  // The network has learned from feet with toes only.
  for (const FootContact& contact : found.contacts) {
    if (soles.has[2 * contact.leg + 1] == 0) likely.contacts.push_back(contact);
  }
  sort_contacts(likely.contacts);
  return likely;
}

void check_settings(const ContactSettings& settings) {
  const auto in_order = [](double begin, double keep) {
    return std::isfinite(keep) && begin > 0 && keep >= begin;
  };
  if (!in_order(settings.begin_height, settings.keep_height))
    refuse("contact: begin_height must be above 0 and not above keep_height");
  if (!in_order(settings.begin_speed, settings.keep_speed))
    refuse("contact: begin_speed must be above 0 and not above keep_speed");
  if (!(settings.least_s >= 0 && settings.least_s <= 10))
    refuse(fmt::format("contact: least_s is {:g}, expected 0 to 10", settings.least_s));
}

void check_contacts(const std::vector<FootContact>& contacts, const LegMotion& motion,
                    std::size_t first_frame) {
  for (const FootContact& contact : contacts) {
    if (contact.leg >= motion.legs())
      refuse(fmt::format("contact of leg {}: the skeleton has {}", contact.leg, motion.legs()));
    if (contact.part == FootPart::toe && !motion.models[contact.leg].has[1])
      refuse(fmt::format("contact of the toe of leg {}: that foot has none", contact.leg));
    if (contact.first_frame < first_frame || contact.last_frame < contact.first_frame ||
        contact.last_frame >= first_frame + motion.frames) {
      refuse(fmt::format("contact in frames {} to {}: the motion is frames {} to {}",
                         contact.first_frame + 1, contact.last_frame + 1, first_frame + 1,
                         first_frame + motion.frames));
    }
  }
}

void sort_contacts(std::vector<FootContact>& contacts) {
  std::sort(contacts.begin(), contacts.end(), [](const FootContact& a, const FootContact& b) {
    return std::tie(a.leg, a.part, a.first_frame) < std::tie(b.leg, b.part, b.first_frame);
  });
}

}  // namespace feet

}  // namespace kinemend
