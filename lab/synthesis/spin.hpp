// A chain of joints that turn near the lock of their Euler angles.
#pragma once

#include <cstddef>

#include "kinemend/lab/synth.hpp"

namespace kinemend::synth {

/// Returns a chain of five joints whose first Euler angle (yaw) makes full turns while the second
/// (pitch) swings to 88 degrees either way: smooth rotations near gimbal lock.
Take spin(const SynthOptions& options, std::size_t frames);

}  // namespace kinemend::synth
