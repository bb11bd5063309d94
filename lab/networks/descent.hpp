// Weights, layers and optimiser steps; only files that use LibTorch include it.
#pragma once

#include <torch/torch.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sequence_network.hpp"

namespace kinemend::train {

using Parameters = std::map<std::string, torch::Tensor, std::less<>>;

std::vector<float> floats_of(const torch::Tensor& tensor);
Tensor tensor_of(const torch::Tensor& values);

/// Runs layers with the weights of a network.
struct LayerCall {
  const Parameters& weights;
  double dropout = 0;        ///< 0: none
  at::Generator drawn_by{};  ///< generator of dropout; none: LibTorch's own

  torch::Tensor dense(const torch::Tensor& x, const std::string& layer) const;
  /// Convolution with three taps, `dilation` frames apart, over the last dimension but one, with
  /// zeros beyond the ends. The tap ahead is weighted by `looks_ahead`, 0 or 1, if given.
  torch::Tensor convolution(const torch::Tensor& x, const std::string& layer, std::size_t dilation,
                            const torch::Tensor& looks_ahead = {}) const;
  torch::Tensor drop(const torch::Tensor& x) const;
};

/// Draws uniform weights with variance 1 / inputs at gain 1, in the order of creation.
class WeightMaker {
 public:
  WeightMaker(Parameters& weights, std::uint64_t seed) : weights_(weights) {
    torch::manual_seed(seed);
  }
  void add(const std::string& name, std::vector<std::int64_t> shape, double bound);
  void set(const std::string& name, const std::vector<double>& values);
  void add_dense(const std::string& name, std::size_t inputs, std::size_t outputs, double gain = 1);
  /// Adds weights [outputs, 3, inputs] and a bias.
  void add_convolution(const std::string& name, std::size_t inputs, std::size_t outputs,
                       double gain = 1);

 private:
  Parameters& weights_;
};

/// Adam with decoupled weight decay and running means of the weights.
struct Descent {
  DescentSettings settings;
  Parameters weights, means, first, second;  // moments of the gradient
  std::int64_t steps = 0;

  /// Call it after the weights are created.
  void start();
  /// The gradient of a loss, in the order of the weights; undefined where it does not depend on
  /// them. Safe to call from several threads.
  std::vector<torch::Tensor> gradient_of(const torch::Tensor& loss) const;
  /// Sets the gradients that `step` uses.
  void set_gradient(std::vector<torch::Tensor> gradient);
  /// Makes a step with the gradients of the weights and zeroes them. Returns their norm.
  double step(double rate);
  Weights averages() const;
  /// Starts with these weights. Errors: `ErrorKind::unreadable_input` naming the weights that are
  /// missing or have another size.
  void begin_with(const Weights& tensors);
  TensorFile state() const;
  /// Errors: those of `SequenceNetwork::set_state`.
  void set_state(const TensorFile& state);
};

}  // namespace kinemend::train
