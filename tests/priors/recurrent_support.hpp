#pragma once

#include <string>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "priors/one_joint_model.hpp"
#include "priors/recurrent_input.hpp"

namespace kinemend::test {

/// Of a body of one joint and its place: the random network of
/// train/reference_recurrent_network.cpp, and beside its tensors some features and what LibTorch
/// makes of them.
inline Model small_network_model() {
  Model model = model_of_one_joint("recurrent", "recurrent.safetensors");
  const std::size_t channels = model.layout.channel_count();
  for (const char* name : {"mean", "deviation", "speed"})
    model.tensors[name] = {TensorType::f32, {channels}, std::vector<double>(channels, 1.0)};
  model.numbers = {{"blocks", 2}, {"block0.dilation", 1}, {"block1.dilation", 4}};
  return model;
}

/// The model with outputs that do not depend on what it sees: `gain` for the first `bands` bands of
/// each channel, 0 for all else.
inline Model constant_network_model(std::size_t bands, double gain) {
  Model model = small_network_model();
  const std::size_t channels = model.layout.channel_count();
  Tensor &weight = model.tensors["output.weight"], &bias = model.tensors["output.bias"];
  weight.values.assign(weight.values.size(), 0.0);
  for (std::size_t i = 0; i < bias.values.size(); ++i)
    bias.values[i] = i < bands * channels ? gain : 0.0;
  return model;
}

}  // namespace kinemend::test
