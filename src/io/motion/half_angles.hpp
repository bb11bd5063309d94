// Computes sines and cosines of half angles, with the same result on every machine.
#pragma once

#include <cstddef>

namespace kinemend {

/// Computes sin(a / 2) and cos(a / 2) of `count` angles a in degrees, each to within 2e-16 and the
/// same on every machine. Whole turns are removed exactly before rounding, so that right angles
/// give exact results. NaN and infinity give NaN.
void half_angle_sincos(const double* degrees, std::size_t count, double* sines, double* cosines);

}  // namespace kinemend
