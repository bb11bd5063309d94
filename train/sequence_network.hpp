// Networks from sequences to sequences, and the steps of their training. LibTorch is behind this
// header and in no other: its own headers define CHECK and LOG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kinemend/experimental/tensor.hpp"

namespace kinemend::train {

/// Layers by name with their weights, [out, in] or [out, tap, in]; biases [out].
using Weights = std::map<std::string, Tensor, std::less<>>;

struct DescentSettings {
  double weight_decay = 0.01;
  double most_gradient = 1;      ///< norm to which gradients are cut
  double average_decay = 0.999;  ///< of the running mean of the weights
  double dropout = 0.1;
};

/// Dense layers with tanh, LSTM layers in both directions, dense layers with tanh and a last one
/// without (`FilterNetwork`). Dropout is on what the LSTM layers see.
struct BidirectionalShape {
  std::size_t inputs = 0, outputs = 0;
  std::vector<std::size_t> encoder{128, 96, 80, 64};  ///< empty: none
  std::size_t layers = 2, units = 126;                ///< of each direction
  std::vector<std::size_t> decoder{192, 160, 128};    ///< and `outputs`
  std::size_t reach = 0;       ///< without LSTM layers: frames on either side of a window
  std::vector<double> outset;  ///< of the outputs before training; empty: 0
  double weight_bound = 0;     ///< of the dense layers but the last, before training, uniform; 0:
                               ///< by their width
};

class SequenceNetwork {
 public:
  /// Weights are drawn from the seed; those of the last layer are zero.
  SequenceNetwork(const BidirectionalShape& shape, const DescentSettings& settings,
                  std::uint64_t seed);
  ~SequenceNetwork();

  /// T x inputs to T x outputs, with dropout drawn from `seed`; kept for `add_gradient`. Several
  /// sequences of one length, one behind the other, may go through it at once.
  std::vector<float> forward(std::span<const float> inputs, std::uint64_t seed,
                             std::size_t sequences = 1);
  /// Adds the gradient of the weights, by the derivative by the outputs of the last `forward`.
  void add_gradient(std::span<const float> derivative);
  /// A step of Adam with decoupled weight decay; the gradient is zero again. Returns the norm that
  /// it had.
  double step(double rate);

  /// With the running means of the weights, without dropout.
  std::vector<float> run(std::span<const float> inputs) const;
  Weights averages() const;
  /// All that training goes on from, and back. Errors: `ErrorKind::unreadable_input` for the state
  /// of another network.
  TensorFile state() const;
  void set_state(const TensorFile& state);

 private:
  struct Body;
  std::unique_ptr<Body> body_;
};

}  // namespace kinemend::train
