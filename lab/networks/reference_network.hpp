// Makes small LibTorch networks with random weights, as references for the library's tests.
#pragma once

#include <string>

#include "kinemend/extend/random.hpp"
#include "kinemend/extend/tensor.hpp"
#include "sequence_network.hpp"

namespace kinemend::train {

/// Makes a small LibTorch network of this shape: its random weights, random features of `steps`
/// steps, and its outputs. The last layer, which would start at zero, is drawn with `deviation`.
inline TensorFile reference_network(const BidirectionalShape& shape, std::size_t steps,
                                    double deviation, const std::string& made_by) {
  SequenceNetwork network(shape, {}, 3);
  Random random(5);
  TensorFile state = network.state();
  for (auto& [name, tensor] : state.tensors) {
    if (name.rfind("means.", 0) != 0) continue;
    for (double& value : tensor.values)
      value = static_cast<double>(static_cast<float>(deviation * random.normal()));
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
  file.metadata["made by"] = made_by;
  return file;
}

}  // namespace kinemend::train
