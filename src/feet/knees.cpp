#include "feet/knees.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "feet/banded_least_squares.hpp"

namespace kinemend::feet {

namespace {

// What weighs as much as a knee whose angle changes by a radian to and fro at `knee_hz`; slower
// changes of the knee count less by the fourth power of their rate, faster ones more.
constexpr double knee_hz = 4;
constexpr double root_room = 0.02;          // statures, up or down
constexpr double turn_room = 1;             // radians of the foot about what it stands on
constexpr double bend_room = 2;             // radians of the knee of a leg that nothing holds
constexpr double root_hz = 12, leg_hz = 6;  // the rate at which their curvature weighs the same
constexpr double least_room = 1e-6;         // less is none

// The leg as a triangle of thigh, shank and the line from hip to ankle.
struct Triangle {
  double squares = 0, product = 0;  // thigh^2 + shank^2, thigh shank

  double cosine_of(double distance) const {
    return product > 0 ? std::clamp((distance * distance - squares) / (2 * product), -1.0, 1.0) : 1;
  }
  double distance_of(double bend) const {
    return std::sqrt(std::max(0.0, squares + 2 * product * std::cos(bend)));
  }
};

// A leg as its target has it.
struct LegState {
  double bend = 0;              // of the knee, radians
  double by_distance = 0;       // change of the bend, for a unit of length from hip to ankle ...
  double by_root = 0;           // ... and that the root rises
  Vec3 way;                     // from hip to where the ankle shall be
  double far = 0, reached = 0;  // its length, and what the leg makes of it
  Vec3 axis;         // about which a turn of the foot brings the ankle away from the hip ...
  double lever = 0;  // ... by this a radian
};

// How far a leg's angle may change without the root.
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
    constexpr int rounds = 3;
    for (std::size_t f = 0; f < motion_.frames; ++f) {
      if (!is_open(f)) continue;
      first_ = f;
      while (f + 1 < motion_.frames && is_open(f + 1)) ++f;
      count_ = f - first_ + 1;
      measure();
      for (int round = 0; round < rounds; ++round) ease();
    }
  }

 private:
  bool is_open(std::size_t frame) const {
    const auto own = targets_.begin() + static_cast<std::ptrdiff_t>(frame * legs_);
    return drops_[frame] > 0 || std::any_of(own, own + static_cast<std::ptrdiff_t>(legs_),
                                            [](const FootTarget& t) { return t.hold > 0; });
  }

  // Legs in these frames, by frame then leg.
  const LegPose& pose(std::size_t i) const { return motion_.poses[first_ * legs_ + i]; }
  const Reach& reach(std::size_t i) const { return reaches_[first_ * legs_ + i]; }
  FootTarget& target(std::size_t i) const { return targets_[first_ * legs_ + i]; }
  double& drop(std::size_t i) const { return drops_[first_ + i / legs_]; }
  std::size_t root_unknown(std::size_t frame) const { return frame * (legs_ + 1); }
  std::size_t leg_unknown(std::size_t i) const { return i + i / legs_ + 1; }

  void measure() {
    triangles_.resize(count_ * legs_);
    bends_.resize(count_ * legs_);
    for (std::size_t i = 0; i < bends_.size(); ++i) {
      const Vec3 thigh = pose(i).knee_at - pose(i).hip_at;
      const Vec3 shank = pose(i).ankle_at - pose(i).knee_at;
      const double a = dot(thigh, thigh), b = dot(shank, shank);
      triangles_[i] = {a + b, std::sqrt(a * b)};
      bends_[i] = std::acos(triangles_[i].cosine_of(reach(i).now));
    }
  }

  LegState state(std::size_t i) const {
    constexpr double least_sine = 0.12;  // a straight knee turns by degrees for a millimetre
    LegState leg;
    const Vec3 lever = -rotate(target(i).rotation, target(i).pivot);
    leg.way = target(i).place + lever - pose(i).hip_at + drop(i) * up_.direction();
    leg.far = norm(leg.way);
    leg.reached = soft_distance(leg.far, reach(i));
    const Triangle& triangle = triangles_[i];
    const double cosine = triangle.cosine_of(leg.reached);
    leg.bend = std::acos(cosine);
    if (!(leg.far > 0 && triangle.product > 0)) return leg;
    const double sine = std::max(std::sqrt(1 - cosine * cosine), least_sine);
    leg.by_distance = -leg.reached / (triangle.product * sine);
    leg.by_root = -leg.by_distance * along(leg.way, up_) / leg.far;
    const Vec3 moment = (1 / leg.far) * cross(lever, leg.way);
    leg.lever = norm(moment);
    if (leg.lever > 0) leg.axis = (1 / leg.lever) * moment;
    return leg;
  }

