#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/experimental/tensor.hpp"
#include "nn/gemm.hpp"

namespace kinemend::nn {

/// A tensor as networks compute with it.
struct TensorF {
  std::vector<std::size_t> shape;  ///< empty: one number
  std::vector<float> values;       ///< row-major, as many as the product of the shape

  std::size_t size() const noexcept { return values.size(); }
};

/// To the nearest float, within 2^-24 of each value (values below 2^-126 within 2^-150); exact of
/// every type but f64 and i32. Errors: `ErrorKind::usage` for a value beyond the largest float.
TensorF to_float(const Tensor& tensor);
/// Exact.
Tensor to_tensor(const TensorF& tensor, TensorType stored = TensorType::f32);

/// A tensor of two dimensions as a factor of products. Errors: `ErrorKind::usage` for any other.
MatrixView matrix_of(const Tensor& tensor);
MatrixViewF matrix_of(const TensorF& tensor);

}  // namespace kinemend::nn
