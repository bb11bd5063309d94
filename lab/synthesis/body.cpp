// Builds the humanoid from shares of its height, and bends its limbs to the places of wrists and
// ankles.
#include "lab/synthesis/body.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/portable.hpp"

namespace kinemend::synth {

namespace {

constexpr std::size_t leg_joints = 4, arm_joints = 8;

Quat mirrored(Quat q) { return {q.w, q.x, -q.y, -q.z}; }
Vec3 mirrored(Vec3 v) { return {-v.x, v.y, v.z}; }
// Returns a share of body height, rounded to tenths of a millimetre.
double share(double part, double height) { return std::round(100 * part * height) / 100; }

Vec3 direction(Vec3 v) { return (1 / norm(v)) * v; }

// Returns the rotation that takes the axes x, y, z to these three (orthonormal, right-handed).
Quat from_axes(Vec3 x, Vec3 y, Vec3 z) {
  const double trace = x.x + y.y + z.z;
  if (trace > 0) {
    const double s = 2 * std::sqrt(trace + 1);
    return normalized({s / 4, (y.z - z.y) / s, (z.x - x.z) / s, (x.y - y.x) / s});
  }
  if (x.x > y.y && x.x > z.z) {
    const double s = 2 * std::sqrt(1 + x.x - y.y - z.z);
    return normalized({(y.z - z.y) / s, s / 4, (y.x + x.y) / s, (z.x + x.z) / s});
  }
  if (y.y > z.z) {
    const double s = 2 * std::sqrt(1 + y.y - x.x - z.z);
    return normalized({(z.x - x.z) / s, (y.x + x.y) / s, s / 4, (z.y + y.z) / s});
  }
  const double s = 2 * std::sqrt(1 + z.z - x.x - y.y);
  return normalized({(x.y - y.x) / s, (z.x + x.z) / s, (z.y + y.z) / s, s / 4});
}

// Two bones from the origin to `target`, with the middle joint turned towards `pole`.
struct TwoBones {
  Vec3 first, second;  // directions
  Vec3 hinge;          // turning about it by `bend` takes the first direction to the second
  double bend;         // radians
};

TwoBones reach(Vec3 target, double first_length, double second_length, Vec3 pole) {
  const double longest = 0.999999 * (first_length + second_length);
  const double shortest = 1.000001 * std::fabs(first_length - second_length);
  const double distance = std::clamp(norm(target), shortest, longest);
  const Vec3 along = direction(target);
  const Vec3 side = direction(pole - dot(pole, along) * along);
  const double c =
      (first_length * first_length + distance * distance - second_length * second_length) /
      (2 * first_length * distance);
  const double s = std::sqrt(std::max(0.0, 1 - c * c));
  TwoBones bones;
  bones.first = c * along + s * side;
  bones.second = direction(distance * along - first_length * bones.first);
  bones.hinge = cross(side, along);
  bones.bend = portable::atan2(dot(cross(bones.first, bones.second), bones.hinge),
                               dot(bones.first, bones.second));
  return bones;
}

void add_side(Skeleton& s, const Body& b, bool left, const std::vector<Channel>& turn) {
  const double h = b.height;
  const double m = left ? 1 : -1;
  const std::string side = left ? "Left" : "Right";
  const auto chest = s.find("Spine2");
  const Vec3 collar = left ? b.shoulder_offset : mirrored(b.shoulder_offset);
  const Vec3 arm = left ? b.arm_offset : mirrored(b.arm_offset);
  const auto shoulder = s.add_joint(side + "Shoulder", chest, collar, turn);
  const auto upper = s.add_joint(side + "Arm", shoulder, arm, turn);
  const auto fore = s.add_joint(side + "ForeArm", upper, {m * b.upper_arm, 0, 0}, turn);
  const auto hand = s.add_joint(side + "Hand", fore, {m * b.fore_arm, 0, 0}, turn);
  const auto index1 = s.add_joint(side + "HandIndex1", hand, {m * b.palm_length, 0, m * 0}, turn);
  const auto index2 = s.add_joint(side + "HandIndex2", index1, {m * share(0.026, h), 0, 0}, turn);
  s.end_sites.push_back({index2, {m * share(0.025, h), 0, 0}, ""});
  const auto thumb1 = s.add_joint(side + "HandThumb1", hand,
                                  {m * share(0.016, h), -share(0.004, h), share(0.014, h)}, turn);
  const auto thumb2 =
      s.add_joint(side + "HandThumb2", thumb1, {m * share(0.018, h), 0, share(0.014, h)}, turn);
  s.end_sites.push_back({thumb2, {m * share(0.014, h), 0, share(0.008, h)}, ""});
}

void add_leg(Skeleton& s, const Body& b, bool left, const std::vector<Channel>& turn) {
  const double m = left ? 1 : -1;
  const std::string side = left ? "Left" : "Right";
  const auto up =
      s.add_joint(side + "UpLeg", 0, {m * b.hip_half_width, -b.hip_below_root, 0}, turn);
  const auto leg = s.add_joint(side + "Leg", up, {0, -b.thigh, 0}, turn);
  const auto foot = s.add_joint(side + "Foot", leg, {0, -b.shank, 0}, turn);
  const auto toe = s.add_joint(side + "ToeBase", foot,
                               {0, b.ball_height - b.ankle_height, b.ball_ahead_of_ankle}, turn);
  s.end_sites.push_back({toe, {0, -share(0.008, b.height), share(0.037, b.height)}, ""});
}

Quat arm_rotation(const ArmAngles& a) {
  return about_x(-a.flexion) * about_z(a.abduction - 90) * about_x(a.rotation);
}

// Returns the eight rotations of a left arm; `target` is in the frame of the upper spine joint.
std::array<Quat, arm_joints> left_arm_rotations(const Body& body, const ArmAngles& a,
                                                const std::optional<ArmReach>& target) {
  std::array<Quat, arm_joints> q;
  q[0] = about_z(a.collar_up);
  q[1] = arm_rotation(a);
  double elbow = a.elbow;
  if (target) {
    const Vec3 shoulder = body.shoulder_offset + rotate(q[0], body.arm_offset);
    const TwoBones bones =
        reach(target->wrist - shoulder, body.upper_arm, body.fore_arm, target->elbow_towards);
    const Vec3 y = -bones.hinge;
    q[1] = conjugate(q[0]) * from_axes(bones.first, y, cross(bones.first, y));
    elbow = bones.bend * degrees_per_radian;
  }
  q[2] = about_y(-elbow) * about_x(a.pronation);
  q[3] = about_z(-a.wrist_flexion) * about_y(a.wrist_deviation);
  if (target && target->hand) q[3] = conjugate(q[0] * q[1] * q[2]) * *target->hand;
  q[4] = q[5] = about_z(-a.curl);
  q[6] = about_z(-0.5 * a.curl) * about_x(25);
  q[7] = about_y(0.4 * a.curl);
  return q;
}

void place_leg(const Body& body, const Posture& posture, std::size_t side, BodyPose& pose) {
  const FootPlace& foot = posture.feet[side];
  const double facing =
      0.5 * (posture.heading_deg + posture.rotation_deg + foot.yaw_deg) * radians_per_degree;
  const TwoBones bones = reach(foot.ankle - hip_position(body, posture, side), body.thigh,
                               body.shank, {portable::sin(facing), 0, portable::cos(facing)});
  const Vec3 x = bones.hinge;
  const Quat thigh = from_axes(x, -bones.first, cross(x, -bones.first));
  const Quat shank = from_axes(x, -bones.second, cross(x, -bones.second));
  const Quat sole = about_y(foot.yaw_deg) * about_x(-foot.pitch_deg);
  const std::size_t first = left_up_leg + side * leg_joints;
  pose.rotations[first] = conjugate(pose.rotations[hips]) * thigh;
  pose.rotations[first + 1] = conjugate(thigh) * shank;
  pose.rotations[first + 2] = conjugate(shank) * sole;
  pose.rotations[first + 3] = about_x(-foot.toe_deg);
}

Quat bend(double flexion, double lateral, double twist, double share) {
  return about_y(share * twist) * about_z(-share * lateral) * about_x(share * flexion);
}

}  // namespace

// Segment lengths as shares of body height follow Drillis and Contini (1966), as given by Winter,
// Biomechanics and Motor Control of Human Movement, figure 4.1; the split of trunk and hand into
// joints follows common BVH skeletons.
Body::Body(double height_cm)
    : height(height_cm),
      thigh(share(0.245, height_cm)),
      shank(share(0.246, height_cm)),
      ankle_height(share(0.039, height_cm)),
      ball_height(share(0.012, height_cm)),
      heel_behind_ankle(share(0.035, height_cm)),
      ball_ahead_of_ankle(share(0.080, height_cm)),
      hip_half_width(share(0.050, height_cm)),
      hip_below_root(share(0.020, height_cm)),
      upper_arm(share(0.186, height_cm)),
      fore_arm(share(0.146, height_cm)),
      palm_length(share(0.056, height_cm)),
      palm_thickness(share(0.010, height_cm)),
      shoulder_offset{share(0.015, height_cm), share(0.083, height_cm), share(0.004, height_cm)},
      arm_offset{share(0.090, height_cm), 0, 0} {
  const double h = height_cm;
  const RotationOrder order = parse_rotation_order("ZXY");
  const std::vector<Channel> turn = make_channels(false, order);
  skeleton.add_joint("Hips", -1, {}, make_channels(true, order));
  add_leg(skeleton, *this, true, turn);
  add_leg(skeleton, *this, false, turn);
  std::int32_t last = skeleton.add_joint("Spine", 0, {0, share(0.045, h), -share(0.004, h)}, turn);
  last = skeleton.add_joint("Spine1", last, {0, share(0.062, h), 0}, turn);
  const auto chest = skeleton.add_joint("Spine2", last, {0, share(0.062, h), 0}, turn);
  last = skeleton.add_joint("Neck", chest, {0, share(0.108, h), 0}, turn);
  last = skeleton.add_joint("Neck1", last, {0, share(0.030, h), share(0.004, h)}, turn);
  last = skeleton.add_joint("Head", last, {0, share(0.030, h), share(0.004, h)}, turn);
  skeleton.end_sites.push_back({last, {0, share(0.105, h), 0}, ""});
  add_side(skeleton, *this, true, turn);
  add_side(skeleton, *this, false, turn);
}

ArmAngles mix(const ArmAngles& a, const ArmAngles& b, double t) {
  const auto between = [t](double x, double y) { return x + t * (y - x); };
  return {between(a.flexion, b.flexion),
          between(a.abduction, b.abduction),
          between(a.rotation, b.rotation),
          between(a.elbow, b.elbow),
          between(a.pronation, b.pronation),
          between(a.wrist_flexion, b.wrist_flexion),
          between(a.wrist_deviation, b.wrist_deviation),
          between(a.curl, b.curl),
          between(a.collar_up, b.collar_up)};
}

Quat about_x(double degrees) { return exp(Vec3{degrees * radians_per_degree, 0, 0}); }
Quat about_y(double degrees) { return exp(Vec3{0, degrees * radians_per_degree, 0}); }
Quat about_z(double degrees) { return exp(Vec3{0, 0, degrees * radians_per_degree}); }

Quat pelvis_rotation(const Posture& posture) {
  return about_y(posture.heading_deg + posture.rotation_deg) * about_z(posture.obliquity_deg) *
         about_x(posture.tilt_deg);
}

Vec3 hip_position(const Body& body, const Posture& posture, std::size_t side) {
  const Vec3 offset{side == 0 ? body.hip_half_width : -body.hip_half_width, -body.hip_below_root,
                    0};
  return posture.root + rotate(pelvis_rotation(posture), offset);
}

double leg_stretch(const Body& body, const Posture& posture, std::size_t side) {
  return norm(posture.feet[side].ankle - hip_position(body, posture, side)) / body.leg();
}

BodyPose assemble(const Body& body, const Posture& posture) {
  BodyPose pose;
  pose.root = posture.root;
  pose.rotations[hips] = pelvis_rotation(posture);
  for (std::size_t side = 0; side < 2; ++side) place_leg(body, posture, side, pose);
  const double flexion = posture.spine_flexion, lateral = posture.spine_lateral;
  pose.rotations[spine] = bend(flexion, lateral, posture.spine_twist, 0.30);
  pose.rotations[spine1] = bend(flexion, lateral, posture.spine_twist, 0.35);
  pose.rotations[spine2] = bend(flexion, lateral, posture.spine_twist, 0.35);
  pose.rotations[neck] = bend(posture.neck_flexion, posture.neck_lateral, posture.neck_twist, 0.4);
  pose.rotations[neck1] = bend(posture.neck_flexion, posture.neck_lateral, posture.neck_twist, 0.3);
  pose.rotations[head] = bend(posture.neck_flexion, posture.neck_lateral, posture.neck_twist, 0.3);
  const auto left = left_arm_rotations(body, posture.arms[0], posture.reaches[0]);
  const auto right = left_arm_rotations(body, posture.arms[1], posture.reaches[1]);
  for (std::size_t i = 0; i < arm_joints; ++i) {
    pose.rotations[left_shoulder + i] = left[i];
    pose.rotations[right_shoulder + i] = mirrored(right[i]);
  }
  return pose;
}

}  // namespace kinemend::synth
