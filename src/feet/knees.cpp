// Lets the body give way so that held feet reach their places: the least lowering of the root,
// smoothed over time, and knee angles whose curvature Gauss-Newton steps minimise.
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "feet/banded_least_squares.hpp"
#include "feet/clean_legs.hpp"
#include "feet/leg_motion.hpp"

namespace kinemend::feet {

namespace {

// Returns the least lowering that brings the ankle within reach; 0 if lowering does not help.
double drop_for(const LegPose& pose, const Reach& reach, const FootTarget& target, Up up) {
  // The largest lowering as a share of the leg's length, and how upright the leg must be. Chosen by
  // hand, not swept.
  constexpr double most_share = 0.1, least_cosine = 0.5;
  const Vec3 ankle_at = target.place - rotate(target.rotation, target.pivot);
  const Vec3 way = ankle_at - pose.hip_at;
  const double beyond = dot(way, way) - reach.easy * reach.easy;
  const double below = -along(way, up);
  if (beyond <= 0 || below < least_cosine * norm(way)) return 0;
  const double root = std::sqrt(std::max(below * below - beyond, 0.0));
  return std::min(below - root, most_share * reach.most);
}

std::vector<double> running_maximum(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> result(values.size());
  std::deque<std::size_t> candidates;
  std::size_t next = 0;
  for (std::size_t f = 0; f < values.size(); ++f) {
    for (; next < values.size() && next <= f + reach; ++next) {
      while (!candidates.empty() && values[candidates.back()] <= values[next])
        candidates.pop_back();
      candidates.push_back(next);
    }
    while (candidates.front() + reach < f) candidates.pop_front();
    result[f] = values[candidates.front()];
  }
  return result;
}

// Returns a mean with the weights of a raised cosine; the ends are repeated.
std::vector<double> smoothed(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> weights(reach + 1);
  double sum = 0;
  for (std::size_t k = 0; k <= reach; ++k) {
    weights[k] = 1 + portable::cos(pi * static_cast<double>(k) / static_cast<double>(reach + 1));
    sum += k == 0 ? weights[k] : 2 * weights[k];
  }
  const auto last = static_cast<std::ptrdiff_t>(values.size()) - 1;
  std::vector<double> result(values.size());
  for (std::ptrdiff_t f = 0; f <= last; ++f) {
    double total = 0;
    for (std::ptrdiff_t k = -static_cast<std::ptrdiff_t>(reach);
         k <= static_cast<std::ptrdiff_t>(reach); ++k) {
      total += weights[static_cast<std::size_t>(std::abs(k))] *
               values[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(f + k, 0, last))];
    }
    result[static_cast<std::size_t>(f)] = total / sum;
  }
  return result;
}

}  // namespace

std::vector<double> root_drops(const LegMotion& motion, const std::vector<Reach>& reaches,
                               const std::vector<FootTarget>& targets, Up up, double blend_s) {
  std::vector<double> needed(motion.frames);
  bool any = false;
  for (std::size_t f = 0; f < motion.frames; ++f) {
    for (std::size_t l = 0; l < motion.legs(); ++l) {
      const std::size_t i = f * motion.legs() + l;
      if (targets[i].hold < 1 || !targets[i].moves) continue;
      const double drop = drop_for(motion.poses[i], reaches[i], targets[i], up);
      needed[f] = std::max(needed[f], drop);
      any = any || drop > 0;
    }
  }
  if (!any) return needed;
  // The mean of a maximum over its own width is never below the input.
  const std::size_t reach = frames_in(blend_s / 2, motion.frame_rate_hz, 1);
  return smoothed(running_maximum(needed, reach), reach);
}

namespace {

// The changes that cost as much as a knee angle oscillating by a radian at `knee_hz`; the cost of
// knee changes grows with the fourth power of their rate. All of these are chosen by hand, not
// swept.
constexpr double knee_hz = 4;
constexpr double root_room = 0.02;          // body heights, up or down
constexpr double turn_room = 1;             // radians of the foot about its point of contact
constexpr double bend_room = 2;             // radians of the knee of a leg without contact
constexpr double root_hz = 12, leg_hz = 6;  // the rate at which their curvature has the same weight
constexpr double least_room = 1e-6;         // less is ignored

// The leg as a triangle of thigh, shank and the line from hip to ankle.
struct Triangle {
  double squares = 0, product = 0;  // thigh^2 + shank^2, thigh shank

