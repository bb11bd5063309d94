// Numbers of 16 bits (IEEE 754 binary16).
#pragma once

#include <cstdint>

namespace kinemend {

/// The nearest half, with ties to even; infinity from 65520 on.
std::uint16_t to_half(double value);
/// Exact; infinity and NaN are kept.
double from_half(std::uint16_t half);

}  // namespace kinemend
