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