  double cosine_of(double distance) const {
    return product > 0 ? std::clamp((distance * distance - squares) / (2 * product), -1.0, 1.0) : 1;
  }
  double distance_of(double bend) const {
    return std::sqrt(std::max(0.0, squares + 2 * product * portable::cos(bend)));
  }
};

// The distance of a leg's hip from its target for the ankle.
struct Stretch {
  Vec3 way;                     // from the hip
  double far = 0, reached = 0;  // its length, and the length that the leg reaches
  double cosine = 1;            // of the bend of the knee
};

// The derivatives of a knee's bend, in radians, by the free variables.
struct LegState {
  double bend = 0;
  double by_distance = 0;  // for a unit of length from hip to ankle ...
  double by_root = 0;      // ... and for a unit that the root rises
  Vec3 axis;               // about which a turn of the foot moves the ankle away from the hip ...
  double lever = 0;        // ... by this distance a radian
};

// The possible change of a leg's angle without moving the root.
struct LegRoom {
  double by_turn = 0, in_all = 0;  // radians of the knee

  double turn_share() const {
    return in_all > least_room ? by_turn * by_turn / (in_all * in_all) : 0;
  }
};

class KneeEasing {
 public:
  KneeEasing(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
             std::vector<FootTarget>& targets, std::vector<double>& drops)
      : motion_(motion),
        reaches_(reaches),
        up_(up),
        may_lower_(may_lower),
        targets_(targets),
        drops_(drops),
        legs_(motion.legs()) {}

  void run() {
    triangles_.resize(targets_.size());
    bends_.resize(targets_.size());
    changes_.resize(targets_.size());
    states_.resize(targets_.size());
    rooms_.resize(targets_.size());
    for (std::size_t f = 0; f < motion_.frames; ++f) {
      if (!is_open(f)) continue;
      const std::size_t first = f;
      while (f + 1 < motion_.frames && is_open(f + 1)) ++f;
      ease_thoroughly(first, f + 1);
    }
  }

 private:
  bool is_open(std::size_t frame) const {
    const auto own = targets_.begin() + static_cast<std::ptrdiff_t>(frame * legs_);
    return drops_[frame] > 0 || std::any_of(own, own + static_cast<std::ptrdiff_t>(legs_),
                                            [](const FootTarget& t) { return t.hold > 0; });
  }

  // Eases frames from `first` until `end`. After the first step it eases only those near a
  // remaining pop of a knee.
  void ease_thoroughly(std::size_t first, std::size_t end) {
    // Up to two more rounds around remaining pops (docs/details/feet.md, "Knees that do not pop").
    // Not swept.
    constexpr int more_rounds = 2;
    constexpr double around_s = 0.1;
    const auto around = static_cast<std::size_t>(std::ceil(around_s * motion_.frame_rate_hz));
    measure(first, end);
    ease(first, end);
    for (int round = 0; round < more_rounds; ++round) {
      std::size_t done = first;
      for (std::size_t f = first; f < end; ++f) {
        if (!pops(f, first, end)) continue;
        const std::size_t begin = std::max(done, f < around ? 0 : f - around);
        std::size_t last = f;
        while (f + 1 < end && f <= last + 2 * around) {
          ++f;
          if (pops(f, first, end)) last = f;
        }
        done = std::min(last + around + 1, end);
        ease(begin, done);
        f = done - 1;
      }
    }
  }

  // Whether the change of a knee's angle has a kink.
  bool pops(std::size_t frame, std::size_t first, std::size_t end) const {
    // The largest second difference of the change. Chosen by hand, not swept.
    constexpr double most_rad = 0.3 * radians_per_degree;
    const auto change = [&](std::size_t f, std::size_t l) {
      return f < first || f >= end ? 0 : changes_[f * legs_ + l];
    };
    for (std::size_t l = 0; l < legs_; ++l) {
      const double before = frame == 0 ? 0 : change(frame - 1, l);
      if (std::fabs(before - 2 * change(frame, l) + change(frame + 1, l)) > most_rad) return true;
    }
    return false;
  }

