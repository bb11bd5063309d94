// A chain of joints that turn near the lock of their Euler angles.
#pragma once

#include <cstddef>

#include "kinemend/experimental/synth.hpp"

namespace kinemend::synth {

/// A chain of five joints whose first Euler angle (yaw) goes round and round while the second
/// (pitch) swings to 88 degrees either way: rotations that turn smoothly where Euler angles are
/// nearly locked.
Take spin(const SynthOptions& options, std::size_t frames);

}  // namespace kinemend::synth
