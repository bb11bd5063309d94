// Gives each contact a place, fades the corrections beside it, and computes targets of the feet.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "base/frame_span.hpp"
#include "feet/clean_legs.hpp"
#include "feet/floor.hpp"
#include "feet/leg_solver.hpp"

namespace kinemend::feet {

namespace {

// In body heights. Chosen by hand, not swept.
constexpr double most_sink = 0.006;  // 1 cm: deeper contacts are lifted

class Placement {
 public:
  Placement(const Soles& soles, const LegMotion& motion, const std::vector<FootContact>& contacts,
            const std::vector<std::uint8_t>& held)
      : soles_(soles), motion_(motion), contacts_(contacts), held_(held) {
    places_.resize(contacts.size());
    lift_ = lifts();
    for (const std::vector<std::size_t>& stand : stands_of(contacts)) place_stand(stand);
  }

  Vec3 place(std::size_t contact) const { return places_[contact]; }

 private:
  std::size_t point(std::size_t contact) const { return Soles::point_of(contacts_[contact]); }

  Vec3 mean_place(std::size_t contact) const {
    return feet::mean_place(soles_, contacts_[contact]);
  }

  // Returns how far each contact is lifted so that it does not sink.
  std::vector<double> lifts() const {
    const std::vector<double> offsets = level_offsets(soles_);
    std::vector<Vec3> places;
    for (std::size_t i = 0; i < contacts_.size(); ++i)
      places.push_back(mean_place(i) - offsets[point(i)] * soles_.up.direction());
    std::vector<double> depths = depths_below_floor(
        places, soles_.up, close_to_floor * soles_.height, soles_.height / usual_height_m);
    if (depths.empty()) depths.resize(contacts_.size());
    for (double& depth : depths) {
      if (depth < most_sink * soles_.height) depth = 0;
    }
    return depths;
  }

  // Places the longest contact at its mean and adapts overlapping ones to it.
  void place_stand(std::vector<std::size_t> stand) {
    std::stable_sort(stand.begin(), stand.end(),
                     [&](std::size_t a, std::size_t b) { return length(a) > length(b); });
    for (std::size_t n = 0; n < stand.size(); ++n) {
      const std::size_t i = stand[n];
      if (held_[i] == 0) continue;
      places_[i] = mean_place(i) + lift_[i] * soles_.up.direction();
      const auto longest = std::max_element(
          stand.begin(), stand.begin() + static_cast<std::ptrdiff_t>(n),
          [&](std::size_t a, std::size_t b) { return overlap(a, i) < overlap(b, i); });
      if (n > 0 && overlap(*longest, i) > 0) reconcile(*longest, i);
    }
  }

  std::size_t length(std::size_t i) const {
    return contacts_[i].last_frame - contacts_[i].first_frame + 1;
  }

  std::size_t overlap(std::size_t a, std::size_t b) const {
    if (held_[a] == 0 || held_[b] == 0 || contacts_[a].part == contacts_[b].part) return 0;
    const std::size_t first = std::max(contacts_[a].first_frame, contacts_[b].first_frame);
    const std::size_t last = std::min(contacts_[a].last_frame, contacts_[b].last_frame);
    return last < first ? 0 : last - first + 1;
  }

  // Puts `moved` a foot's length from `fixed`, at its own height if possible.
  void reconcile(std::size_t fixed, std::size_t moved) {
    const LegModel& model = motion_.models[contacts_[moved].leg];
    const double foot = norm(model.sole[1] - model.sole[0]);
    const std::size_t first = std::max(contacts_[fixed].first_frame, contacts_[moved].first_frame);
    const std::size_t last = std::min(contacts_[fixed].last_frame, contacts_[moved].last_frame);
    Vec3 way;
    for (std::size_t f = first; f <= last; ++f)
      way += soles_.body.at(f, point(moved)) - soles_.body.at(f, point(fixed));
    const Vec3 level = level_part(way, soles_.up);
    const double rise = std::clamp(along(places_[moved] - places_[fixed], soles_.up), -foot, foot);
    const double reach = std::sqrt(std::max(foot * foot - rise * rise, 0.0));
    if (!(norm(level) > 0)) return;
    places_[moved] = places_[fixed] + (reach / norm(level)) * level + rise * soles_.up.direction();
  }

