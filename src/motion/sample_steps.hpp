// The step from one sample to another, the same for rotations (rotation vectors) and positions.
#pragma once

#include "kinemend/rotation.hpp"

namespace kinemend {

inline Vec3 difference(Quat from, Quat to) { return log(conjugate(from) * to); }
inline Vec3 difference(Vec3 from, Vec3 to) { return to - from; }
inline Quat moved(Quat from, Vec3 by) { return from * exp(by); }
inline Vec3 moved(Vec3 from, Vec3 by) { return from + by; }

}  // namespace kinemend
