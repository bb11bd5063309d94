// Writes weights, numbers and dilations into a model, and computes the learning rate of a batch.
#include "network_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kinemend::train {

void put_weights(const Weights& weights, Model& model) {
  for (const auto& [name, tensor] : weights) {
    model.tensors[name] = tensor;
    model.tensors[name].stored = tensor.shape.size() > 1 ? TensorType::f16 : TensorType::f32;
  }
}

void put_numbers(const char* name, const std::vector<float>& values, Model& model) {
  model.tensors[name] = {TensorType::f32, {values.size()}, {values.begin(), values.end()}};
}

void put_dilations(const std::vector<std::size_t>& dilations, Model& model) {
  model.numbers["blocks"] = static_cast<double>(dilations.size());
  for (std::size_t i = 0; i < dilations.size(); ++i)
    model.numbers[fmt::format("block{}.dilation", i)] = static_cast<double>(dilations[i]);
}

double cosine_rate(std::size_t batch, std::size_t batches, double warm_up, double highest,
                   double least) {
  const double done = static_cast<double>(batch) / static_cast<double>(batches);
  const double cosine = 0.5 + 0.5 * std::cos(std::numbers::pi * std::min(done, 1.0));
  const double warm = std::min(1.0, static_cast<double>(batch + 1) / warm_up);
  return highest * warm * (least + (1 - least) * cosine);
}

}  // namespace kinemend::train