  void measure(std::size_t first, std::size_t end) {
    for_blocks(first * legs_, end * legs_, [&](std::size_t from, std::size_t until) {
      for (std::size_t i = from; i < until; ++i) {
        const LegPose& pose = motion_.poses[i];
        const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
        const double a = dot(thigh, thigh), b = dot(shank, shank);
        triangles_[i] = {a + b, std::sqrt(a * b)};
        bends_[i] = portable::acos(triangles_[i].cosine_of(reaches_[i].now));
      }
    });
  }

  Stretch stretch(std::size_t i) const {
    const FootTarget& target = targets_[i];
    Stretch leg;
    leg.way = target.place - rotate(target.rotation, target.pivot) - motion_.poses[i].hip_at +
              drops_[i / legs_] * up_.direction();
    leg.far = norm(leg.way);
    leg.reached = soft_distance(leg.far, reaches_[i]);
    leg.cosine = triangles_[i].cosine_of(leg.reached);
    return leg;
  }

  LegState state(std::size_t i) const {
    // Chosen by hand, not swept.
    constexpr double least_sine = 0.12;  // a straight knee turns by degrees per millimetre
    const Stretch stretch = this->stretch(i);
    LegState leg;
    leg.bend = portable::acos(stretch.cosine);
    const double product = triangles_[i].product;
    if (!(stretch.far > 0 && product > 0)) return leg;
    const double sine = std::sqrt(1 - stretch.cosine * stretch.cosine);
    leg.by_distance = -stretch.reached / (product * std::max(sine, least_sine));
    leg.by_root = -leg.by_distance * along(stretch.way, up_) / stretch.far;
    const FootTarget& target = targets_[i];
    if (target.hold * target.free_turn == 0) return leg;
    const Vec3 lever = -rotate(target.rotation, target.pivot);
    const Vec3 moment = (1 / stretch.far) * cross(lever, stretch.way);
    leg.lever = norm(moment);
    if (leg.lever > 0) leg.axis = (1 / leg.lever) * moment;
    return leg;
  }

  LegRoom room(std::size_t i, const LegState& leg) const {
    const FootTarget& target = targets_[i];
    LegRoom room;
    room.by_turn =
        target.hold * target.free_turn * turn_room * std::fabs(leg.by_distance) * leg.lever;
    const double by_bend = (1 - target.hold) * bend_room;
    room.in_all = std::sqrt(room.by_turn * room.by_turn + by_bend * by_bend);
    return room;
  }

  // The unknowns of frames, counted from the first eased one: a root and its legs.
  std::size_t root_unknown(std::size_t frame) const { return frame * (legs_ + 1); }
  std::size_t leg_unknown(std::size_t frame, std::size_t leg) const {
    return frame * (legs_ + 1) + 1 + leg;
  }

  // Takes one Gauss-Newton step.
  void ease(std::size_t first, std::size_t end) {
    for_blocks(first * legs_, end * legs_, [&](std::size_t from, std::size_t until) {
      for (std::size_t i = from; i < until; ++i) {
        states_[i] = state(i);
        changes_[i] = states_[i].bend - bends_[i];
        rooms_[i] = room(i, states_[i]);
      }
    });
    const std::size_t count = end - first;
    BandedLeastSquares squares(count * (legs_ + 1), 3 * legs_ + 2);
    for (std::size_t f = 0; f < count; ++f) add_rooms(first, f, squares);
    for (std::size_t f = 0; f < count + 2; ++f) add_curvatures(first, count, f, squares);
    const std::vector<double> solution = squares.solve();
    for_blocks(0, count, [&](std::size_t from, std::size_t until) {
      for (std::size_t f = from; f < until; ++f) {
        const double rise = may_lower_ ? solution[root_unknown(f)] : 0;
        drops_[first + f] -= rise;
        for (std::size_t l = 0; l < legs_; ++l) {
          const std::size_t i = (first + f) * legs_ + l;
          if (rooms_[i].in_all > least_room)
            apply(i, solution[leg_unknown(f, l)], states_[i].by_root * rise);
          changes_[i] = portable::acos(stretch(i).cosine) - bends_[i];
        }
      }
    });
  }

