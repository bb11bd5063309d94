// Activation functions of network layers.
#pragma once

#include <cstdint>
#include <span>

#include "nn/gemm.hpp"

namespace kinemend::nn {

/// Functions of single numbers.
enum class Activation : std::uint8_t { none, relu, tanh, exp };

/// Applies the function in place, within 2e-7 of the exact value (relative for `exp`), with the
/// same bits on every processor. exp of numbers beyond +-87 is that of +-87.
void activate(Activation activation, std::span<float> values);
/// The same for each row.
void activate(Activation activation, const MutableMatrixViewF& rows);

}  // namespace kinemend::nn
