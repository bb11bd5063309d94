// Recurrent layers for inference: over whole sequences, and step by step.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "nn/layers.hpp"

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

/// From `<name>.input.weight` ([4 H, inputs]), `<name>.state.weight` ([4 H, H]) and
/// `<name>.input.bias`, `<name>.state.bias`. Errors: as of `read_dense`.
Lstm read_lstm(const NamedTensors& tensors, const std::string& name);

/// What such a layer remembers from frame to frame, and its scratch: all that a step needs.
struct RecurrentState {
  std::vector<float> hidden;  ///< H
  std::vector<float> cell;    ///< H
  std::vector<float> gates;   ///< 4 H
};
RecurrentState start(const Lstm& layer);

/// One frame; `state.hidden` is the output. Allocates nothing.
void step(const Lstm& layer, std::span<const float> x, RecurrentState& state);

/// Back to a state of zeros.
void restart(RecurrentState& state);
/// Some frames from a state, which becomes that of the last of them: `gates` (T x 4 H) is what
/// `layer.input` makes of the inputs, y is T x H. Allocates nothing.
void run_on(const Lstm& layer, Direction direction, const MatrixViewF& gates, RecurrentState& state,
            const MutableMatrixViewF& y);

/// All frames from a state of zeros: x is T x inputs, y T x H.
void run(const Lstm& layer, Direction direction, const MatrixViewF& x, const MutableMatrixViewF& y);

}  // namespace kinemend::nn
