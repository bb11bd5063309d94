// Small networks of Mall et al. 2017 with random weights, for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/extend/random.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend::test {

/// A small network of the paper with random weights.
struct RandomNetwork {
  std::size_t layers = 2;  ///< recurrent layers; 0: dense layers only, which see `reach` frames
  std::size_t reach = 0;
  bool has_roughness = false;
  bool is_narrow = false;  ///< always predicts the narrowest filter
  std::size_t units = 6;
  std::uint64_t seed = 11;
};

/// Uses the body of `layout`, or a root and four joints.
inline Model random_filter_model(const RandomNetwork& kind, const BodyLayout* layout = nullptr) {
  Random random(kind.seed);
  Model model;
  model.method = "recurrent";
  model.rate_hz = 120;
  if (layout != nullptr) {
    model.layout = *layout;
  } else {
    model.layout.names = {"Hips", "LeftUpLeg", "RightUpLeg", "LeftLeg", "RightLeg"};
    model.layout.parents = {-1, 0, 0, 1, 2};
    model.layout.references.assign(5, Quat{});
    model.layout.bones.assign(5, Vec3{0, 1, 0});
  }
  const std::size_t channels = 3 * (model.layout.track_count() - 1);
  const FilterInputs inputs{kind.has_roughness, false};
  const auto constant = [](std::size_t count, double value) {
    return Tensor{TensorType::f32, {count}, std::vector<double>(count, value)};
  };
  const auto drawn = [&](std::size_t outputs, std::size_t width, double size) {
    Tensor tensor{TensorType::f32, {outputs, width}, {}};
    const double share = size / std::sqrt(static_cast<double>(width));
    for (std::size_t i = 0; i < outputs * width; ++i)
      tensor.values.push_back(
          static_cast<double>(static_cast<float>(random.uniform(-share, share))));
    return tensor;
  };
  const auto add_dense = [&](const std::string& name, std::size_t outputs, std::size_t width,
                             double size) {
    model.tensors[name + ".weight"] = drawn(outputs, width, size);
    model.tensors[name + ".bias"] = constant(outputs, 0.1);
  };
  std::size_t width = filter_feature_count(channels, inputs) * (2 * kind.reach + 1);
  for (std::size_t i = 0; i < kind.layers; ++i) {
    for (const char* way : {"forward", "backward"}) {
      const std::string name = way + std::to_string(i);
      add_dense(name + ".input", 4 * kind.units, width, 2);
      add_dense(name + ".state", 4 * kind.units, kind.units, 2);
    }
    width = 2 * kind.units;
  }
  add_dense("decoder0", 8, width, 2);
  add_dense("decoder1", channels, 8, kind.is_narrow ? 0 : 2);
  if (kind.is_narrow) model.tensors["decoder1.bias"] = constant(channels, -5);
  model.tensors["mean"] = constant(channels, 1);
  model.tensors["deviation"] = constant(channels, 15);
  model.tensors["turning"] = constant(3, 100);
  model.numbers = {{"head", 0},
                   {"stride", 1},
                   {"reach", static_cast<double>(kind.reach)},
                   {"roughness", kind.has_roughness ? 1 : 0},
                   {"masks", 0},
                   {"encoders", 0},
                   {"layers", static_cast<double>(kind.layers)},
                   {"decoders", 2}};
  return model;
}

}  // namespace kinemend::test
