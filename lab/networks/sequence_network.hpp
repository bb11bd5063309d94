// Networks from sequences to sequences and their training steps. This header hides LibTorch, whose
// own headers define CHECK and LOG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kinemend/extend/tensor.hpp"

namespace kinemend::train {

/// Weights by layer name: [out, in] or [out, tap, in]; biases [out].
using Weights = std::map<std::string, Tensor, std::less<>>;

struct DescentSettings {
  double weight_decay = 0.01;
  double most_gradient = 1;      ///< norm to which gradients are clipped
  double average_decay = 0.999;  ///< decay of the running mean of the weights
  double dropout = 0.1;
};

/// Dense layers with tanh, bidirectional LSTM layers, dense layers with tanh and a last one without
/// (`FilterNetwork`). Dropout applies to the inputs of the LSTM layers.
struct BidirectionalShape {
  std::size_t inputs = 0, outputs = 0;
  std::vector<std::size_t> encoder{128, 96, 80, 64};  ///< empty: no encoder
  std::size_t layers = 2, units = 126;                ///< units per direction
  std::vector<std::size_t> decoder{192, 160, 128};    ///< followed by `outputs`
  std::size_t reach = 0;       ///< without LSTM layers: frames on either side of a window
  std::vector<double> outset;  ///< initial outputs before training; empty: 0
  bool draws_last = false;     ///< draws the last dense layer too, which is else zero
  double weight_bound = 0;     ///< uniform initial bound of dense layers; 0: by width
};

class SequenceNetwork {
 public:
  /// `seed` determines the weights.
  SequenceNetwork(const BidirectionalShape& shape, const DescentSettings& settings,
                  std::uint64_t seed);
  ~SequenceNetwork();

  /// Maps T x inputs to T x outputs with dropout by `seed`, and keeps the state for `add_gradient`.
  /// It accepts several sequences of equal length, one after the other.
  std::vector<float> forward(std::span<const float> inputs, std::uint64_t seed,
                             std::size_t sequences = 1);
  /// Adds the weights' gradient, given the derivative with respect to the outputs of the last
  /// `forward`.
  void add_gradient(std::span<const float> derivative);
  /// Makes a step of Adam with decoupled weight decay and zeroes the gradient. Returns its norm.
  double step(double rate);

  /// Runs with the running means of the weights, without dropout.
  std::vector<float> run(std::span<const float> inputs) const;
  Weights averages() const;
  /// The complete state for resuming training. Errors: `ErrorKind::unreadable_input` for the state
  /// of another network.
  TensorFile state() const;
  void set_state(const TensorFile& state);

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace kinemend::train
