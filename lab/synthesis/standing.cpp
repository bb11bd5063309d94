// Motions on planted feet: standing still, waving, clapping and punching.
#include <array>
#include <cmath>
#include <memory>

#include "base/portable.hpp"
#include "lab/synthesis/curves.hpp"
#include "lab/synthesis/motions.hpp"

namespace kinemend::synth {

namespace {

// A standing person who is never quite still: the pelvis sways above planted feet, and trunk, head
// and arms drift.
class Standing {
 public:
  Standing(const Body& body, Random& random, double width_cm, double stagger_cm, double knee_bend)
      : body_(body),
        height_(body.straight_height() - knee_bend),
        sway_x_(random, 0.5, 0.08, 0.7),
        sway_z_(random, 0.5, 0.08, 0.7),
        breath_(random, 0.35, 0.2, 0.3),
        trunk_(random, 0.7, 0.05, 0.5),
        twist_(random, 0.9, 0.05, 0.4),
        look_(random, 2.5, 0.05, 0.35),
        nod_(random, 1.5, 0.05, 0.4),
        arms_{Wander(random, 1.0, 0.08, 0.7), Wander(random, 1.0, 0.08, 0.7)},
        elbows_{Wander(random, 1.2, 0.08, 0.7), Wander(random, 1.2, 0.08, 0.7)} {
    for (std::size_t side = 0; side < 2; ++side) {
      const double m = side == 0 ? 1 : -1;
      feet_[side].ankle = {m * 0.5 * width_cm, body.ankle_height, m * 0.5 * stagger_cm};
      feet_[side].yaw_deg = m * 8;
    }
  }

  Posture at(double t) const {
    Posture p;
    p.root = {sway_x_(t), height_, -0.01 * body_.height + sway_z_(t)};
    p.obliquity_deg = 0.5 * sway_x_(t);
    p.tilt_deg = 6 + 0.4 * trunk_(0.8 * t);
    p.spine_flexion = -4 + breath_(t) + trunk_(t);
    p.spine_lateral = 0.6 * sway_x_(t) + 0.4 * trunk_(1.1 * t);
    p.spine_twist = twist_(t);
    p.neck_flexion = nod_(t);
    p.neck_twist = look_(t);
    p.feet = feet_;
    for (std::size_t side = 0; side < 2; ++side) {
      p.arms[side].flexion = 2 + arms_[side](t);
      p.arms[side].abduction = 8 + 0.4 * arms_[side](0.9 * t);
      p.arms[side].elbow = 18 + elbows_[side](t);
      p.arms[side].rotation = 8;
    }
    return p;
  }

