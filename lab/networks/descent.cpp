// Runs layers, draws initial weights, and makes the steps of the optimiser with running averages.
#include "descent.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend::train {

namespace {

// Copies the values of a tensor into `target`. Errors: `unreadable_input` for another size.
void take_values(const Tensor& from, torch::Tensor& target, const std::string& name) {
  if (from.values.size() != static_cast<std::size_t>(target.numel()))
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: expected {} numbers, found {}", name,
                                                         target.numel(), from.values.size()));
  const torch::NoGradGuard guard;
  const std::vector<float> floats(from.values.begin(), from.values.end());
  target.copy_(torch::from_blob(const_cast<float*>(floats.data()), target.sizes()));
}

// Places frames t - d, t and t + d of each frame side by side, with zeros beyond the ends.
torch::Tensor with_neighbours(const torch::Tensor& x, std::int64_t dilation,
                              const torch::Tensor& looks_ahead) {
  const std::int64_t frames = x.size(-2);
  std::vector<std::int64_t> sizes = x.sizes().vec();
  sizes[sizes.size() - 2] = dilation;
  const torch::Tensor pad = torch::zeros(sizes);
  const torch::Tensor padded = torch::cat({pad, x, pad}, -2);
  torch::Tensor behind = padded.narrow(-2, 2 * dilation, frames);
  if (looks_ahead.defined()) behind = behind * looks_ahead;
  return torch::cat({padded.narrow(-2, 0, frames), x, behind}, -1);
}

template <class Body>
std::vector<std::pair<std::string, decltype(&std::declval<Body&>().weights)>> parts_of(Body& body) {
  return {{"weights", &body.weights},
          {"means", &body.means},
          {"first", &body.first},
          {"second", &body.second}};
}

}  // namespace

std::vector<float> floats_of(const torch::Tensor& tensor) {
  const torch::Tensor flat = tensor.detach().contiguous();
  const float* values = flat.data_ptr<float>();
  return {values, values + flat.numel()};
}

Tensor tensor_of(const torch::Tensor& values) {
  Tensor tensor;
  for (const std::int64_t size : values.sizes())
    tensor.shape.push_back(static_cast<std::size_t>(size));
  const std::vector<float> floats = floats_of(values);
  tensor.values.assign(floats.begin(), floats.end());
  return tensor;
}

torch::Tensor LayerCall::dense(const torch::Tensor& x, const std::string& layer) const {
  return torch::linear(x, weights.at(layer + ".weight"), weights.at(layer + ".bias"));
}

torch::Tensor LayerCall::convolution(const torch::Tensor& x, const std::string& layer,
                                     std::size_t dilation, const torch::Tensor& looks_ahead) const {
  return torch::linear(with_neighbours(x, static_cast<std::int64_t>(dilation), looks_ahead),
                       weights.at(layer + ".weight").flatten(1), weights.at(layer + ".bias"));
}

torch::Tensor LayerCall::drop(const torch::Tensor& x) const {
  if (!(dropout > 0)) return x;
  const c10::optional<at::Generator> generator =
      drawn_by.defined() ? c10::optional<at::Generator>(drawn_by) : c10::nullopt;
  return x * torch::empty_like(x).bernoulli_(1 - dropout, generator).div_(1 - dropout);
}

void WeightMaker::add(const std::string& name, std::vector<std::int64_t> shape, double bound) {
  torch::Tensor values = torch::zeros(shape);
  if (bound > 0) values.uniform_(-bound, bound);
  weights_[name] = values.requires_grad_(true);
}

void WeightMaker::set(const std::string& name, const std::vector<double>& values) {
  const torch::NoGradGuard guard;
  for (std::size_t i = 0; i < values.size(); ++i)
    weights_.at(name)[static_cast<std::int64_t>(i)] = values[i];
}

void WeightMaker::add_dense(const std::string& name, std::size_t inputs, std::size_t outputs,
                            double gain) {
  const auto in = static_cast<std::int64_t>(inputs), out = static_cast<std::int64_t>(outputs);
  add(name + ".weight", {out, in}, gain * std::sqrt(3.0 / static_cast<double>(inputs)));
  add(name + ".bias", {out}, 0);
}

