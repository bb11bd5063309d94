#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "nn/layers.hpp"

// Recurrent layers for inference: over whole sequences, and step by step.
namespace kinemend::nn {

enum class Direction { forward, backward };

/// Gates in the order i, f, g, o:
///     c' = s(f) c + s(i) tanh(g),  h' = s(o) tanh(c').
struct Lstm {
  Dense input;          ///< inputs to 4 H; its bias is the sum of both of LibTorch's
  PackedMatrixF state;  ///< H x 4 H

  std::size_t inputs() const noexcept { return input.inputs(); }
  std::size_t units() const noexcept { return state.rows(); }
};

/// Gates in the order r, z, n:
///     n = tanh(a_n + s(r) b_n),  h' = n + s(z) (h - n),
/// where a is what the input brings and b what the state does.
struct Gru {
  Dense input;  ///< inputs to 3 H
  Dense state;  ///< H to 3 H

  std::size_t inputs() const noexcept { return input.inputs(); }
  std::size_t units() const noexcept { return state.inputs(); }
};

/// From `<name>.input.weight` ([4 H, inputs]), `<name>.state.weight` ([4 H, H]) and
/// `<name>.input.bias`,
/// `<name>.state.bias`; of a GRU 3 H. Errors: as of `read_dense`.
Lstm read_lstm(const NamedTensors& tensors, const std::string& name);
Gru read_gru(const NamedTensors& tensors, const std::string& name);

/// What such a layer remembers from frame to frame, and its scratch: all that a step needs.
struct RecurrentState {
  std::vector<float> hidden;      ///< H
  std::vector<float> cell;        ///< H, LSTM
  std::vector<float> gates;       ///< 4 H
  std::vector<float> more_gates;  ///< 3 H, GRU
};
RecurrentState start(const Lstm& layer);
RecurrentState start(const Gru& layer);

/// One frame; `state.hidden` is the output. Allocates nothing.
void step(const Lstm& layer, std::span<const float> x, RecurrentState& state);
void step(const Gru& layer, std::span<const float> x, RecurrentState& state);

/// Back to a state of zeros.
void restart(RecurrentState& state);
/// Some frames from a state, which becomes that of the last of them: `gates` (T x 4 H) is what
/// `layer.input` makes of the inputs, y is T x H. Allocates nothing.
void run_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
            const MutableMatrixViewF& y);

/// All frames from a state of zeros: x is T x inputs, y T x H.
void run(const Lstm& layer, Direction direction, const MatrixViewF& x, const MutableMatrixViewF& y);
void run(const Gru& layer, Direction direction, const MatrixViewF& x, const MutableMatrixViewF& y);

}  // namespace kinemend::nn
