// Gives access to the motion of a clip without its calibration frames and to the samples of one
// joint, finds the joints that turn at all, counts the children of joints, notes the number of a
// file's first frame, and checks values for `validate` of skeletons and takes.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Adds the number that a file gives to its first frame to the facts of the clip's source, if it is
/// a whole number other than 1.
void note_first_frame(Take& clip, double number);

/// Calls `work` with the clip without its first `frames` frames, and puts these back unchanged,
/// also if `work` throws. `work` may change any sample and add masks, but not the number of frames.
/// In a mask that it adds, the frames put back are observed.
void on_motion(Take& clip, std::size_t frames, const std::function<void(Take&)>& work);

/// Returns the clip from frame `first` on, for reading: the clip itself if `first` is 0, which
/// avoids a copy; else a slice stored in `sliced`.
const Take& frames_from(const Take& clip, std::size_t first, std::optional<Take>& sliced);

/// Whether a joint has two rotations that differ at all, observed or not.
bool joint_moves(const Take& clip, std::size_t joint);
/// Returns all joints that move, in the skeleton's order.
std::vector<std::size_t> moving_joints(const Take& clip);

/// Returns the point that holds the positions of a joint, numbered as in `Take::position`: 0 for
/// joint 0, k + 1 for translated joint k; none for a joint that keeps its offset.
std::optional<std::size_t> point_of_joint(const Take& take, std::size_t joint);

/// Returns the rotations of a joint from frame `first` on.
std::vector<Quat> rotations_of(const Take& take, std::size_t joint, std::size_t first = 0);

/// Returns the number of children of each joint, end sites not included.
std::vector<std::size_t> child_counts(const Skeleton& skeleton);

inline bool is_finite(Vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Throws `ErrorKind::usage` with `what` and both lengths if they differ.
inline void check_length(std::size_t actual, std::size_t expected, const char* what) {
  if (actual == expected) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} values, expected {}", what, actual, expected));
}

}  // namespace kinemend
