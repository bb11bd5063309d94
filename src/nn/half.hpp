// Numbers of 16 bits (IEEE 754 binary16).
#pragma once

#include <cstdint>

namespace kinemend {

/// The nearest half, of two equally near the even one; an infinity from 65520 on.
std::uint16_t to_half(double value);
/// Exact; infinite or no number where the half is.
double from_half(std::uint16_t half);

}  // namespace kinemend
