// A take of joints: one of the two kinds of a take.
#pragma once

#include "kinemend/take.hpp"

namespace kinemend {

/// A take of joints.
struct Clip : Take {
  Clip() = default;
  Clip(Take&& take) : Take(std::move(take)) {}
};

/// How many frames at the start are a calibration pose, 0 to 9, and not part of the motion. A
/// calibration pose is a T-pose as in the CMU files: joints other than roots are within 25 degrees
/// of their rest rotation, 6 on average. A jump follows: one joint turns by more than 25 degrees,
/// and the mean turn of the joints is 1.5 times that of the next step and of nine in ten later
/// steps. Noise does not hide it. Never all frames of a clip.
std::size_t leading_calibration_frames(const Take& clip);

}  // namespace kinemend
