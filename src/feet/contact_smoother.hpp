// The most likely errors of root and legs over time, given the times in which heels and toes stand.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "feet/leg_motion.hpp"

namespace kinemend::feet {

/// The evidence of one heel or toe.
struct StandingPart {
  std::vector<double> certainty;  ///< F: how likely it stands (0..1); 0 beside contacts
  std::vector<double> floor;      ///< F: height at which it stands; NaN where that is unknown
};

/// The uncertainty of each value of a body as a standard deviation; zero: it may not change.
struct PoseUncertainty {
  double root_position = 0;        ///< file units, per axis
  double root_rotation = 0;        ///< radians, per axis
  std::vector<std::uint8_t> legs;  ///< one for each leg, 1 if hip, knee and ankle may turn
  double joint_rotation = 0;       ///< radians, per axis that the joint's channels can turn about
};

/// The errors of a motion.
struct MotionError {
  PoseUncertainty size;
  double time_s = 0.05;  ///< for which an error stays similar
};

/// Turns about the joints in their current pose, as rotation vectors in the world, to be applied
/// from the foot upwards.
struct LegUpdate {
  Vec3 hip, knee, ankle;
};
struct PoseUpdate {
  Vec3 root_shift, root_turn;
  std::vector<LegUpdate> legs;
};

/// Estimates the errors x(t) of the root's place and of the turns of root, hips, knees and ankles:
/// the minimum of
///
///   integral sum_i (x_i^2 + T^2 x_i'^2) / (2 T s_i^2) dt                errors of size s last for
///   T
///   + sum over standing parts of integral |d/dt (p + J x)|^2 / r^2 dt    they do not move
///   + sum over standing parts of integral (height(p + J x) - floor)^2 / f^2 dt
///
/// for paths p of the parts and their derivatives J, by Gauss and Newton. A slide that planted feet
/// share is thereby attributed to the root, and errors are continuous beyond the contacts, so that
/// a foot lands where it stands.
class ContactSmoother {
 public:
  /// `parts`: 2 L.
  ContactSmoother(const LegMotion& motion, Up up, std::vector<StandingPart> parts,
                  MotionError error);

  /// Returns the next step of Gauss and Newton for every frame, as turns about the joints in their
  /// current pose. `motion` has the poses after the steps before.
  std::vector<PoseUpdate> step(const LegMotion& motion);

 private:
  std::size_t unknowns() const;
  std::size_t frame_of(std::size_t knot) const;
  /// The step of the knots from `first` to `end`.
  std::vector<double> solve(const LegMotion& motion, std::size_t first, std::size_t end) const;

  std::size_t frames_ = 0, spacing_ = 1, knots_ = 0;
  double rate_hz_ = 0;
  Up up_;
  std::vector<StandingPart> parts_;
  MotionError error_;
  std::vector<double> total_;  // knots x unknowns, the steps so far
};

}  // namespace kinemend::feet
