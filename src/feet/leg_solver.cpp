// Bends the knee, turns the hip and the ankle, and limits joints to their channels.
#include "feet/leg_solver.hpp"

#include <algorithm>
#include <cmath>

#include "base/portable.hpp"
#include "feet/leg_motion.hpp"
#include "motion/rotation.hpp"

namespace kinemend::feet {

namespace {

// Returns the rotation from cosine and sine of its angle.
Quat turn_about(Vec3 axis, double cosine, double sine) {
  double w = 0, share = 0;
  if (cosine >= 0) {
    w = std::sqrt((1 + cosine) / 2);
    share = sine / (2 * w);
  } else {
    share = std::copysign(std::sqrt((1 - cosine) / 2), sine);
    w = sine / (2 * share);
  }
  return {w, share * axis.x, share * axis.y, share * axis.z};
}

// |thigh + R(hinge, angle) shank|^2 = constant + 2 swing cos(angle - straight).
struct KneeCircle {
  Vec3 hinge;  // world, unit; bending is positive
  double constant = 0, swing = 0;
  // The angle of the shank at which the ankle is farthest.
  double straight_cosine = 1, straight_sine = 0;

  double most() const { return std::sqrt(std::max(constant + 2 * swing, 0.0)); }
};

// The rotations that the knee's channels allow.
enum class KneeTurn : std::uint8_t { none, first_axis, last_axis, free };

Vec3 first_axis(const LegPose& pose, const LegModel& model) {
  return rotate(pose.knee_parent * model.knee.rest, unit_vector(model.knee.order.axes[0]));
}
Vec3 last_axis(const LegPose& pose, const LegModel& model) {
  return rotate(pose.knee, unit_vector(model.knee.order.axes[model.knee.order.count - 1]));
}

KneeTurn knee_turn(const LegPose& pose, const LegModel& model) {
  if (model.knee.order.count == 0) return KneeTurn::none;
  if (model.knee.order.count == 1) return KneeTurn::first_axis;
  if (model.knee.order.count == 3) return KneeTurn::free;
  const Vec3 usual = rotate(pose.knee_parent, model.hinge);
  return std::fabs(dot(first_axis(pose, model), usual)) >=
                 std::fabs(dot(last_axis(pose, model), usual))
             ? KneeTurn::first_axis
             : KneeTurn::last_axis;
}

// A knee with a suitable channel turns about its axis. A free one turns in the plane of the leg, or
// of the usual hinge if the leg is straight.
Vec3 hinge_of(const LegPose& pose, const LegModel& model, KneeTurn turn) {
  // From this sine of the bend on the leg's own plane outweighs the usual hinge. Chosen by hand,
  // not swept.
  constexpr double clear_bend = 0.1;
  const Vec3 usual = rotate(pose.knee_parent, model.hinge);
  Vec3 hinge = usual;
  if (turn == KneeTurn::first_axis) hinge = first_axis(pose, model);
  if (turn == KneeTurn::last_axis) hinge = last_axis(pose, model);
  if (turn == KneeTurn::free) {
    const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
    const double lengths = norm(thigh) * norm(shank);
    const Vec3 bend = lengths > 0 ? (1 / lengths) * cross(thigh, shank) : Vec3{};
    // A knee that bends the wrong way turns about the same line.
    const double side = dot(bend, usual) < 0 ? -1 : 1;
    hinge = side * bend + clear_bend * usual;
    if (norm(hinge) > 0) hinge = (1 / norm(hinge)) * hinge;
  }
  return dot(hinge, usual) < 0 ? -hinge : hinge;
}

KneeCircle knee_circle(const LegPose& pose, Vec3 hinge) {
  const Vec3 thigh = pose.knee_at - pose.hip_at, shank = pose.ankle_at - pose.knee_at;
  const double along = dot(thigh, hinge) * dot(shank, hinge);
  const double cosine = dot(thigh, shank) - along, sine = dot(thigh, cross(hinge, shank));
  KneeCircle circle;
  circle.hinge = hinge;
  circle.constant = dot(thigh, thigh) + dot(shank, shank) + 2 * along;
  circle.swing = std::sqrt(cosine * cosine + sine * sine);
  if (!(circle.swing > 0)) return circle;
  circle.straight_cosine = cosine / circle.swing;
  circle.straight_sine = sine / circle.swing;
  return circle;
}

Reach reach_of(const LegPose& pose, const KneeCircle& circle, KneeTurn turn, double soft_reach,
               double hold) {
  Reach reach;
  reach.now = norm(pose.ankle_at - pose.hip_at);
  reach.most = turn == KneeTurn::none ? reach.now : std::max(reach.now, circle.most());
  const double free = std::max((1 - soft_reach) * reach.most, reach.now);
  const double held = std::min(free, (1 - soft_reach / 4) * reach.most);
  reach.easy = hold * held + (1 - hold) * free;
  return reach;
}

// Returns the turn of the shank that puts the ankle at this distance from the hip, on the side to
// which the knee is bent.
Quat turn_for(const KneeCircle& circle, double distance) {
  if (!(circle.swing > 0)) return {};
  const double cosine =
      std::clamp((distance * distance - circle.constant) / (2 * circle.swing), -1.0, 1.0);
  const double side = circle.straight_sine > 0 ? -1 : 1;
  const double sine = side * std::sqrt((1 - cosine) * (1 + cosine));
  return turn_about(circle.hinge, circle.straight_cosine * cosine - circle.straight_sine * sine,
                    circle.straight_sine * cosine + circle.straight_cosine * sine);
}

// The leg after its hip and knee have turned.
class LegSolver {
 public:
  LegSolver(const LegPose& pose, const LegModel& model, const FootTarget& target, Vec3 hip_shift,
            double soft_reach)
      : pose_(pose),
        model_(model),
        target_(target),
        hip_at_(pose.hip_at + hip_shift),
        turn_(knee_turn(pose, model)),
        circle_(knee_circle(pose, hinge_of(pose, model, turn_))),
        reach_(reach_of(pose, circle_, turn_, soft_reach, target.hold)) {}

