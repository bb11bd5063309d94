// Places the feet on the path, moves the pelvis above them, and corrects the swing between stances.
#include "lab/synthesis/gait.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/portable.hpp"

namespace kinemend::synth {

namespace {

// Standard gravity, by definition. The toes point out by a usual angle, chosen by hand.
constexpr double gravity_cm_s2 = 981;
constexpr double toe_out_deg = 6;

double fraction(double x) { return x - std::floor(x); }
double side_offset(std::size_t side) { return side == 0 ? 0.0 : 0.5; }
double side_sign(std::size_t side) { return side == 0 ? 1.0 : -1.0; }
double cosine(double cycles) { return portable::cos(2 * pi * cycles); }

Vec3 ball_offset(const Body& b) {
  return {0, b.ball_height - b.ankle_height, b.ball_ahead_of_ankle};
}
Vec3 heel_offset(const Body& b) { return {0, -b.ankle_height, -b.heel_behind_ankle}; }

// Bounds the distance from 0: strides of 3 m are longer than those of any gait here.
double furthest(double strides) { return 300 * (strides + 4); }

}  // namespace

Gait::Gait(const Body& body, const GaitData& data, std::function<double(double)> heading_deg,
           double duration_s, Random random)
    : body_(body),
      data_(data),
      hip_(data.hip),
      knee_(data.knee),
      ankle_(data.ankle),
      stride_s_(data.stride_s * std::sqrt(body.height / 172) * random.uniform(0.97, 1.03)),
      first_strides_(random.uniform()),
      tempo_(random, 0.006, 0.05, 0.3),
      knee_wander_(random, 0.02, 0.05, 0.4),
      trunk_wander_(random, 0.5, 0.1, 0.8),
      twist_wander_(random, 0.6, 0.1, 0.8),
      nod_wander_(random, 1.2, 0.05, 0.5),
      look_wander_(random, 2.0, 0.05, 0.4),
      shoulder_wander_{Wander(random, 0.9, 0.1, 0.9), Wander(random, 0.9, 0.1, 0.9)},
      elbow_wander_{Wander(random, 1.1, 0.1, 1.0), Wander(random, 1.1, 0.1, 1.0)},
      wrist_wander_{Wander(random, 1.5, 0.1, 1.2), Wander(random, 1.5, 0.1, 1.2)},
      path_(std::move(heading_deg), -furthest(0), furthest(duration_s / stride_s_)) {
  fit_pelvis();
  lower_pelvis_into_reach();
  first_stride_ = -3;
  const auto count = static_cast<std::size_t>(duration_s / stride_s_) + 9;
  for (Side& side : sides_) {
    side.footprints.resize(count);
    side.swings.resize(count - 1);
  }
  lay_footprints(random);
}

// Returns the phase at which the fixed place changes from the heel to the ball.
double Gait::mid_stance() const { return 0.5 * (data_.flat_from + data_.flat_to); }

double Gait::strides(double time_s) const {
  return first_strides_ + time_s / stride_s_ + tempo_(time_s) - tempo_(0);
}

double Gait::stride_number(std::size_t index) const {
  return static_cast<double>(first_stride_ + static_cast<std::int64_t>(index));
}

// Returns the pitch of the foot from the joint angles, made flat while the sole is on the ground.
double Gait::foot_pitch(double phase) const {
  const double p = fraction(phase);
  const double pitch = hip_(p) - data_.pelvis_tilt - knee_(p) + ankle_(p);
  const double flat = ramp(p, 0, data_.flat_from) * ramp(p, data_.heel_off_done, data_.flat_to);
  return (1 - flat) * pitch;
}

// The toes stay on the ground while the foot turns about the ball, and straighten in the air.
double Gait::toe_extension(double phase) const {
  const double p = fraction(phase);
  const double lifted = ramp(p, data_.stance + 0.14, data_.stance);
  return ramp(p, 0, data_.flat_from) * lifted * std::max(0.0, -foot_pitch(p));
}

double Gait::distance(double strides) const {
  return pace_.mean() * strides + pace_.periodic_integral(strides);
}

// Lowers the pelvis in a turn, because the outer leg has to reach farther.
double Gait::crouch_in_turn(double distance) const {
  // Chosen by hand, not swept.
  constexpr double deepest_cm = 2.4, radius_cm = 90, half_span_cm = 10;
  const double bend =
      (path_.heading_deg(distance + half_span_cm) - path_.heading_deg(distance - half_span_cm)) *
      radians_per_degree / (2 * half_span_cm) * radius_cm;
  return deepest_cm * bend * bend / (1 + bend * bend);
}

Posture Gait::pelvis_posture(double strides) const {
  Posture p;
  p.tilt_deg = data_.pelvis_tilt + data_.pelvis_tilt_swing * cosine(2 * (strides - 0.42));
  p.obliquity_deg = data_.pelvis_obliquity * cosine(strides - 0.15) +
                    0.15 * data_.pelvis_obliquity * cosine(3 * (strides - 0.08));
  p.rotation_deg = -data_.pelvis_rotation * cosine(strides + 0.02);
  p.heading_deg = path_.heading_deg(distance(strides));
  const double sway = data_.pelvis_sway_cm * cosine(strides - 0.28);
  p.root = path_.position(distance(strides)) + sway * path_.left(distance(strides));
  p.root.y = height_(strides) - drop_ - crouch_in_turn(distance(strides));
  return p;
}

Vec3 Gait::normative_ankle(double strides, std::size_t side, const Posture& pelvis) const {
  const double phase = strides - side_offset(side);
  const Quat thigh =
      pelvis_rotation(pelvis) * about_x(-hip_(phase)) * about_z(-pelvis.obliquity_deg);
  const Quat shank = thigh * about_x(knee_(phase) * (1 + knee_wander_(strides)));
  return hip_position(body_, pelvis, side) + rotate(thigh, {0, -body_.thigh, 0}) +
         rotate(shank, {0, -body_.shank, 0});
}

Vec3 Gait::standing_ankle(const Footprint& print, double phase) const {
  const Quat flat = about_y(print.yaw_deg);
  const Quat sole = flat * about_x(-foot_pitch(phase));
  const Vec3 ball = ball_offset(body_), heel = heel_offset(body_);
  if (phase > mid_stance()) return print.ball - rotate(sole, ball);
  return print.ball + rotate(flat, heel - ball) - rotate(sole, heel);
}

// Fits height and pace of the pelvis so that the standing foot rests, as curves with two like
// steps; between contacts the body falls freely.
void Gait::fit_pelvis() {
  // The samples of a step, and the share of a stride over which slopes are taken. Chosen by hand,
  // not swept.
  constexpr int samples = 240;
  constexpr double step = 1e-4;
  std::vector<StepEquation> height, pace;
  // The resting place on the foot, relative to the pelvis.
  const auto contact = [&](double phase, bool heel) {
    Posture still = pelvis_posture(phase);
    still.heading_deg = 0;
    still.root = {};
    const Quat sole = about_x(-foot_pitch(phase));
    return normative_ankle(phase, 0, still) +
           rotate(sole, heel ? heel_offset(body_) : ball_offset(body_));
  };
  for (int i = 0; i < samples; ++i) {
    const double phase = (i + 0.5) / samples;
    const double weight = ramp(phase, -0.02, 0.12 * data_.stance / 0.6) *
                          ramp(phase, data_.stance + 0.02, 0.8 * data_.stance);
    const bool heel = phase < mid_stance();
    const Vec3 at = contact(phase, heel);
    const Vec3 later = contact(phase + step, heel);
    height.push_back({phase, (heel ? 0 : body_.ball_height) - at.y, weight, false});
    pace.push_back({phase, (at.z - later.z) / step, weight, false});
    // In the air both legs are off the ground.
    const double other = fraction(phase + 0.5);
    const double air = ramp(std::min(phase, other), data_.stance - 0.01, data_.stance + 0.03);
    const double k = 16 * pi * pi;
    height.push_back({phase, -gravity_cm_s2 * stride_s_ * stride_s_, 0.5 * air / (k * k), true});
  }
  height_ = fit_step_curve(height);
  // A flying body keeps its speed, so a runner's speed varies little.
  pace_ = fit_step_curve(pace, data_.stance < 0.5 ? samples : 0);
  ball_ahead_ = contact(mid_stance(), false).z;
}

Gait::Footprint Gait::footprint(std::size_t side, double stride, Random random) const {
  const double at = distance(stride + side_offset(side) + mid_stance()) + ball_ahead_ +
                    0.4 * std::clamp(random.normal(), -2.0, 2.0);
  const double outwards = side_sign(side) * (0.5 * data_.step_width_cm + random.uniform(-0.8, 0.8));
  Footprint print;
  print.ball = path_.position(at) + outwards * path_.left(at);
  print.ball.y = body_.ball_height;
  print.yaw_deg = path_.heading_deg(at - body_.ball_ahead_of_ankle) +
                  side_sign(side) * (toe_out_deg + random.uniform(-1.5, 1.5));
  return print;
}

Gait::Correction Gait::correction(double strides, std::size_t side, std::size_t index) const {
  // The share of a stride over which slopes are taken. Chosen by hand, not swept.
  constexpr double step = 2e-3;
  const double contact = side_offset(side) + stride_number(index);
  const auto value = [&](double at) {
    return standing_ankle(sides_[side].footprints[index], at - contact) -
           normative_ankle(at, side, pelvis_posture(at));
  };
  const Vec3 before = value(strides - step), at = value(strides), after = value(strides + step);
  return {at, (0.5 / step) * (after - before), (1 / (step * step)) * (after - 2 * at + before)};
}

// Blends the corrections at either end, with transients that absorb slope and curvature near the
// ends.
Vec3 Gait::swing_correction(const Swing& swing, double phase) const {
  // The share of a stride in which the transient fades before a contact. Chosen by hand, not swept.
  constexpr double arriving = 0.10;
  const double leaving = 0.27 * data_.stance;
  const double u = ramp(phase, data_.stance, 1);
  const auto transient = [](const Correction& c, double along, double length, double sign) {
    const double s = along / length;
    if (s >= 1) return Vec3{};
    const double fade = (1 - s) * (1 - s) * (1 - s);
    return (sign * length * s * fade * (1 + 3 * s)) * c.slope +
           (0.5 * length * length * s * s * fade) * c.curvature;
  };
  return (1 - u) * swing.from.value + u * swing.to.value +
         transient(swing.from, phase - data_.stance, leaving, 1) +
         transient(swing.to, 1 - phase, arriving, -1);
}

void Gait::lay_footprints(const Random& random) {
  for (std::size_t side = 0; side < 2; ++side) {
    Side& s = sides_[side];
    for (std::size_t i = 0; i < s.footprints.size(); ++i) {
      s.footprints[i] = footprint(side, stride_number(i), random.fork(1000 + 2 * i + side));
    }
    for (std::size_t i = 0; i < s.swings.size(); ++i) {
      const double contact = stride_number(i) + side_offset(side);
      s.swings[i] = {correction(contact + data_.stance, side, i),
                     correction(contact + 1, side, i + 1)};
    }
  }
}

FootPlace Gait::foot(double strides, std::size_t side, const Posture& pelvis) const {
  const double since = strides - side_offset(side);
  const double phase = fraction(since);
  const auto last = static_cast<std::int64_t>(sides_[side].swings.size()) - 1;
  const auto index = static_cast<std::size_t>(std::clamp(
      static_cast<std::int64_t>(std::floor(since)) - first_stride_, std::int64_t{0}, last));
  const Footprint& print = sides_[side].footprints[index];
  FootPlace place;
  place.pitch_deg = foot_pitch(phase);
  place.toe_deg = toe_extension(phase);
  place.yaw_deg = print.yaw_deg;
  if (phase <= data_.stance) {
    place.ankle = standing_ankle(print, phase);
    return place;
  }
  place.ankle =
      normative_ankle(strides, side, pelvis) + swing_correction(sides_[side].swings[index], phase);
  place.ankle.y +=
      data_.clearance_cm * ramp(phase, data_.stance, data_.stance + 0.1) * ramp(phase, 0.93, 0.74);
  const double next = sides_[side].footprints[index + 1].yaw_deg;
  place.yaw_deg += ramp(phase, data_.stance, 1) * (next - print.yaw_deg);
  return place;
}

// An overstretched leg cannot hold its foot, so the pelvis is lowered until both legs always reach
// on a straight path.
void Gait::lower_pelvis_into_reach() {
  Gait straight = *this;
  straight.path_ = Path([](double) { return 0.0; }, -furthest(2), furthest(8));
  straight.first_stride_ = -2;
  for (Side& side : straight.sides_) {
    side.footprints.resize(6);
    side.swings.resize(5);
  }
  for (int round = 0; round < 30; ++round) {
    straight.lay_footprints(Random(0));
    double stretch = 0;
    for (int i = 0; i < 200; ++i) {
      const double strides = i / 200.0;
      Posture p = straight.pelvis_posture(strides);
      for (std::size_t side = 0; side < 2; ++side) {
        p.feet[side] = straight.foot(strides, side, p);
        stretch = std::max(stretch, leg_stretch(body_, p, side));
      }
    }
    if (stretch <= data_.longest_leg) break;
    straight.drop_ += 1.1 * (stretch - data_.longest_leg) * body_.leg();
  }
  drop_ = straight.drop_;
}

Posture Gait::upper_body(double strides, double time_s, Posture p) const {
  const double trunk_turn = data_.trunk_rotation * cosine(strides - 0.03);
  p.spine_twist = trunk_turn - p.rotation_deg + twist_wander_(time_s);
  p.spine_lateral = 0.85 * p.obliquity_deg + 0.5 * trunk_wander_(time_s);
  p.spine_flexion =
      data_.trunk_lean - p.tilt_deg + 0.8 * cosine(2 * (strides - 0.06)) + trunk_wander_(time_s);
  p.neck_twist = -0.85 * trunk_turn + look_wander_(time_s);
  p.neck_lateral = 0.1 * p.obliquity_deg;
  p.neck_flexion =
      -0.6 * data_.trunk_lean + nod_wander_(time_s) - 0.7 * cosine(2 * (strides - 0.06));
  for (std::size_t side = 0; side < 2; ++side) {
    const double phase = strides - side_offset(side);
    ArmAngles& arm = p.arms[side];
    arm.flexion = data_.shoulder_mean - data_.shoulder_swing * cosine(phase - 0.02) +
                  1.5 * cosine(2 * phase) + shoulder_wander_[side](time_s);
    arm.abduction = data_.arm_abduction + 1.5 * cosine(2 * (phase - 0.1)) +
                    0.5 * shoulder_wander_[side](0.7 * time_s);
    arm.rotation = 10 - 4 * cosine(phase - 0.05);
    arm.elbow =
        data_.elbow_mean - data_.elbow_swing * cosine(phase - 0.07) + elbow_wander_[side](time_s);
    arm.pronation = 12 + 3 * cosine(phase - 0.1);
    arm.wrist_flexion = 4 + wrist_wander_[side](time_s) + 3 * cosine(phase - 0.2);
    arm.wrist_deviation = 2 * cosine(phase - 0.12);
  }
  return p;
}

Posture Gait::posture(double time_s) const {
  const double at = strides(time_s);
  Posture p = pelvis_posture(at);
  p.feet[0] = foot(at, 0, p);
  p.feet[1] = foot(at, 1, p);
  return upper_body(at, time_s, p);
}

}  // namespace kinemend::synth