 private:
  const Body& body_;
  double height_;
  Wander sway_x_, sway_z_, breath_, trunk_, twist_, look_, nod_;
  std::array<Wander, 2> arms_, elbows_;
  std::array<FootPlace, 2> feet_;
};

// The stroke that contains `t`: the time since its start, and its number.
struct Beat {
  double time = 0;
  int number = 0;
};

Beat beat_at(double t, double first, double period) {
  const double n = std::floor((t - first) / period);
  return {t - first - n * period, static_cast<int>(n)};
}

// Returns the left hand with its palm to the right, the fingers forwards and up.
Quat clapping_hand() { return about_x(-32) * Quat{0.5, -0.5, -0.5, -0.5}; }

}  // namespace

ArmAngles waving_arm(const ArmAngles& hanging, double time_s, double weight) {
  ArmAngles up;
  up.flexion = 25;
  up.abduction = 88;
  up.rotation = -82 + 6 * portable::sin(2 * pi * (1.7 * time_s + 0.1));
  up.elbow = 82 + 26 * portable::sin(2 * pi * 1.7 * time_s);
  up.pronation = -10;
  up.wrist_flexion = -5;
  up.wrist_deviation = 12 * portable::sin(2 * pi * (1.7 * time_s - 0.12));
  up.curl = 6;
  up.collar_up = 10;
  return mix(hanging, up, weight);
}

Motion still(const Body& body, Random random) {
  const Standing standing(body, random, 0.115 * body.height, 0, 0.6);
  return [standing](double t) { return standing.at(t); };
}

Motion wave(const Body& body, Random random) {
  const Standing standing(body, random, 0.115 * body.height, 0, 0.6);
  return [standing](double t) {
    Posture p = standing.at(t);
    const Beat beat = beat_at(t, 0.3, 5);
    const double weight = beat.number < 0 ? 0 : ramp(beat.time, 0, 0.7) * ramp(beat.time, 4.4, 3.6);
    p.arms[1] = waving_arm(p.arms[1], t, weight);
    p.spine_lateral -= 3 * weight;
    return p;
  };
}

// The palms close at speed, stop within a few milliseconds, rest on one another, and part.
Motion clap(const Body& body, Random random) {
  const Standing standing(body, random, 0.115 * body.height, 0, 0.6);
  const double open = random.uniform(34, 40), speed = random.uniform(360, 430), cushion = 1.6;
  const double period = random.uniform(0.82, 0.95);
  const double closed = 0.17 + 2 * cushion / speed;
  const KeyCurve gap({{0, open, 0, 0},
                      {0.17, cushion, -speed, 0},
                      {closed, 0, 0, 0},
                      {closed + 0.05, 0, 0, 0},
                      {closed + 0.38, open, 0, 0}});
  return [&body, standing, gap, period](double t) {
    Posture p = standing.at(t);
    const Beat beat = beat_at(t, 0.35, period);
    const double half = 0.5 * (beat.number < 0 ? gap(0) : gap(beat.time));
    const Quat hand = clapping_hand();
    const Vec3 palm{0.6 * body.palm_length, -body.palm_thickness, 0};
    const Vec3 meeting{half, 0.02 * body.height, 0.21 * body.height};
    for (std::size_t side = 0; side < 2; ++side) {
      p.arms[side].curl = 4;
      p.reaches[side] = ArmReach{meeting - rotate(hand, palm), {0.6, -1, -0.4}, hand};
    }
    return p;
  };
}

// Straight punches, left and right in turn, from a guard: the fist is fastest just before the arm
// is straight.
Motion punch(const Body& body, Random random) {
  const Standing standing(body, random, 0.17 * body.height, 0.16 * body.height, 0.04 * body.height);
  const double speed = random.uniform(16, 18), period = random.uniform(0.95, 1.1);
  const double stop = 0.13 + 0.24 / speed;
  const KeyCurve stroke({{0, 0, 0, 0},
                         {0.13, 0.88, speed, 0},
                         {stop, 1, 0, 0},
                         {stop + 0.04, 1, 0, 0},
                         {stop + 0.45, 0, 0, 0}});
  const KeyCurve hips_lead({{-0.06, 0, 0, 0}, {0.18, 1, 0, 0}, {0.24, 1, 0, 0}, {0.72, 0, 0, 0}});
  return [&body, standing, stroke, hips_lead, period](double t) {
    Posture p = standing.at(t);
    const Beat beat = beat_at(t, 0.45, period);
    // The turn of the hips starts slightly before its beat.
    const Beat early = beat_at(t + 0.1, 0.45, period);
    const double h = body.height;
    for (std::size_t side = 0; side < 2; ++side) {
      const auto mine = [side](const Beat& b) {
        return b.number >= 0 && static_cast<std::size_t>(b.number % 2) != side;
      };
      const double out = mine(beat) ? stroke(beat.time) : 0;
      const double lead = mine(early) ? hips_lead(early.time - 0.1) : 0;
      const double turn = side == 0 ? -lead : lead;
      p.rotation_deg += 9 * turn;
      p.spine_twist += 15 * turn;
      p.neck_twist -= 20 * turn;
      const Vec3 guard{0.075 * h, 0.085 * h, 0.115 * h};
      const Vec3 target{0.040 * h, 0.070 * h, 0.322 * h};
      p.arms[side].curl = 75;
      p.arms[side].pronation = 0;
      p.reaches[side] = ArmReach{guard + out * (target - guard), {0.8, -1, -0.2}, std::nullopt};
    }
    p.spine_flexion += 8;
    return p;
  };
}

}  // namespace kinemend::synth