  LegRoom room(std::size_t i, const LegState& leg) const {
    LegRoom room;
    room.by_turn =
        target(i).hold * target(i).free_turn * turn_room * std::fabs(leg.by_distance) * leg.lever;
    const double by_bend = (1 - target(i).hold) * bend_room;
    room.in_all = std::sqrt(room.by_turn * room.by_turn + by_bend * by_bend);
    return room;
  }

  // One step: what makes the sum of squares least if all was as linear as it is nearby.
  void ease() {
    states_.resize(count_ * legs_);
    rooms_.resize(count_ * legs_);
    for (std::size_t i = 0; i < states_.size(); ++i) {
      states_[i] = state(i);
      rooms_[i] = room(i, states_[i]);
    }
    BandedLeastSquares squares(count_ * (legs_ + 1), 3 * legs_ + 2);
    add_rooms(squares);
    for (std::size_t f = 0; f < count_ + 2; ++f) add_curvatures(f, squares);
    const std::vector<double> solution = squares.solve();
    for (std::size_t f = 0; f < count_; ++f) {
      const double rise = may_lower_ ? solution[root_unknown(f)] : 0;
      drops_[first_ + f] -= rise;
      for (std::size_t i = f * legs_; i < (f + 1) * legs_; ++i) {
        if (rooms_[i].in_all > least_room)
          apply(i, solution[leg_unknown(i)], states_[i].by_root * rise);
      }
    }
  }

  void add_rooms(BandedLeastSquares& squares) const {
    const auto add = [&](std::size_t unknown, double room) {
      const BandedLeastSquares::Term term{unknown, 1 / std::max(room, least_room)};
      squares.add({&term, 1}, 0, 1);
    };
    for (std::size_t f = 0; f < count_; ++f)
      add(root_unknown(f), may_lower_ ? root_room * motion_.height : 0);
    for (std::size_t i = 0; i < rooms_.size(); ++i) add(leg_unknown(i), rooms_[i].in_all);
  }

  // Second differences over three frames, of which `last` is the last; nothing changes outside.
  void add_curvatures(std::size_t last, BandedLeastSquares& squares) const {
    if (first_ + last < 2 || first_ + last >= motion_.frames) return;
    const std::size_t begin = last < 2 ? 0 : last - 2, end = std::min(last + 1, count_);
    const auto weight = [&](double hz, double room) {
      const double period = motion_.frame_rate_hz / (2 * pi * hz);
      return period * period * period * period / (room * room);
    };
    const auto difference = [&](std::size_t frame) { return frame + 1 == last ? -2.0 : 1.0; };
    using Term = BandedLeastSquares::Term;
    std::array<Term, 3> root, own;
    std::array<Term, 6> both;
    for (std::size_t f = begin; f < end; ++f) root[f - begin] = {root_unknown(f), difference(f)};
    squares.add({root.data(), end - begin}, 0, weight(root_hz, root_room * motion_.height));
    for (std::size_t l = 0; l < legs_; ++l) {
      double value = 0;
      for (std::size_t f = begin; f < end; ++f) {
        const std::size_t i = f * legs_ + l;
        const double times = difference(f);
        value += times * (states_[i].bend - bends_[i]);
        own[f - begin] = {leg_unknown(i), times};
        both[2 * (f - begin)] = {root_unknown(f), times * states_[i].by_root};
        both[2 * (f - begin) + 1] = own[f - begin];
      }
      squares.add({both.data(), 2 * (end - begin)}, value, weight(knee_hz, 1));
      squares.add({own.data(), end - begin}, 0, weight(leg_hz, bend_room));
    }
  }

  // The foot turns for its share, and goes nearer to the hip or farther away for the rest.
  void apply(std::size_t i, double bend, double by_root) const {
    constexpr double most_turn = 0.35;
    FootTarget& foot = target(i);
    const LegState& before = states_[i];
    const double share = rooms_[i].turn_share();
    foot.moves = true;
    if (share > 0) {
      const double turn = share * bend / (before.by_distance * before.lever);
      foot.rotation =
          normalized(exp(std::clamp(turn, -most_turn, most_turn) * before.axis) * foot.rotation);
    }
    if (foot.hold >= 1) return;
    const LegState now = state(i);
    double wanted = now.bend + (1 - share) * bend;
    // What was not linear is made good where nothing holds the foot.
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
  std::size_t first_ = 0, count_ = 0;  // the frames in hand
  std::vector<Triangle> triangles_;
  std::vector<double> bends_;  // in the take, radians
  std::vector<LegState> states_;
  std::vector<LegRoom> rooms_;
};

}  // namespace

void ease_knees(const LegMotion& motion, const std::vector<Reach>& reaches, Up up, bool may_lower,
                std::vector<FootTarget>& targets, std::vector<double>& drops) {
  KneeEasing(motion, reaches, up, may_lower, targets, drops).run();
}

}  // namespace kinemend::feet