  const Soles& soles_;
  const LegMotion& motion_;
  const std::vector<FootContact>& contacts_;
  const std::vector<std::uint8_t>& held_;
  std::vector<Vec3> places_;
  std::vector<double> lift_;
};

// The end of a contact, and its motion there.
struct Edge {
  std::size_t frame = 0;
  Vec3 shift;
  Vec3 slope;  // per frame, forwards in time
};

// Returns the shift and, by a parabola through three frames inside the contact, its slope.
Edge edge_at(const BodyPoints& body, const PartCorrection& part, std::size_t frame,
             const FootContact& contact) {
  // One frame at 120 Hz, over which the slope is taken. Chosen by hand, not swept.
  constexpr double step_s = 0.008, most_speed = 0.5;  // body heights a second: faster is jitter
  const std::size_t wanted = frames_in(step_s, body.frame_rate_hz, 1);
  const std::size_t step = std::min(wanted, (contact.last_frame - contact.first_frame) / 2);
  Edge edge{frame, part.shift[frame], {}};
  if (step == 0) return edge;
  const bool is_first = frame == contact.first_frame;
  const auto path = [&](std::size_t steps) {
    return body.at(is_first ? frame + steps * step : frame - steps * step,
                   Soles::point_of(contact));
  };
  const Vec3 inwards = 4.0 * path(1) - 3.0 * path(0) - path(2);
  edge.slope = ((is_first ? -0.5 : 0.5) / static_cast<double>(step)) * inwards;
  const double speed = norm(edge.slope), most = most_speed * body.height / body.frame_rate_hz;
  if (speed > most) edge.slope = (most / speed) * edge.slope;
  return edge;
}

void fade(const Edge& edge, bool forwards, std::size_t blend, PartCorrection& part) {
  const double direction = forwards ? 1 : -1;
  const auto length = static_cast<double>(blend);
  for (std::size_t k = 1; k < blend; ++k) {
    if (!forwards && edge.frame < k) return;
    const std::size_t f = forwards ? edge.frame + k : edge.frame - k;
    if (f >= part.shift.size()) return;
    const double u = static_cast<double>(k) / length;
    const double keep = 1 - smooth_step(u), lean = u * (1 - u) * (1 - u) * length;
    part.shift[f] = keep * edge.shift + direction * lean * edge.slope;
    part.weight[f] = keep;
  }
}

void bridge(const Edge& from, const Edge& to, std::size_t blend, PartCorrection& part) {
  const auto length = static_cast<double>(to.frame - from.frame);
  const double dip = smooth_step(std::min(1.0, length / 2 / static_cast<double>(blend)));
  for (std::size_t f = from.frame + 1; f < to.frame; ++f) {
    const double u = static_cast<double>(f - from.frame) / length, v = 1 - u;
    const double share = smooth_step(u);
    part.shift[f] = (1 - share) * from.shift + share * to.shift +
                    (u * v * v * length) * from.slope - (u * u * v * length) * to.slope;
    part.weight[f] = 1 - dip * smooth_step(std::min(2 * u, 2 * v));
  }
}

}  // namespace

Vec3 mean_place(const Soles& soles, const FootContact& contact) {
  Vec3 sum;
  for (std::size_t f = contact.first_frame; f <= contact.last_frame; ++f)
    sum += soles.body.at(f, Soles::point_of(contact));
  return (1.0 / static_cast<double>(contact.last_frame - contact.first_frame + 1)) * sum;
}

std::vector<PartCorrection> place_contacts(const Soles& soles, const LegMotion& motion,
                                           const std::vector<FootContact>& contacts,
                                           const std::vector<std::uint8_t>& held, double blend_s) {
  const Placement placement(soles, motion, contacts, held);
  const std::size_t blend = frames_in(blend_s, soles.body.frame_rate_hz, 2);
  std::vector<PartCorrection> parts(soles.points.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    PartCorrection& part = parts[p];
    part.shift.resize(motion.frames);
    part.weight.resize(motion.frames);
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      if (held[i] != 0 && Soles::point_of(contacts[i]) == p) own.push_back(i);
    }
    std::sort(own.begin(), own.end(), [&](std::size_t a, std::size_t b) {
      return std::tie(contacts[a].first_frame, a) < std::tie(contacts[b].first_frame, b);
    });
    for (const std::size_t i : own) {
      for (std::size_t f = contacts[i].first_frame; f <= contacts[i].last_frame; ++f) {
        part.shift[f] = placement.place(i) - soles.body.at(f, p);
        part.weight[f] = 1;
      }
    }
    const auto edge = [&](std::size_t i, bool at_end) {
      const FootContact& c = contacts[i];
      return edge_at(soles.body, part, at_end ? c.last_frame : c.first_frame, c);
    };
    for (std::size_t n = 0; n < own.size(); ++n) {
      const bool is_bridged =
          n > 0 && contacts[own[n]].first_frame - contacts[own[n - 1]].last_frame < 2 * blend;
      if (is_bridged)
        bridge(edge(own[n - 1], true), edge(own[n], false), blend, part);
      else
        fade(edge(own[n], false), false, blend, part);
      const bool goes_on =
          n + 1 < own.size() &&
          contacts[own[n + 1]].first_frame - contacts[own[n]].last_frame < 2 * blend;
      if (!goes_on) fade(edge(own[n], true), true, blend, part);
    }
  }
  return parts;
}

FootTarget foot_target(const LegPose& pose, const LegModel& model, const PartCorrection& heel,
                       const PartCorrection& toe, std::size_t frame, double least_shift) {
  FootTarget target;
  const double h = heel.weight[frame], t = toe.weight[frame];
  target.hold = std::max(h, t);
  target.free_turn = 1 - std::min(h, t);
  target.rotation = pose.ankle;
  const Vec3 heel_shift = heel.shift[frame], toe_shift = toe.shift[frame];
  target.moves = norm(heel_shift) > least_shift || norm(toe_shift) > least_shift;
  // A part in contact is the pivot; between contacts the pivot moves from one to the other. The
  // constant avoids division by zero and is far below rounding.
  constexpr double tiny = 1e-12;
  const double share = (1 - h + tiny) / ((1 - h) + (1 - t) + 2 * tiny);
  target.pivot = (1 - share) * model.sole[0] + share * model.sole[1];
  target.place = pose.ankle_at + rotate(pose.ankle, target.pivot) + (1 - share) * heel_shift +
                 share * toe_shift;
  if (!target.moves || h * t == 0) return target;
  const Vec3 foot = rotate(pose.ankle, model.sole[1] - model.sole[0]);
  const Vec3 wanted = foot + toe_shift - heel_shift;
  const Quat turn =
      h * t == 1 ? least_turn(foot, wanted) : exp((h * t) * turn_between(foot, wanted));
  target.rotation = normalized(turn * pose.ankle);
  return target;
}

}  // namespace kinemend::feet
