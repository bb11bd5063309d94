// Layers by LibTorch on random weights: writes tests/fixtures/nn/layers.safetensors, which
// tests/nn/layers_test.cpp compares with. Built where LibTorch is found:
//   cmake --build build/release --target reference_layers
//   build/release/lab/networks/reference_layers FILE
#include <torch/torch.h>

#include <fstream>
#include <iostream>

#include "kinemend/extend/tensor.hpp"

namespace {

kinemend::TensorFile file;

void keep(const std::string& name, const torch::Tensor& values) {
  const torch::Tensor flat = values.detach().contiguous();
  kinemend::Tensor tensor;
  for (const std::int64_t size : flat.sizes())
    tensor.shape.push_back(static_cast<std::size_t>(size));
  const float* from = flat.data_ptr<float>();
  tensor.values.assign(from, from + flat.numel());
  file.tensors[name] = std::move(tensor);
}

torch::Tensor drawn(const std::string& name, std::vector<std::int64_t> shape) {
  const torch::Tensor values = 0.5 * torch::randn(shape);
  keep(name, values);
  return values;
}

void dense() {
  const torch::Tensor x = drawn("dense.x", {5, 7});
  const torch::Tensor weight = drawn("dense.weight", {9, 7}), bias = drawn("dense.bias", {9});
  const torch::Tensor y = torch::linear(4 * x, weight, bias);
  keep("dense.x", 4 * x);
  keep("dense.none", y);
  keep("dense.relu", torch::relu(y));
  keep("dense.tanh", torch::tanh(y));
  keep("dense.exp", torch::exp(y));
}

void convolution(const std::string& name, bool is_causal) {
  constexpr std::int64_t dilation = 2, taps = 3, frames = 11, inputs = 5, outputs = 6;
  const torch::Tensor x = drawn(name + ".x", {frames, inputs});
  const torch::Tensor weight = drawn(name + ".weight", {outputs, taps, inputs});
  const torch::Tensor bias = drawn(name + ".bias", {outputs});
  const std::int64_t left = dilation * (is_causal ? taps - 1 : taps / 2);
  const torch::Tensor padded =
      torch::constant_pad_nd(x.t().unsqueeze(0), {left, dilation * (taps - 1) - left}, 0);
  const auto options = torch::nn::functional::Conv1dFuncOptions().bias(bias).dilation(dilation);
  const torch::Tensor y =
      torch::nn::functional::conv1d(padded, weight.transpose(1, 2).contiguous(), options);
  keep(name + ".y", y.squeeze(0).t());
}

void lstm() {
  constexpr std::int64_t frames = 13, inputs = 5, units = 19, gates = 4;
  const std::string name = "lstm";
  const torch::Tensor x = drawn(name + ".x", {frames, inputs});
  std::vector<torch::Tensor> weights;
  for (const std::string way : {".forward", ".backward"}) {
    weights.push_back(drawn(name + way + ".input.weight", {gates * units, inputs}));
    weights.push_back(drawn(name + way + ".state.weight", {gates * units, units}));
    weights.push_back(drawn(name + way + ".input.bias", {gates * units}));
    weights.push_back(drawn(name + way + ".state.bias", {gates * units}));
  }
  const torch::Tensor zero = torch::zeros({2, 1, units});
  const torch::Tensor y = std::get<0>(
      torch::lstm(x.unsqueeze(1), {zero, zero}, weights, true, 1, 0.0, false, true, false));
  keep(name + ".y", y.squeeze(1));
}

}  // namespace

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: reference_layers FILE\n";
    return 2;
  }
  torch::manual_seed(1);
  dense();
  convolution("centred", false);
  convolution("causal", true);
  lstm();
  file.metadata["made by"] = "tools/reference/layers.cpp, LibTorch " TORCH_VERSION;
  std::ofstream(values[1], std::ios::binary) << kinemend::write_tensors(file);
}
