// Activation functions of network layers.
#pragma once

#include <cstdint>
#include <span>

#include "nn/gemm.hpp"

namespace kinemend::nn {

/// Functions of single numbers.
enum class Activation : std::uint8_t { none, relu, tanh, exp };

/// In place. Within 2e-7 of the function (relative for `exp`), and the same bits on every
/// processor. exp of numbers beyond +-87 is that of +-87.
void activate(Activation activation, std::span<float> values);
/// Of each row.
void activate(Activation activation, const MutableMatrixViewF& rows);

}  // namespace kinemend::nn
