// A network of Mall et al. 2017 with a constant output, for tests.
#pragma once

#include <cmath>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend::test {

/// A one-layer network of Mall et al. with the constant output `output` in every channel.
inline Model constant_filter_model(const BodyLayout& layout, FilterHead head, double output,
                                   FilterInputs inputs = {}) {
  const std::size_t channels = 3 * (layout.track_count() - 1);
  const std::size_t width = filter_feature_count(channels, inputs);
  const auto vector_of = [](std::size_t count, double value) {
    return Tensor{TensorType::f32, {count}, std::vector<double>(count, value)};
  };
  Model model;
  model.method = "recurrent";
  model.rate_hz = 120;
  model.layout = layout;
  model.tensors["mean"] = vector_of(channels, 0);
  model.tensors["deviation"] = vector_of(channels, 1);
  model.tensors["turning"] = vector_of(3, 1);
  model.tensors["decoder0.weight"] = {
      TensorType::f32, {channels, width}, std::vector<double>(channels * width)};
  model.tensors["decoder0.bias"] = vector_of(channels, output);
  model.numbers = {{"head", static_cast<double>(head)},
                   {"stride", 1},
                   {"reach", 0},
                   {"roughness", inputs.has_roughness ? 1 : 0},
                   {"masks", inputs.has_masks ? 1 : 0},
                   {"encoders", 0},
                   {"layers", 0},
                   {"decoders", 1}};
  return model;
}

}  // namespace kinemend::test
