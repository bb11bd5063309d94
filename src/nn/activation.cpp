#include "nn/activation.hpp"

#include <algorithm>

#include "nn/activation_kernel.hpp"

namespace kinemend::nn {

namespace {

void softmax(std::span<float> values) {
  if (values.empty()) return;
  const float most = *std::max_element(values.begin(), values.end());
  for (float& value : values) value -= most;
  exp_of(values.data(), values.size());
  float sum = 0;
  for (const float value : values) sum += value;
  for (float& value : values) value /= sum;
}

}  // namespace

void activate(Activation activation, std::span<float> values) {
  switch (activation) {
    case Activation::none:
      return;
    case Activation::relu:
      return relu_of(values.data(), values.size());
    case Activation::elu:
      return elu_of(values.data(), values.size());
    case Activation::tanh:
      return tanh_of(values.data(), values.size());
    case Activation::sigmoid:
      return sigmoid_of(values.data(), values.size());
    case Activation::exp:
      return exp_of(values.data(), values.size());
    case Activation::softmax:
      return softmax(values);
  }
}

void activate(Activation activation, const MutableMatrixViewF& rows) {
  if (activation == Activation::none) return;
  for (std::size_t r = 0; r < rows.rows; ++r)
    activate(activation, std::span(rows.values + r * rows.row_stride, rows.columns));
}

}  // namespace kinemend::nn
