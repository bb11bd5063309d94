// Writes a small LibTorch network of the method learned to tests/fixtures/nn/motion.safetensors,
// which tests/methods/learned/motion_network_test.cpp compares with. Built where LibTorch is
// found:
//   cmake --build build/release --target reference_motion_network
//   build/release/lab/networks/reference_motion_network FILE
#include <fstream>
#include <iostream>

#include "kinemend/extend/random.hpp"
#include "motion_training.hpp"

using namespace kinemend;

int main(int count, char** values) {
  if (count != 2) {
    std::cerr << "usage: reference_motion_network FILE\n";
    return 2;
  }
  constexpr std::size_t channels = 6, steps = 21, frames = 81;
  train::MotionShape shape{channels, 5, 3, 9, 7, {1, 2}};
  const std::vector<float> mean{1, -2, 0, 3, 0, 1}, deviation{4, 5, 6, 7, 8, 9},
      speed{0.5F, 0.4F, 0.3F, 0.6F, 0.7F, 0.8F};
  train::MotionDescent network(shape, mean, deviation, speed, {}, 3);
  Random random(5);
  TensorFile state = network.state();
  for (auto& [name, tensor] : state.tensors) {
    if (name.rfind("means.", 0) != 0) continue;
    for (double& value : tensor.values)
      value = static_cast<double>(static_cast<float>(0.3 * random.normal()));
  }
  network.set_state(state);
  MotionSample sample;
  MotionTake& take = sample.take;
  take.frames = frames;
  take.channels = channels;
  take.frame_rate_hz = 120;
  take.slots = {0, 1, 2, -1, -1, -1};
  take.is_position = {0, 0, 0, 1, 1, 1};
  for (std::size_t i = 0; i < frames * channels; ++i) {
    take.values.push_back(static_cast<float>(3 * random.normal()));
    take.missing.push_back(random.chance(0.1) ? 1 : 0);
  }
  sample.truth = take.values;
  for (const float value : take.values)
    take.measured.push_back(value + static_cast<float>(random.normal()));
  const std::vector<float> outputs = network.outputs(train::batch_of({sample}, steps));
  sample.is_live = true;
  const std::vector<float> live_outputs = network.outputs(train::batch_of({sample}, steps));
  TensorFile file;
  file.tensors = network.averages();
  const auto put = [&](const char* name, const std::vector<float>& from) {
    file.tensors[name] = {TensorType::f32, {from.size()}, {from.begin(), from.end()}};
  };
  put("mean", mean);
  put("deviation", deviation);
  put("speed", speed);
  put("take", take.values);
  put("measured", take.measured);
  put("missing", {take.missing.begin(), take.missing.end()});
  put("outputs", outputs);
  put("live_outputs", live_outputs);
  file.metadata["made by"] = "lab/networks/reference_motion_network.cpp";
  std::ofstream(values[1], std::ios::binary) << write_tensors(file);
}
