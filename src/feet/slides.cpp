// Judges by travel, path, other feet and the motion of the body whether a slide is an error, and
// measures slides, depths and knee pops for the report.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/portable.hpp"
#include "feet/clean_legs.hpp"
#include "feet/floor.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace feet {

namespace {

// In body heights, and body heights a second. The verdicts of docs/feet.md, chosen by hand, not
// swept.
constexpr double least_travel = 0.018;  // 3 cm: rolling foot and moving skin
constexpr double least_jitter = 0.13;   // length of the path to and fro a second: 22 cm/s
constexpr double small_travel = 0.03;   // 5 cm: shorter slides are not intended
constexpr double most_travel = 0.25;    // longer slides are not an error
constexpr double glide_speed = 0.06;    // speed of a foot that glides with the body

struct Judge {
  const Soles& soles;
  const LegMotion& motion;
  const std::vector<FootContact>& contacts;
  double unit_cm;
  double travel_by_error;  // body heights
  bool jitters = false;    // for the whole take

  std::string length_text(double length) const {
    if (unit_cm > 0) return fmt::format("{:.1f} cm", length * unit_cm);
    return fmt::format("{:.3g} units", length);
  }

  Vec3 moved(std::size_t point, std::size_t first, std::size_t last) const {
    const std::vector<Vec3>& path = soles.points[point].path;
    return level_part(path[last] - path[first], soles.up);
  }

  // Returns the largest distance from the beginning of the contact.
  double travel(const FootContact& c) const {
    double farthest = 0;
    for (std::size_t f = c.first_frame; f <= c.last_frame; ++f)
      farthest = std::max(farthest, norm(moved(Soles::point_of(c), c.first_frame, f)));
    return farthest;
  }

  // Returns the measured path length.
  double path(const FootContact& c) const {
    const std::size_t p = Soles::point_of(c);
    double sum = 0;
    for (std::size_t f = c.first_frame + 1; f <= c.last_frame; ++f)
      sum += norm(level_part(soles.body.at(f, p) - soles.body.at(f - 1, p), soles.up));
    return sum;
  }

  bool is_fast(const FootContact& c) const {
    const double seconds =
        static_cast<double>(c.last_frame - c.first_frame) / soles.body.frame_rate_hz;
    return path(c) > least_jitter * soles.height * seconds;
  }

  // Whether the path length far exceeds the displacement during most stands.
  bool take_jitters() const {
    // The least ratio of path length to displacement. A verdict of docs/feet.md, chosen by hand,
    // not swept.
    constexpr double least_ratio = 1.5;
    std::size_t frames = 0, jittery = 0;
    for (const FootContact& c : contacts) {
      const std::size_t length = c.last_frame - c.first_frame + 1;
      frames += length;
      if (is_fast(c) && path(c) > least_ratio * travel(c)) jittery += length;
    }
    return 2 * jittery > frames;
  }

  bool is_still(const FootContact& c) const {
    return travel(c) < least_travel * soles.height && !(jitters && is_fast(c));
  }

  // Whether most of the displacement occurs while another foot is nearly still.
  bool slides_beside_standing_foot(const FootContact& c, double way) const {
    // The share of the displacement, and the ratio of the other foot's displacement to it. A
    // verdict of docs/feet.md, chosen by hand, not swept.
    constexpr double least_share = 0.5, most_other = 0.25;
    for (const FootContact& other : contacts) {
      if (other.leg == c.leg) continue;
      const std::size_t first = std::max(c.first_frame, other.first_frame);
      const std::size_t last = std::min(c.last_frame, other.last_frame);
      if (last <= first) continue;
      const double own = norm(moved(Soles::point_of(c), first, last));
      const double others = norm(moved(Soles::point_of(other), first, last));
      if (own >= least_share * way && others < most_other * own) return true;
    }
    return false;
  }

  // Whether the body moves along with the foot, and not slowly.
  bool glides(const FootContact& c) const {
    // The ratio of the foot's displacement to the body's, and the cosine between them. Chosen by
    // hand, not swept.
    constexpr double least_share = 0.5, least_cosine = 0.8;
    const Vec3 own = moved(Soles::point_of(c), c.first_frame, c.last_frame);
    const Vec3 body =
        level_part(motion.hips_at(c.last_frame) - motion.hips_at(c.first_frame), soles.up);
    const double seconds =
        static_cast<double>(c.last_frame - c.first_frame) / soles.body.frame_rate_hz;
    return norm(own) > glide_speed * soles.height * seconds &&
           dot(own, body) > least_cosine * norm(own) * norm(body) &&
           norm(own) > least_share * norm(body);
  }

  // Returns why the slide of a contact is not an error; empty if it is one.
  std::string excuse(const FootContact& c) const {
    const double way = travel(c);
    if (way < std::max(small_travel, travel_by_error) * soles.height) return {};
    if (slides_beside_standing_foot(c, way)) {
      return fmt::format("slides {} while the other foot stands: intended", length_text(way));
    }
    if (glides(c)) return fmt::format("slides {} along with the body: intended", length_text(way));
    if (way > (most_travel + travel_by_error) * soles.height)
      return fmt::format("slides {}, farther than an error does", length_text(way));
    return {};
  }

  // Returns why the slide of a stand is not an error; empty if it is one.
  std::string excuse(const std::vector<std::size_t>& stand) const {
    for (const std::size_t i : stand) {
      if (std::string found = excuse(contacts[i]); !found.empty()) return found;
    }
    return {};
  }

