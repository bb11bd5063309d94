// The humanoid of artificial takes: its skeleton, its postures, and poses from them.
#pragma once

#include <array>
#include <optional>

#include "kinemend/take.hpp"

namespace kinemend::synth {

/// The joints of the humanoid, depth first. The right side follows the left at a fixed distance.
enum JointId : std::size_t {
  hips,
  left_up_leg,
  left_leg,
  left_foot,
  left_toe_base,
  right_up_leg,
  spine = right_up_leg + 4,
  spine1,
  spine2,
  neck,
  neck1,
  head,
  left_shoulder,
  left_arm,
  left_fore_arm,
  left_hand,
  left_index1,
  left_index2,
  left_thumb1,
  left_thumb2,
  right_shoulder,
  joint_total = right_shoulder + 8,
};

/// A performer: x to the left, y up, z forward, centimetres. The rest pose is a T-pose with palms
/// down.
struct Body {
  double height;
  double thigh, shank;               ///< hip to knee, knee to ankle
  double ankle_height, ball_height;  ///< above the floor, foot flat
  double heel_behind_ankle, ball_ahead_of_ankle;
  double hip_half_width, hip_below_root;
  double upper_arm, fore_arm, palm_length, palm_thickness;
  Vec3 shoulder_offset;  ///< of the left collar bone from the upper spine joint
  Vec3 arm_offset;       ///< of the left shoulder joint from there
  Skeleton skeleton;

  explicit Body(double height_cm);
  double leg() const { return thigh + shank; }
  /// Height of the root above the floor when the legs are straight and the feet flat.
  double straight_height() const { return ankle_height + leg() + hip_below_root; }
};

/// A whole pose in the form that a clip stores.
struct BodyPose {
  Vec3 root;
  std::array<Quat, joint_total> rotations;
};

/// Degrees of a left limb; a right limb is its mirror image. With all zero except abduction the arm
/// hangs straight, palm inwards.
struct ArmAngles {
  double flexion = 0, abduction = 7,
         rotation = 0;  ///< of the shoulder; rotation inwards is positive
  double elbow = 15, pronation = 0;
  double wrist_flexion = 0, wrist_deviation = 0;
  double curl = 18;      ///< of each finger joint
  double collar_up = 0;  ///< of the collar bone
};
ArmAngles mix(const ArmAngles& a, const ArmAngles& b, double t);

/// Puts the wrist of a left arm at a place, in the frame of the upper spine joint.
struct ArmReach {
  Vec3 wrist;
  Vec3 elbow_towards;
  std::optional<Quat>
      hand;  ///< rotation of the hand in the same frame; along the forearm where absent
};

struct FootPlace {
  Vec3 ankle;  ///< world
  double yaw_deg = 0;
  double pitch_deg = 0;  ///< toes up is positive
  double toe_deg = 0;    ///< extension of the toes
};

/// The values that a motion decides; `assemble` derives the rest.
struct Posture {
  Vec3 root;
  double heading_deg = 0;
  double tilt_deg = 0, obliquity_deg = 0,
         rotation_deg = 0;  ///< forwards; left side up; to the left
  double spine_flexion = 0, spine_lateral = 0,
         spine_twist = 0;  ///< forwards; to the right; to the left
  double neck_flexion = 0, neck_lateral = 0, neck_twist = 0;
  std::array<ArmAngles, 2> arms;  ///< left, right
  std::array<std::optional<ArmReach>, 2> reaches;
  std::array<FootPlace, 2> feet;
};

Quat about_x(double degrees);
Quat about_y(double degrees);
Quat about_z(double degrees);

Quat pelvis_rotation(const Posture& posture);
/// Returns the position of a hip joint (side 0 is the left).
Vec3 hip_position(const Body& body, const Posture& posture, std::size_t side);
/// Returns joint rotations that put wrists and ankles where the posture wants them, within reach.
BodyPose assemble(const Body& body, const Posture& posture);
/// Returns the distance from hip to ankle relative to the length of the leg; above 1 the foot is
/// out of reach.
double leg_stretch(const Body& body, const Posture& posture, std::size_t side);

}  // namespace kinemend::synth