void WeightMaker::add_convolution(const std::string& name, std::size_t inputs, std::size_t outputs,
                                  double gain) {
  const auto in = static_cast<std::int64_t>(inputs), out = static_cast<std::int64_t>(outputs);
  add(name + ".weight", {out, 3, in}, gain * std::sqrt(3.0 / static_cast<double>(3 * inputs)));
  add(name + ".bias", {out}, 0);
}

void Descent::start() {
  for (const auto& [name, values] : weights) {
    means[name] = values.detach().clone();
    first[name] = torch::zeros_like(values);
    second[name] = torch::zeros_like(values);
  }
}

std::vector<torch::Tensor> Descent::gradient_of(const torch::Tensor& loss) const {
  std::vector<torch::Tensor> all;
  for (const auto& [name, values] : weights) all.push_back(values);
  return torch::autograd::grad({loss}, all, {}, c10::nullopt, false, true);
}

void Descent::set_gradient(std::vector<torch::Tensor> gradient) {
  std::size_t i = 0;
  for (auto& [name, values] : weights) values.mutable_grad() = std::move(gradient[i++]);
}

double Descent::step(double rate) {
  const torch::NoGradGuard guard;
  constexpr double first_decay = 0.9, second_decay = 0.99, least = 1e-8;
  ++steps;
  double square = 0;
  for (const auto& [name, values] : weights) {
    if (values.grad().defined()) square += values.grad().pow(2).sum().item<double>();
  }
  const double size = std::sqrt(square);
  const double cut = std::min(1.0, settings.most_gradient / (size + 1e-12));
  const auto count = static_cast<double>(steps);
  const double first_share = 1 - std::pow(first_decay, count);
  const double second_share = 1 - std::pow(second_decay, count);
  const double decay = std::min(settings.average_decay, count / (count + 10));
  for (auto& [name, values] : weights) {
    if (!values.grad().defined()) continue;
    torch::Tensor gradient = values.grad().mul(cut);
    torch::Tensor &mean = first[name], &variance = second[name];
    mean.mul_(first_decay).add_(gradient, 1 - first_decay);
    variance.mul_(second_decay).addcmul_(gradient, gradient, 1 - second_decay);
    if (values.dim() > 1) values.mul_(1 - rate * settings.weight_decay);
    values.addcdiv_(mean, variance.div(second_share).sqrt_().add_(least), -rate / first_share);
    values.mutable_grad().zero_();
    means[name].mul_(decay).add_(values, 1 - decay);
  }
  return size;
}

Weights Descent::averages() const {
  Weights result;
  for (const auto& [name, values] : means) result[name] = tensor_of(values);
  return result;
}

void Descent::begin_with(const Weights& tensors) {
  for (auto* const part : {&weights, &means}) {
    for (auto& [name, values] : *part) {
      const auto found = tensors.find(name);
      if (found == tensors.end())
        throw Error(ErrorKind::unreadable_input, fmt::format("the model lacks {}", name));
      take_values(found->second, values, name);
    }
  }
}

TensorFile Descent::state() const {
  TensorFile file;
  file.metadata["steps"] = fmt::format("{}", steps);
  for (const auto& [part, values] : parts_of(*this)) {
    for (const auto& [name, tensor] : *values) file.tensors[part + "." + name] = tensor_of(tensor);
  }
  return file;
}

void Descent::set_state(const TensorFile& state) {
  const auto found = state.metadata.find("steps");
  if (found == state.metadata.end())
    throw Error(ErrorKind::unreadable_input, "this is no checkpoint: it does not say its steps");
  steps = std::stoll(found->second);
  for (const auto& [part, values] : parts_of(*this)) {
    for (auto& [name, tensor] : *values) {
      const auto kept = state.tensors.find(part + "." + name);
      if (kept == state.tensors.end())
        throw Error(ErrorKind::unreadable_input,
                    fmt::format("the checkpoint lacks {}.{}", part, name));
      take_values(kept->second, tensor, part + "." + name);
    }
  }
}

}  // namespace kinemend::train