  bool is_still(const std::vector<std::size_t>& stand) const {
    return std::all_of(stand.begin(), stand.end(),
                       [&](std::size_t i) { return is_still(contacts[i]); });
  }

  std::string stillness(const std::vector<std::size_t>& stand) const {
    double way = 0;
    for (const std::size_t i : stand) way = std::max(way, travel(contacts[i]));
    return fmt::format("stands still: moves {}", length_text(way));
  }
};

}  // namespace

std::vector<std::vector<std::size_t>> stands_of(const std::vector<FootContact>& contacts) {
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(contacts[a].leg, contacts[a].first_frame, a) <
           std::tie(contacts[b].leg, contacts[b].first_frame, b);
  });
  std::vector<std::vector<std::size_t>> stands;
  std::size_t last = 0;
  for (const std::size_t i : order) {
    const FootContact& contact = contacts[i];
    const bool goes_on = !stands.empty() && contacts[stands.back().front()].leg == contact.leg &&
                         contact.first_frame <= last + 1;
    if (!goes_on) stands.emplace_back();
    last = goes_on ? std::max(last, contact.last_frame) : contact.last_frame;
    stands.back().push_back(i);
  }
  return stands;
}

Verdicts judge(const Soles& soles, const LegMotion& motion,
               const std::vector<FootContact>& contacts, double unit_cm, double travel_by_error) {
  Judge bench{soles, motion, contacts, unit_cm, travel_by_error};
  bench.jitters = bench.take_jitters();
  Verdicts verdicts{std::vector<std::uint8_t>(contacts.size()),
                    std::vector<std::uint8_t>(contacts.size()),
                    std::vector<std::string>(contacts.size()), bench.jitters};
  for (const std::vector<std::size_t>& stand : stands_of(contacts)) {
    std::string reason = bench.excuse(stand);
    const bool still = reason.empty() && bench.is_still(stand);
    if (still) reason = bench.stillness(stand);
    for (const std::size_t i : stand) {
      verdicts.still[i] = still ? 1 : 0;
      verdicts.held[i] = reason.empty() ? 1 : 0;
      verdicts.reasons[i] = reason;
    }
  }
  return verdicts;
}

namespace {

double knee_bend_deg(const LegPose& pose) {
  const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
  return portable::atan2(norm(cross(thigh, shank)), dot(thigh, shank)) * degrees_per_radian;
}

double largest_knee_pop_deg(const LegMotion& motion) {
  double largest = 0;
  for (std::size_t l = 0; l < motion.legs(); ++l) {
    double before = 0, now = 0;
    for (std::size_t f = 0; f < motion.frames; ++f) {
      const double next = knee_bend_deg(motion.pose(f, l));
      if (f >= 2) largest = std::max(largest, std::fabs(next - 2 * now + before));
      before = now;
      now = next;
    }
  }
  return largest;
}

}  // namespace

std::vector<double> level_offsets(const Soles& soles) {
  std::vector<double> offsets(soles.points.size());
  for (std::size_t p = 0; p < offsets.size(); ++p) {
    const std::size_t other = p ^ 1;
    if (soles.has[other] == 0) continue;
    offsets[p] = std::max(0.0, soles.points[p].level - soles.points[other].level);
  }
  return offsets;
}

FeetFigures figures_of(const LegMotion& motion, const std::vector<FootContact>& contacts, Up up,
                       const std::vector<double>& offsets) {
  FeetFigures figures;
  figures.knee_pop_deg = largest_knee_pop_deg(motion);
  std::vector<Vec3> places;
  std::size_t steps = 0;
  for (const FootContact& c : contacts) {
    const auto at = [&](std::size_t frame) {
      return motion.pose(frame, c.leg).sole_at(motion.models[c.leg], c.part);
    };
    const Vec3 start = at(c.first_frame);
    Vec3 before = start, sum = start;
    for (std::size_t f = c.first_frame + 1; f <= c.last_frame; ++f) {
      const Vec3 now = at(f);
      figures.slide += norm(level_part(now - before, up));
      figures.most_slide = std::max(figures.most_slide, norm(level_part(now - start, up)));
      ++steps;
      before = now;
      sum += now;
    }
    const auto count = static_cast<double>(c.last_frame - c.first_frame + 1);
    places.push_back((1 / count) * sum - offsets[Soles::point_of(c)] * up.direction());
  }
  if (steps > 0) figures.slide /= static_cast<double>(steps);
  for (const double depth : depths_below_floor(places, up, close_to_floor * motion.height,
                                               motion.height / usual_height_m))
    figures.sink = std::max(figures.sink, depth);
  return figures;
}

}  // namespace feet

FeetFigures feet_figures(const Take& clip, const std::vector<FootContact>& contacts) {
  const std::size_t first = leading_calibration_frames(clip);
  std::optional<Take> part;
  const Take& motion = frames_from(clip, first, part);
  feet::LegMotion legs = feet::leg_motion(motion, find_legs(clip.skeleton));
  feet::check_contacts(contacts, legs, first);
  const std::optional<feet::Up> up = feet::up_of(legs, std::nullopt);
  if (!up) return {};
  feet::set_heels(motion, *up, legs);
  const std::vector<double> offsets = feet::level_offsets(feet::find_soles(legs, *up, {}));
  std::vector<FootContact> own = contacts;
  feet::shift_contacts(own, first, 0);
  return feet::figures_of(legs, own, *up, offsets);
}

}  // namespace kinemend
