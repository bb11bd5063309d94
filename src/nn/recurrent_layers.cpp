// Reads LSTM layers, and runs them over a sequence or one step at a time.
#include "nn/recurrent_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "kinemend/error.hpp"
#include "nn/activation_kernel.hpp"

namespace kinemend::nn {

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

// Completes a step from the input's contribution to the gates.
void step_from_gates(const Lstm& layer, RecurrentState& state) {
  multiply(row_of(state.hidden), layer.state, mutable_row(state.gates), Product::add);
  lstm_gates(state.gates.data(), layer.units(), state.cell.data(), state.hidden.data());
}

// Steps through the frames, given the inputs' contributions to the gates.
void go_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
           const MutableMatrixViewF& y) {
  for (std::size_t i = 0; i < gates.rows; ++i) {
    const std::size_t t = direction == Direction::forward ? i : gates.rows - 1 - i;
    std::copy_n(gates.values + t * gates.row_stride, gates.columns, state.gates.data());
    step_from_gates(layer, state);
    std::copy(state.hidden.begin(), state.hidden.end(), y.values + t * y.row_stride);
  }
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

void step(const Lstm& layer, std::span<const float> x, RecurrentState& state) {
  run(layer.input, row_of(x), mutable_row(state.gates));
  step_from_gates(layer, state);
}

void restart(RecurrentState& state) {
  std::fill(state.hidden.begin(), state.hidden.end(), 0.0F);
  std::fill(state.cell.begin(), state.cell.end(), 0.0F);
}

void run_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
            const MutableMatrixViewF& y) {
  assert(gates.columns == layer.input.outputs() && y.columns == layer.units() &&
         gates.rows == y.rows);
  go_on(layer, direction, gates, state, y);
}

// The products with the inputs of all frames are computed together.
void run(const Lstm& layer, Direction direction, const MatrixViewF& x,
         const MutableMatrixViewF& y) {
  assert(x.columns == layer.inputs() && y.columns == layer.units() && x.rows == y.rows);
  const std::size_t width = layer.input.outputs();
  std::vector<float> gates(x.rows * width);
  run(layer.input, x, {gates.data(), x.rows, width, width});
  RecurrentState state = start(layer);
  go_on(layer, direction, {gates.data(), x.rows, width, width}, state, y);
}

}  // namespace kinemend::nn
