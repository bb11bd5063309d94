// A small network of the method recurrent by LibTorch: writes
// tests/fixtures/nn/recurrent.safetensors, which tests/priors/recurrent_network_test.cpp compares
// with. Built where LibTorch is found:
//   cmake --build build/dev --target reference_recurrent_network
//   build/dev/train/reference_recurrent_network FILE
#include <fstream>
#include <iostream>

#include "kinemend/experimental/random.hpp"
#include "kinemend/experimental/tensor.hpp"
#include "priors/recurrent_input.hpp"
#include "sequence_network.hpp"

using namespace kinemend;

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: reference_recurrent_network FILE\n";
    return 2;
  }
  constexpr std::size_t channels = 6, steps = 23;
  train::ConvolutionalShape shape;
  shape.inputs = recurrent_feature_count(channels);
  shape.hidden = 10;
  shape.outputs = recurrent_output_count(channels);
  shape.dilations = {1, 4};
  train::SequenceNetwork network(shape, {}, 3);
  // The last layer begins with zeros.
  Random random(5);
  TensorFile state = network.state();
  for (auto& [name, tensor] : state.tensors) {
    if (name.rfind("means.", 0) != 0) continue;
    for (double& value : tensor.values)
      value = static_cast<double>(static_cast<float>(0.3 * random.normal()));
  }
  network.set_state(state);
  std::vector<float> features(steps * shape.inputs);
  for (float& value : features) value = static_cast<float>(random.normal());
  const std::vector<float> outputs = network.run(features);
  TensorFile file;
  file.tensors = network.averages();
  file.tensors["features"] = {
      TensorType::f32, {steps, shape.inputs}, {features.begin(), features.end()}};
  file.tensors["outputs"] = {
      TensorType::f32, {steps, shape.outputs}, {outputs.begin(), outputs.end()}};
  file.metadata["made by"] = "train/reference_recurrent_network.cpp";
  std::ofstream(values[1], std::ios::binary) << write_tensors(file);
}
