// Motions that leave the floor: jumps on the spot, and a landing from a box.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/portable.hpp"
#include "lab/synthesis/curves.hpp"
#include "lab/synthesis/motions.hpp"

namespace kinemend::synth {

namespace {

// By definition.
constexpr double jump_gravity_cm_s2 = 981;

// One jump from a floor to another, in seconds and centimetres from its start. The pelvis is thrown
// up, falls freely and is caught by the legs; the feet are on the floor whenever the legs are long
// enough.
class Jump {
 public:
  Jump(const Body& body, double rise_cm, double drop_cm, double forward_cm)
      : body_(body),
        drop_(drop_cm),
        forward_(forward_cm),
        reach_at_lift_(root_height(0.985, lift_pitch)),
        reach_at_touch_(root_height(0.955, touch_pitch)),
        flight_(flight_time(rise_cm)),
        touch_(lift + flight_),
        height_(root_keys(rise_cm)) {}

  double end() const { return touch_ + 1.1; }

  void apply(double t, Posture& p) const {
    const double rest = body_.straight_height() - 0.6;
    const double y = height_(t);
    const double travelled = ramp(t, lift - 0.05, touch_ + 0.01);
    const double floor = t < lift + 0.5 * flight_ ? drop_ : 0;
    const double squat = smooth_hinge(rest + floor - y, 3) / body_.height * grounded(t);
    p.root.y = y + (p.root.y - rest);
    p.root.z += forward_ * ramp(t, lift - 0.12, touch_ + 0.12) - 0.25 * squat * body_.height;
    p.spine_flexion += 95 * squat;
    p.tilt_deg += 130 * squat;
    p.neck_flexion -= 90 * squat;
    const double clearance = y - floor - reach(t);
    const double ball = floor + body_.ball_height + smooth_hinge(clearance, 1.2);
    const double pitch = pitch_(t);
    for (FootPlace& foot : p.feet) {
      const Quat sole = about_y(foot.yaw_deg) * about_x(-pitch);
      const Quat flat = about_y(foot.yaw_deg);
      const Vec3 offset{0, body_.ball_height - body_.ankle_height, body_.ball_ahead_of_ankle};
      Vec3 at = foot.ankle + rotate(flat, offset);
      at.y = ball;
      at.z += forward_ * travelled;
      foot.ankle = at - rotate(sole, offset);
      foot.pitch_deg = pitch;
      foot.toe_deg = -pitch * (1 - 0.8 * airborne(t));
    }
    for (ArmAngles& arm : p.arms) {
      arm.flexion += arm_(t);
      arm.elbow += 0.22 * std::fabs(arm_(t));
    }
  }

 private:
  // Shares of the leg's length, and degrees of the foot at take-off and landing. Chosen by hand,
  // not swept.
  static constexpr double dip = 0.55, lift = 0.86;  // deepest, leaves the floor
  static constexpr double lift_pitch = -52, touch_pitch = -24;

  // Returns the root's height with the ball of the foot on the floor and the leg stretched to a
  // share of its length.
  double root_height(double stretch, double pitch_deg) const {
    const double a = -pitch_deg * radians_per_degree;
    return body_.ball_height + (body_.ankle_height - body_.ball_height) * portable::cos(a) +
           body_.ball_ahead_of_ankle * portable::sin(a) + stretch * body_.leg() +
           body_.hip_below_root;
  }
  double reach(double t) const {
    return reach_at_lift_ + ramp(t, lift + 0.1, touch_ - 0.1) * (reach_at_touch_ - reach_at_lift_);
  }
  double airborne(double t) const {
    return ramp(t, lift, lift + 0.08) * ramp(t, touch_, touch_ - 0.1);
  }
  double grounded(double t) const {
    return 1 - ramp(t, lift - 0.05, lift) * ramp(t, touch_ + 0.05, touch_);
  }

  double flight_time(double rise_cm) const {
    const double up = std::sqrt(2 * jump_gravity_cm_s2 * rise_cm);
    const double fall = drop_ + reach_at_lift_ - reach_at_touch_;
    return (up + std::sqrt(up * up + 2 * jump_gravity_cm_s2 * fall)) / jump_gravity_cm_s2;
  }
  KeyCurve root_keys(double rise_cm) const {
    const double rest = body_.straight_height() - 0.6;
    const double up = std::sqrt(2 * jump_gravity_cm_s2 * rise_cm);
    const double down = jump_gravity_cm_s2 * flight_ - up;
    const double depth = 0.16 * body_.height;
    const double give = 0.14 * body_.height + 0.10 * drop_;
    // Uniform braking takes twice the distance over the speed.
    const double braking = 2.1 * (reach_at_touch_ - rest + give) / down;
    return KeyCurve({{0, drop_ + rest, 0, 0},
                     {dip, drop_ + rest - depth, 0, 700},
                     {lift, drop_ + reach_at_lift_, up, -jump_gravity_cm_s2},
                     {touch_, reach_at_touch_, -down, -jump_gravity_cm_s2},
                     {touch_ + braking, rest - give, 0, 600},
                     {touch_ + 1.0, rest, 0, 0}});
  }

  const Body& body_;
  double drop_, forward_;
  double reach_at_lift_, reach_at_touch_;
  double flight_, touch_;
  KeyCurve height_;
  KeyCurve pitch_{{{lift - 0.14, 0, 0, 0},
                   {lift, lift_pitch, -250, 0},
                   {lift + 0.1, lift_pitch - 8, 0, 0},
                   {touch_ - 0.06, touch_pitch, 0, 0},
                   {touch_, touch_pitch, 0, 0},
                   {touch_ + 0.055, 0, 0, 0}}};
  KeyCurve arm_{{{0.05, 0, 0, 0},
                 {dip, -50, 0, 0},
                 {lift + 0.04, 125, 0, 0},
                 {touch_, 60, -200, 0},
                 {touch_ + 0.3, -12, 0, 0},
                 {touch_ + 1.0, 0, 0, 0}}};
};

}  // namespace

Motion jump(const Body& body, Random random) {
  const Motion standing = still(body, random.fork(1));
  std::array<Jump, 3> jumps{Jump(body, random.uniform(24, 30), 0, 0),
                            Jump(body, random.uniform(24, 30), 0, 0),
                            Jump(body, random.uniform(24, 30), 0, 0)};
  return [standing, jumps](double t) {
    // Chosen by hand, not swept.
    constexpr double first_s = 0.3, period_s = 2.8;
    Posture p = standing(t);
    const double n = std::max(0.0, std::floor((t - first_s) / period_s));
    const double local = std::max(0.0, t - first_s - n * period_s);
    jumps[static_cast<std::size_t>(n) % jumps.size()].apply(local, p);
    return p;
  };
}

Motion landing(const Body& body, Random random) {
  const Motion standing = still(body, random.fork(1));
  // The numbers are drawn one by one, because the evaluation order of arguments is unspecified.
  const double forward_cm = random.uniform(50, 65), rise_cm = random.uniform(4, 7);
  const Jump down(body, rise_cm, 40, forward_cm);
  return [standing, down](double t) {
    Posture p = standing(t);
    down.apply(std::max(0.0, t - 0.3), p);
    return p;
  };
}

}  // namespace kinemend::synth