  LegRotations solve() {
    // Chosen by hand, not swept.
    constexpr int rounds = 8;  // hip and ankle depend on each other where channels are missing
    foot_ = target_.rotation;
    const bool is_limited = model_.hip.order.count < 3 || model_.ankle.order.count < 3;
    for (int round = 0; round < (is_limited ? rounds : 1); ++round) solve_once();
    return rotations_;
  }

 private:
  void solve_once() {
    const Vec3 ankle_at = target_.place - rotate(foot_, target_.pivot);
    const Vec3 way = ankle_at - hip_at_;
    const double far = norm(way);
    const Quat bend =
        turn_ == KneeTurn::none ? Quat{} : turn_for(circle_, soft_distance(far, reach_));
    const Quat knee_frame = pose_.knee_parent * model_.knee.rest;
    rotations_.knee = normalized(conjugate(knee_frame) * bend * pose_.knee);

    const Vec3 bent = pose_.knee_at - pose_.hip_at + rotate(bend, pose_.ankle_at - pose_.knee_at);
    Quat swing = least_turn(bent, way);
    if (twist_ != 0 && far > 0) swing = exp((twist_ / far) * way) * swing;
    const Quat hip_frame = pose_.hip_parent * model_.hip.rest;
    rotations_.hip =
        within_channels(normalized(conjugate(hip_frame) * swing * pose_.hip), model_.hip);
    swing = hip_frame * rotations_.hip * conjugate(pose_.hip);

    const Quat ankle_frame = swing * bend * pose_.ankle_parent * model_.ankle.rest;
    rotations_.ankle =
        within_channels(normalized(conjugate(ankle_frame) * target_.rotation), model_.ankle);
    foot_ = ankle_frame * rotations_.ankle;
    // The hip supplies the turn about the line of the leg that the ankle cannot make.
    if (model_.ankle.order.count < 3 && far > 0)
      twist_ += dot(log(target_.rotation * conjugate(foot_)), way) / far;
  }

  const LegPose& pose_;
  const LegModel& model_;
  const FootTarget& target_;
  Vec3 hip_at_;
  KneeTurn turn_;
  KneeCircle circle_;
  Reach reach_;
  Quat foot_;
  double twist_ = 0;
  LegRotations rotations_;
};

}  // namespace

Quat within_channels(Quat rotation, const LegJoint& joint) {
  if (joint.order.count >= 3) return rotation;
  if (joint.order.count == 0) return Quat{};
  return from_euler(to_euler(rotation, joint.order), joint.order);
}

Vec3 turn_between(Vec3 from, Vec3 to) {
  const Vec3 axis = cross(from, to);
  const double sine = norm(axis), cosine = dot(from, to);
  if (!(sine > 0)) return {};
  return (portable::atan2(sine, cosine) / sine) * axis;
}

Quat least_turn(Vec3 from, Vec3 to) {
  // The share of the product of lengths below which a sum is rounding.
  constexpr double nearly_opposite = 1e-6;
  const double lengths = std::sqrt(dot(from, from) * dot(to, to));
  const double w = lengths + dot(from, to);
  if (!(w > nearly_opposite * lengths)) return exp(turn_between(from, to));
  const Vec3 axis = cross(from, to);
  return normalized({w, axis.x, axis.y, axis.z});
}

Reach reach_of(const LegPose& pose, const LegModel& model, double soft_reach, double hold) {
  const KneeTurn turn = knee_turn(pose, model);
  return reach_of(pose, knee_circle(pose, hinge_of(pose, model, turn)), turn, soft_reach, hold);
}

std::vector<Reach> reaches_of(const LegMotion& motion, const std::vector<FootTarget>& targets,
                              double soft_reach) {
  std::vector<Reach> reaches(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i) {
    reaches[i] =
        reach_of(motion.poses[i], motion.models[i % motion.legs()], soft_reach, targets[i].hold);
  }
  return reaches;
}

double soft_distance(double distance, const Reach& reach) {
  const double room = reach.most - reach.easy;
  if (distance <= reach.easy) return distance;
  if (!(room > 0)) return reach.easy;
  return reach.easy + room * (1 - portable::exp(-(distance - reach.easy) / room));
}

LegRotations solve_leg(const LegPose& pose, const LegModel& model, const FootTarget& target,
                       Vec3 hip_shift, double soft_reach) {
  return LegSolver(pose, model, target, hip_shift, soft_reach).solve();
}

}  // namespace kinemend::feet
