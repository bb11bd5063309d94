// Moves a take as a whole so that its floor is at height 0 and it starts at the origin, facing
// forward.
#pragma once

#include <optional>

#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

struct NormaliseSettings {
  /// Moves the take up or down until the lowest level on which a point of a foot usually stands is
  /// at height 0. For markers the point is the lowest marker of a foot, not the sole below it.
  bool floor_at_zero = false;
  /// Turns the take about the vertical axis and moves it horizontally until its first frame (after
  /// the calibration frames) faces forward (`forward_axis`) at the origin. A body faces at right
  /// angles to the line from its right side to its left: for joints between the hips, for markers
  /// between pairs such as LASI and RASI.
  bool face_forward = false;
  std::optional<Axis> up;  ///< empty: the axis along which the body is above its feet
  KnownNames names;        ///< names of the feet, if they are not recognised
};

/// How far a take was moved, in file units and degrees.
struct Normalised {
  Axis up = Axis::y;
  double raised = 0;  ///< along `up`; negative: lowered
  /// About `up`, by the right-hand rule, -180 to 180; applied before the move.
  double turned_deg = 0;
  Vec3 moved;  ///< horizontally, after the turn
};

/// Returns the forward axis: z if y is up, x if z is up, y if x is up.
Axis forward_axis(Axis up);

/// Moves all frames in the same way: for joints the position and rotation of the root, for markers
/// every position. Takes of joints keep their source document, so that unchanged values keep their
/// digits. Takes of markers lose it, because force plates and analog channels are not moved.
/// Errors: `ErrorKind::usage`, with the name of the source, for a take without feet, frames or a
/// direction that is clearly up, for sides that cannot be distinguished, and for a skeleton whose
/// root has no channels for the motion.
Normalised normalise(Take& take, const NormaliseSettings& settings);

}  // namespace kinemend
