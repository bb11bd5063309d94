// Reads dense, convolutional and LSTM layers from tensors, and runs them as matrix products.
#include "nn/layers.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "kinemend/error.hpp"
#include "nn/kernels.hpp"

namespace kinemend::nn {

namespace {

std::vector<float> read_bias(const NamedTensors& tensors, const std::string& name,
                             std::size_t count) {
  const Tensor& tensor = find_tensor(tensors, name, 1);
  if (tensor.shape[0] != count) {
    throw Error(ErrorKind::unreadable_input, fmt::format("tensor {}: expected {} numbers, found {}",
                                                         name, count, tensor.shape[0]));
  }
  return floats_of(tensor);
}

void fill_rows(const MutableMatrixViewF& y, const std::vector<float>& bias) {
  for (std::size_t r = 0; r < y.rows; ++r)
    std::copy(bias.begin(), bias.end(), y.values + r * y.row_stride);
}

}  // namespace

const Tensor& find_tensor(const NamedTensors& tensors, const std::string& name,
                          std::size_t dimensions) {
  const auto found = tensors.find(name);
  if (found == tensors.end())
    throw Error(ErrorKind::unreadable_input, fmt::format("tensor {} is missing", name));
  const std::vector<std::size_t>& shape = found->second.shape;
  if (shape.size() != dimensions || std::count(shape.begin(), shape.end(), 0) > 0) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("tensor {}: expected {} sizes, found {}", name, dimensions, shape));
  }
  return found->second;
}

std::vector<float> floats_of(const Tensor& tensor) {
  return {tensor.values.begin(), tensor.values.end()};
}

PackedMatrixF packed_transpose(const Tensor& tensor, std::size_t from, std::size_t rows,
                               std::size_t columns, std::size_t row_stride) {
  const std::vector<float> values = floats_of(tensor);
  const MatrixViewF matrix{values.data() + from, rows, columns, row_stride};
  return PackedMatrixF(matrix.transposed());
}

Dense read_dense(const NamedTensors& tensors, const std::string& name, Activation activation) {
  const Tensor& weight = find_tensor(tensors, name + ".weight", 2);
  const std::size_t outputs = weight.shape[0], inputs = weight.shape[1];
  return {packed_transpose(weight, 0, outputs, inputs, inputs),
          read_bias(tensors, name + ".bias", outputs), activation};
}

Convolution read_convolution(const NamedTensors& tensors, const std::string& name,
                             std::size_t dilation, Activation activation) {
  const Tensor& weight = find_tensor(tensors, name + ".weight", 3);
  const std::size_t outputs = weight.shape[0], taps = weight.shape[1], inputs = weight.shape[2];
  Convolution layer;
  for (std::size_t k = 0; k < taps; ++k)
    layer.taps.push_back(packed_transpose(weight, k * inputs, outputs, inputs, taps * inputs));
  layer.bias = read_bias(tensors, name + ".bias", outputs);
  layer.dilation = dilation;
  layer.activation = activation;
  return layer;
}

void run(const Dense& layer, const MatrixViewF& x, const MutableMatrixViewF& y) {
  assert(x.columns == layer.inputs() && y.columns == layer.outputs() && x.rows == y.rows);
  fill_rows(y, layer.bias);
  multiply(x, layer.weight, y, Product::add);
  activate(layer.activation, y);
}

void run(const Convolution& layer, const MatrixViewF& x, const MutableMatrixViewF& y) {
  assert(x.columns == layer.inputs() && y.columns == layer.outputs() && x.rows == y.rows);
  fill_rows(y, layer.bias);
  const std::size_t here = layer.is_causal ? layer.taps.size() - 1 : layer.taps.size() / 2;
  for (std::size_t k = 0; k < layer.taps.size(); ++k) {
    const std::size_t shift = layer.dilation * (k < here ? here - k : k - here);
    if (shift >= x.rows) continue;
    const std::size_t rows = x.rows - shift, from = k < here ? 0 : shift, to = k < here ? shift : 0;
    multiply(x.block(from, 0, rows, x.columns), layer.taps[k], y.block(to, 0, rows, y.columns),
             Product::add);
  }
  activate(layer.activation, y);
}

namespace {

// By definition.
constexpr std::size_t gate_count = 4;

MatrixViewF row_of(std::span<const float> values) {
  return {values.data(), 1, values.size(), values.size()};
}
MutableMatrixViewF mutable_row(std::vector<float>& values) {
  return {values.data(), 1, values.size(), values.size()};
}

void check_gates(const std::string& name, const Dense& input, const Dense& state) {
  if (input.outputs() == gate_count * state.inputs() && state.outputs() == input.outputs()) return;
  throw Error(ErrorKind::unreadable_input,
              fmt::format("layer {}: its {} and {} gates do not fit {} units", name,
                          input.outputs(), state.outputs(), state.inputs()));
}

}  // namespace

Lstm read_lstm(const NamedTensors& tensors, const std::string& name) {
  Lstm layer;
  layer.input = read_dense(tensors, name + ".input");
  Dense state = read_dense(tensors, name + ".state");
  check_gates(name, layer.input, state);
  for (std::size_t i = 0; i < state.bias.size(); ++i) layer.input.bias[i] += state.bias[i];
  layer.state = std::move(state.weight);
  return layer;
}

RecurrentState start(const Lstm& layer) {
  const std::size_t units = layer.units();
  return {std::vector<float>(units), std::vector<float>(units),
          std::vector<float>(gate_count * units)};
}

void restart(RecurrentState& state) {
  std::fill(state.hidden.begin(), state.hidden.end(), 0.0F);
  std::fill(state.cell.begin(), state.cell.end(), 0.0F);
}

void run_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
            const MutableMatrixViewF& y) {
  assert(gates.columns == layer.input.outputs() && y.columns == layer.units() &&
         gates.rows == y.rows);
  for (std::size_t i = 0; i < gates.rows; ++i) {
    const std::size_t t = direction == Direction::forward ? i : gates.rows - 1 - i;
    std::copy_n(gates.values + t * gates.row_stride, gates.columns, state.gates.data());
    multiply(row_of(state.hidden), layer.state, mutable_row(state.gates), Product::add);
    lstm_gates(state.gates.data(), layer.units(), state.cell.data(), state.hidden.data());
    std::copy(state.hidden.begin(), state.hidden.end(), y.values + t * y.row_stride);
  }
}

// The products with the inputs of all frames are computed together.
void run(const Lstm& layer, Direction direction, const MatrixViewF& x,
         const MutableMatrixViewF& y) {
  assert(x.columns == layer.inputs() && y.columns == layer.units() && x.rows == y.rows);
  const std::size_t width = layer.input.outputs();
  std::vector<float> gates(x.rows * width);
  run(layer.input, x, {gates.data(), x.rows, width, width});
  RecurrentState state = start(layer);
  run_on(layer, direction, {gates.data(), x.rows, width, width}, state, y);
}

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
