// Layers of networks in single precision, for inference: they map T rows of one width to T rows of
// another. Their weights have the shapes and the order of gates of LibTorch.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/experimental/tensor.hpp"
#include "nn/activation.hpp"
#include "nn/gemm.hpp"

namespace kinemend::nn {

/// Tensors by name, as of a `TensorFile` or a `Model`.
using NamedTensors = std::map<std::string, Tensor, std::less<>>;

/// y = activation(x W^T + b).
struct Dense {
  PackedMatrixF weight;     ///< inputs x outputs
  std::vector<float> bias;  ///< outputs
  Activation activation = Activation::none;

  std::size_t inputs() const noexcept { return weight.rows(); }
  std::size_t outputs() const noexcept { return weight.columns(); }
};

/// y[t] = activation(b + sum over k of W_k x[t + (k - m) dilation]), zero beyond the ends; m is the
/// last tap if the layer is causal, else the middle.
struct Convolution {
  std::vector<PackedMatrixF> taps;  ///< inputs x outputs each
  std::vector<float> bias;
  std::size_t dilation = 1;
  bool is_causal = false;
  Activation activation = Activation::none;

  std::size_t inputs() const noexcept { return taps.front().rows(); }
  std::size_t outputs() const noexcept { return taps.front().columns(); }
};

/// Reads `<name>.weight` ([outputs, inputs], or [outputs, taps, inputs] of a convolution) and
/// `<name>.bias`. Errors: `ErrorKind::unreadable_input`, naming the tensor, if it is missing or has
/// another shape.
Dense read_dense(const NamedTensors& tensors, const std::string& name,
                 Activation activation = Activation::none);
Convolution read_convolution(const NamedTensors& tensors, const std::string& name,
                             std::size_t dilation = 1, Activation activation = Activation::none);
/// A tensor with this number of dimensions. Errors: as above.
const Tensor& find_tensor(const NamedTensors& tensors, const std::string& name,
                          std::size_t dimensions);
/// The transpose of the `rows` x `columns` matrix at offset `from`, packed.
PackedMatrixF packed_transpose(const Tensor& tensor, std::size_t from, std::size_t rows,
                               std::size_t columns, std::size_t row_stride);
std::vector<float> floats_of(const Tensor& tensor);

/// Shapes must match; y must not overlap x. Does not allocate for up to 32 rows.
void run(const Dense& layer, const MatrixViewF& x, const MutableMatrixViewF& y);
void run(const Convolution& layer, const MatrixViewF& x, const MutableMatrixViewF& y);

}  // namespace kinemend::nn
