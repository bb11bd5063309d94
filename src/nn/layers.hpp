// Runs layers of networks in single precision, for inference: they map T rows of one width to T
// rows of another, and LSTM layers also run step by step. Their weights have the shapes and the
// order of gates of LibTorch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/tensor.hpp"
#include "nn/gemm.hpp"

namespace kinemend::nn {

/// Functions of single numbers.
enum class Activation : std::uint8_t { none, relu, tanh, exp };

/// Applies the function in place, within 2e-7 of the exact value (relative for `exp`), with the
/// same bits on every processor. exp of numbers beyond +-87 is that of +-87.
void activate(Activation activation, std::span<float> values);
/// The same for each row.
void activate(Activation activation, const MutableMatrixViewF& rows);

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

enum class Direction { forward, backward };

/// Gates in the order i, f, g, o:
///     c' = s(f) c + s(i) tanh(g),  h' = s(o) tanh(c').
struct Lstm {
  Dense input;          ///< inputs to 4 H; its bias is the sum of both of LibTorch's
  PackedMatrixF state;  ///< H x 4 H

  std::size_t inputs() const noexcept { return input.inputs(); }
  std::size_t units() const noexcept { return state.rows(); }
};

/// Reads `<name>.input.weight` ([4 H, inputs]), `<name>.state.weight` ([4 H, H]) and
/// `<name>.input.bias`, `<name>.state.bias`. Errors: as of `read_dense`.
Lstm read_lstm(const NamedTensors& tensors, const std::string& name);

/// The state of such a layer between frames, and the scratch of a step.
struct RecurrentState {
  std::vector<float> hidden;  ///< H
  std::vector<float> cell;    ///< H
  std::vector<float> gates;   ///< 4 H
};
RecurrentState start(const Lstm& layer);

/// Runs one frame; `state.hidden` is the output. Does not allocate.
void step(const Lstm& layer, std::span<const float> x, RecurrentState& state);

/// Resets the state to zeros.
void restart(RecurrentState& state);
/// Runs some frames from a state, which becomes that of the last of them: `gates` (T x 4 H) is the
/// output of `layer.input`, y is T x H. Does not allocate.
void run_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
            const MutableMatrixViewF& y);

/// Runs all frames from a state of zeros: x is T x inputs, y T x H.
void run(const Lstm& layer, Direction direction, const MatrixViewF& x, const MutableMatrixViewF& y);

}  // namespace kinemend::nn
