// Moves a take as a whole so that its floor is at height 0 and it starts at the origin, facing
// forward.
#pragma once

#include <optional>

#include "kinemend/rotation.hpp"
#include "kinemend/skeleton.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

struct NormaliseSettings {
  /// Moves the take up or down until the lowest level on which a point of a foot stands as a rule
  /// is at height 0. Of markers this is the lowest marker of a foot, not the sole below it.
  bool floor_at_zero = false;
  /// Turns the take about the vertical axis and moves it horizontally until its first frame (after
  /// the calibration frames) faces forward (`forward_axis`) at the origin. A body faces at right
  /// angles to the line from its right side to its left: of joints between the hips, of markers
  /// between pairs such as LASI and RASI.
  bool face_forward = false;
  std::optional<Axis> up;  ///< none: the axis along which the body stands above its feet
  KnownNames names;        ///< what feet are called where names do not tell
};

/// By how much a take was moved, in file units and degrees.
struct Normalised {
  Axis up = Axis::y;
  double raised = 0;      ///< along `up`; negative: lowered
  double turned_deg = 0;  ///< about `up`, by the right-hand rule, -180 to 180; before it was moved
  Vec3 moved;             ///< horizontally, after the turn
};

/// The axis that counts as forward: z where y is up, x where z is up, y where x is up.
Axis forward_axis(Axis up);

/// Moves all frames alike: of joints the position and the rotation of the root, of markers every
/// position. The first keep their document, so that what did not change keeps its digits; the
/// second lose it, as force plates and analog channels do not follow. Errors: `ErrorKind::usage`,
/// with the name of the source, for a take without feet, frames or a direction that is clearly up,
/// for sides that are not told apart, and for a skeleton whose root has no channels for the motion.
Normalised normalise(Take& take, const NormaliseSettings& settings);

}  // namespace kinemend
