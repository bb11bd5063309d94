#include "nn/float_tensor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

#include "kinemend/error.hpp"

namespace kinemend::nn {

namespace {

template <class Real>
BasicMatrixView<Real> view(const std::vector<Real>& values, const std::vector<std::size_t>& shape) {
  if (shape.size() != 2)
    throw Error(ErrorKind::usage, fmt::format("expected a matrix, found shape {}", shape));
  return {values.data(), shape[0], shape[1], shape[1]};
}

}  // namespace

TensorF to_float(const Tensor& tensor) {
  TensorF result{tensor.shape, {}};
  result.values.reserve(tensor.size());
  for (const double value : tensor.values) {
    if (std::abs(value) > static_cast<double>(std::numeric_limits<float>::max()))
      throw Error(ErrorKind::usage, fmt::format("{} is beyond the largest float", value));
    result.values.push_back(static_cast<float>(value));
  }
  return result;
}

Tensor to_tensor(const TensorF& tensor, TensorType stored) {
  return {stored, tensor.shape, {tensor.values.begin(), tensor.values.end()}};
}

MatrixView matrix_of(const Tensor& tensor) { return view(tensor.values, tensor.shape); }
MatrixViewF matrix_of(const TensorF& tensor) { return view(tensor.values, tensor.shape); }

}  // namespace kinemend::nn
