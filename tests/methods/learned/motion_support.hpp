// A small network of `learned` and a take, from a LibTorch fixture.
#pragma once

#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "methods/learned/motion_steps.hpp"
#include "models/one_joint_model.hpp"

namespace kinemend::test {

/// The random network of lab/networks/reference_motion_network.cpp for a body of one joint with a
/// position. Its tensor file also holds a take and LibTorch's results.
inline Model small_motion_model() {
  Model model = model_of_one_joint("learned", "motion.safetensors");
  model.numbers = {{"blocks", 2},
                   {"block0.dilation", 1},
                   {"block1.dilation", 2},
                   {"second_encoder.dilation", 2}};
  return model;
}

/// The take in the tensor file: one track of the body, and a marker.
inline MotionTake small_motion_take(const Model& model) {
  MotionTake take;
  take.channels = 6;
  take.frame_rate_hz = 120;
  for (const double value : model.tensors.at("take").values)
    take.values.push_back(static_cast<float>(value));
  for (const double value : model.tensors.at("measured").values)
    take.measured.push_back(static_cast<float>(value));
  for (const double mark : model.tensors.at("missing").values)
    take.missing.push_back(mark != 0 ? 1 : 0);
  take.frames = take.values.size() / take.channels;
  take.slots = {0, 1, 2, -1, -1, -1};
  take.is_position = {0, 0, 0, 1, 1, 1};
  return take;
}

/// The model with a network that always selects one smoother and corrects nothing.
inline Model one_smoother_model(std::size_t smoother) {
  Model model = small_motion_model();
  for (const char* name : {"output", "slot_corrections"}) {
    for (const char* part : {".weight", ".bias"}) {
      Tensor& tensor = model.tensors[std::string(name) + part];
      tensor.values.assign(tensor.values.size(), 0);
    }
  }
  model.tensors["output.bias"].values[smoother] = 60;
  return model;
}

}  // namespace kinemend::test
