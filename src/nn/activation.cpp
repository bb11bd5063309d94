// Chooses the kernel of an activation and applies it to values or rows.
#include "nn/activation.hpp"

#include "nn/activation_kernel.hpp"

namespace kinemend::nn {

void activate(Activation activation, std::span<float> values) {
  switch (activation) {
    case Activation::none:
      return;
    case Activation::relu:
      return relu_of(values.data(), values.size());
    case Activation::tanh:
      return tanh_of(values.data(), values.size());
    case Activation::exp:
      return exp_of(values.data(), values.size());
  }
}

void activate(Activation activation, const MutableMatrixViewF& rows) {
  if (activation == Activation::none) return;
  for (std::size_t r = 0; r < rows.rows; ++r)
    activate(activation, std::span(rows.values + r * rows.row_stride, rows.columns));
}

}  // namespace kinemend::nn
