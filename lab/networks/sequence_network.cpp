// Builds dense and LSTM layers, runs them forward and backward, and adds gradients from the
// derivatives of the outputs.
#include "sequence_network.hpp"

#include <fmt/format.h>
#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "descent.hpp"
#include "lstm_layer.hpp"

namespace kinemend::train {

namespace {

// Places neighbouring frames of each sequence side by side, with zeros beyond the ends.
torch::Tensor windows_of(const torch::Tensor& x, std::int64_t reach) {
  const torch::Tensor pad = torch::zeros({x.size(0), reach, x.size(2)});
  const torch::Tensor padded = torch::cat({pad, x, pad}, 1);
  return padded.as_strided({x.size(0), x.size(1), (2 * reach + 1) * x.size(2)},
                           {padded.stride(0), padded.stride(1), 1});
}

// T x B x inputs to T x B x 2 H: LibTorch's layer, or if gradients are wanted, an equally exact one
// that is faster to differentiate.
torch::Tensor both_ways(const LayerCall& call, std::size_t layer, const torch::Tensor& x) {
  const auto weight = [&](const char* way, const char* part) {
    return call.weights.at(fmt::format("{}{}{}", way, layer, part));
  };
  if (torch::GradMode::is_enabled()) {
    std::vector<torch::Tensor> ways;
    for (const char* way : {"forward", "backward"})
      ways.push_back(lstm_layer(x, weight(way, ".input.weight"), weight(way, ".state.weight"),
                                weight(way, ".input.bias") + weight(way, ".state.bias"),
                                !ways.empty()));
    return torch::cat(ways, 2);
  }
  std::vector<torch::Tensor> weights;
  for (const char* way : {"forward", "backward"}) {
    for (const char* part : {".input.weight", ".state.weight", ".input.bias", ".state.bias"})
      weights.push_back(weight(way, part));
  }
  const torch::Tensor zero = torch::zeros({2, x.size(1), weights[1].size(1)});
  return std::get<0>(torch::lstm(x, {zero, zero}, weights, true, 1, 0.0, false, true, false));
}

torch::Tensor forward_of(const BidirectionalShape& shape, const LayerCall& call, torch::Tensor x,
                         std::int64_t sequences) {
  if (shape.reach > 0) {
    x = x.view({sequences, -1, x.size(1)});
    x = windows_of(x, static_cast<std::int64_t>(shape.reach)).flatten(0, 1);
  }
  for (std::size_t i = 0; i < shape.encoder.size(); ++i)
    x = torch::tanh(call.dense(x, fmt::format("encoder{}", i)));
  if (shape.layers > 0) {
    x = x.view({sequences, -1, x.size(1)}).transpose(0, 1);
    for (std::size_t i = 0; i < shape.layers; ++i) x = both_ways(call, i, call.drop(x));
    x = x.transpose(0, 1).flatten(0, 1);
  }
  for (std::size_t i = 0; i < shape.decoder.size(); ++i)
    x = torch::tanh(call.dense(x, fmt::format("decoder{}", i)));
  return call.dense(x, fmt::format("decoder{}", shape.decoder.size()));
}

void add_lstm(WeightMaker& maker, const std::string& name, std::size_t inputs, std::size_t units) {
  const auto in = static_cast<std::int64_t>(inputs), out = static_cast<std::int64_t>(units);
  maker.add(name + ".input.weight", {4 * out, in}, std::sqrt(3.0 / static_cast<double>(inputs)));
  maker.add(name + ".state.weight", {4 * out, out}, std::sqrt(1.0 / static_cast<double>(units)));
  maker.add(name + ".input.bias", {4 * out}, 0);
  maker.add(name + ".state.bias", {4 * out}, 0);
  // The forget gates start nearly open, so that distant frames have a gradient.
  std::vector<double> open(4 * units);
  std::fill_n(open.begin() + static_cast<std::ptrdiff_t>(units), units, 1.0);
  maker.set(name + ".input.bias", open);
}

void make(const BidirectionalShape& shape, WeightMaker& maker) {
  // Layer outputs have the variance of their inputs. With smaller weights, each of ten layers would
  // shrink the signal, and almost only the biases would reach the outputs.
  std::size_t width = shape.inputs * (2 * shape.reach + 1);
  const auto gain = [&] {
    const double by_width = std::sqrt(3.0 / static_cast<double>(width));
    return shape.weight_bound > 0 ? shape.weight_bound / by_width : 1;
  };
  const auto add_dense = [&](const std::string& name, std::size_t outputs) {
    maker.add_dense(name, width, outputs, gain());
    width = outputs;
  };
  for (std::size_t i = 0; i < shape.encoder.size(); ++i)
    add_dense(fmt::format("encoder{}", i), shape.encoder[i]);
  for (std::size_t i = 0; i < shape.layers; ++i) {
    for (const char* way : {"forward", "backward"})
      add_lstm(maker, fmt::format("{}{}", way, i), width, shape.units);
    width = 2 * shape.units;
  }
  for (std::size_t i = 0; i < shape.decoder.size(); ++i)
    add_dense(fmt::format("decoder{}", i), shape.decoder[i]);
  const std::string last = fmt::format("decoder{}", shape.decoder.size());
  maker.add_dense(last, width, shape.outputs, shape.draws_last ? gain() : 0);
  if (!shape.outset.empty()) maker.set(last + ".bias", shape.outset);
}

}  // namespace

struct SequenceNetwork::Body {
  BidirectionalShape shape;
  Descent descent;
  torch::Tensor last;  // outputs of the last forward pass

  Body(const BidirectionalShape& made, const DescentSettings& given, std::uint64_t seed)
      : shape(made), descent{given, {}, {}, {}, {}} {
    WeightMaker maker(descent.weights, seed);
    make(shape, maker);
    descent.start();
  }

  torch::Tensor matrix_of(std::span<const float> values, std::size_t width) const {
    const auto rows = static_cast<std::int64_t>(values.size() / width);
    return torch::from_blob(const_cast<float*>(values.data()),
                            {rows, static_cast<std::int64_t>(width)});
  }
};

SequenceNetwork::SequenceNetwork(const BidirectionalShape& shape, const DescentSettings& settings,
                                 std::uint64_t seed)
    : body_(std::make_unique<Body>(shape, settings, seed)) {}
SequenceNetwork::~SequenceNetwork() = default;

std::vector<float> SequenceNetwork::forward(std::span<const float> inputs, std::uint64_t seed,
                                            std::size_t sequences) {
  torch::manual_seed(seed);
  const Descent& descent = body_->descent;
  body_->last = forward_of(body_->shape, {descent.weights, descent.settings.dropout},
                           body_->matrix_of(inputs, body_->shape.inputs).clone(),
                           static_cast<std::int64_t>(sequences));
  return floats_of(body_->last);
}

void SequenceNetwork::add_gradient(std::span<const float> derivative) {
  body_->last.backward(body_->matrix_of(derivative, body_->shape.outputs));
  body_->last = torch::Tensor();
}

double SequenceNetwork::step(double rate) { return body_->descent.step(rate); }

std::vector<float> SequenceNetwork::run(std::span<const float> inputs) const {
  const torch::NoGradGuard guard;
  return floats_of(forward_of(body_->shape, {body_->descent.means, 0},
                              body_->matrix_of(inputs, body_->shape.inputs), 1));
}

Weights SequenceNetwork::averages() const { return body_->descent.averages(); }
TensorFile SequenceNetwork::state() const { return body_->descent.state(); }
void SequenceNetwork::set_state(const TensorFile& state) { body_->descent.set_state(state); }

}  // namespace kinemend::train
