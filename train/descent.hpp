// Weights, layers and the steps of their descent; only files that see LibTorch include it.
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

/// Layers with the weights of a network.
struct LayerCall {
  const Parameters& weights;
  double dropout = 0;        ///< 0: none
  at::Generator drawn_by{};  ///< what is dropped; none: LibTorch's own

  torch::Tensor dense(const torch::Tensor& x, const std::string& layer) const;
  /// Of three taps, `dilation` frames apart, over the last dimension but one; zeros beyond the
  /// ends. What it sees ahead counts by `looks_ahead`, 0 or 1 where there is one.
  torch::Tensor convolution(const torch::Tensor& x, const std::string& layer, std::size_t dilation,
                            const torch::Tensor& looks_ahead = {}) const;
  torch::Tensor drop(const torch::Tensor& x) const;
};

/// Draws weights, uniform and of variance 1 / inputs at gain 1, in the order of their making.
class WeightMaker {
 public:
  WeightMaker(Parameters& weights, std::uint64_t seed) : weights_(weights) {
    torch::manual_seed(seed);
  }
  void add(const std::string& name, std::vector<std::int64_t> shape, double bound);
  void set(const std::string& name, const std::vector<double>& values);
  void add_dense(const std::string& name, std::size_t inputs, std::size_t outputs, double gain = 1);
  /// [outputs, 3, inputs], and a bias.
  void add_convolution(const std::string& name, std::size_t inputs, std::size_t outputs,
                       double gain = 1);

 private:
  Parameters& weights_;
};

/// Adam with decoupled weight decay, and running means of the weights.
struct Descent {
  DescentSettings settings;
  Parameters weights, means, first, second;  // moments of the gradient
  std::int64_t steps = 0;

  /// Once the weights are made.
  void start();
  /// The gradient of a loss, in the order of the weights; undefined where it does not depend on
  /// them. Safe to call from several threads.
  std::vector<torch::Tensor> gradient_of(const torch::Tensor& loss) const;
  /// To be the gradients that `step` goes by.
  void set_gradient(std::vector<torch::Tensor> gradient);
  /// By the gradients that the weights have, which are zero afterwards. Returns their norm.
  double step(double rate);
  Weights averages() const;
  /// Begins with these. Errors: `ErrorKind::unreadable_input` naming the weights that are missing
  /// or have another number.
  void begin_with(const Weights& tensors);
  TensorFile state() const;
  /// Errors: as of `SequenceNetwork::set_state`.
  void set_state(const TensorFile& state);
};

}  // namespace kinemend::train