  void add_rooms(std::size_t first, std::size_t frame, BandedLeastSquares& squares) const {
    const auto add = [&](std::size_t unknown, double room) {
      squares.add<1>({{{unknown, 1 / std::max(room, least_room)}}}, 0, 1);
    };
    add(root_unknown(frame), may_lower_ ? root_room * motion_.height : 0);
    for (std::size_t l = 0; l < legs_; ++l)
      add(leg_unknown(frame, l), rooms_[(first + frame) * legs_ + l].in_all);
  }

  // Adds second differences over three frames, of which `last` is the last, counted from the first
  // eased one; other frames stay unchanged.
  void add_curvatures(std::size_t first, std::size_t count, std::size_t last,
                      BandedLeastSquares& squares) const {
    using Term = BandedLeastSquares::Term;
    if (first + last < 2 || first + last >= motion_.frames) return;
    std::array<std::size_t, 3> frames{};
    std::array<double, 3> factors{};
    constexpr std::array<double, 3> difference{1, -2, 1};  // of the second order
    for (std::size_t k = 0; k < 3; ++k) {
      if (last + k < 2 || last + k - 2 >= count) continue;
      frames[k] = last + k - 2;
      factors[k] = difference[k];
    }
    std::array<Term, 3> root, own;
    for (std::size_t k = 0; k < 3; ++k) root[k] = {root_unknown(frames[k]), factors[k]};
    squares.add(root, 0, curvature_weight(root_hz, root_room * motion_.height));
    for (std::size_t l = 0; l < legs_; ++l) {
      std::array<Term, 6> knee;
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        value += difference[k] * changes_[(first + last + k - 2) * legs_ + l];
        const double by_root = states_[(first + frames[k]) * legs_ + l].by_root;
        knee[2 * k] = {root_unknown(frames[k]), factors[k] * by_root};
        knee[2 * k + 1] = own[k] = {leg_unknown(frames[k], l), factors[k]};
      }
      squares.add(knee, value, curvature_weight(knee_hz, 1));
      squares.add(own, 0, curvature_weight(leg_hz, bend_room));
    }
  }

  double curvature_weight(double hz, double room) const {
    const double period = motion_.frame_rate_hz / (2 * pi * hz);
    return period * period * period * period / (room * room);
  }

  // The foot turns by its share of the change; its distance from the hip provides the rest.
  void apply(std::size_t i, double bend, double by_root) const {
    // Chosen by hand, not swept.
    constexpr double most_turn = 0.35;  // radians in one step of Gauss and Newton
    FootTarget& foot = targets_[i];
    const LegState& before = states_[i];
    const double share = rooms_[i].turn_share();
    foot.moves = true;
    if (share > 0) {
      const double turn = share * bend / (before.by_distance * before.lever);
      foot.rotation =
          normalized(exp(std::clamp(turn, -most_turn, most_turn) * before.axis) * foot.rotation);
    }
    if (foot.hold >= 1) return;
    const Stretch now = stretch(i);
    double wanted = portable::acos(now.cosine) + (1 - share) * bend;
    // The error of the linearisation is corrected if the foot is free.
    wanted += (1 - foot.hold) * (before.bend + by_root + bend - wanted);
    const double distance = triangles_[i].distance_of(std::max(wanted, 0.0));
    if (now.far > 0) foot.place += ((distance - now.reached) / now.far) * now.way;
  }

  const LegMotion& motion_;
  const std::vector<Reach>& reaches_;
  Up up_;
  bool may_lower_;
  std::vector<FootTarget>& targets_;
  std::vector<double>& drops_;
  std::size_t legs_;
  // All of these are F x L.
  std::vector<Triangle> triangles_;
  std::vector<double> bends_, changes_;  // radians: in the take, and the change from it
  std::vector<LegState> states_;
  std::vector<LegRoom> rooms_;
};

}  // namespace

void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops) {
  KneeEasing(motion, reaches, up, may_lower, targets, drops).run();
}

}  // namespace kinemend::feet
