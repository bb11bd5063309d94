// Stores and reads the model and derives the most probable weights for a given noise.
#include "papers/lou2010_example/example_prior.hpp"

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Variances below this are rounding, square degrees. Not swept.
constexpr double least_kept_variance = 1e-6;

const std::vector<double>& variances(const Tensor& tensor, const char* name) {
  for (const double value : tensor.values) {
    if (value < 0) {
      throw Error(ErrorKind::unreadable_input,
                  std::string("the model's ") + name + " have a negative variance");
    }
  }
  return tensor.values;
}

}  // namespace

void store_example(const ExamplePrior& prior, Model& model) {
  const FilterBases& b = prior.bases;
  model.rate_hz = prior.rate_hz;
  model.numbers["energy"] = b.total_energy;
  model.tensors["bases"] = {TensorType::f16, {b.window_frames, b.channels, b.count}, b.bases};
  model.tensors["eigenvalues"] = {TensorType::f32, {b.count}, b.eigenvalues};
  model.tensors["mean"] = {TensorType::f32, {b.channels}, b.mean};
  model.tensors["residual"] = {TensorType::f32, {b.channels}, b.residual};
  Tensor limits{TensorType::f32, {b.channels, 2}, {}};
  for (std::size_t c = 0; c < b.channels; ++c) {
    limits.values.push_back(prior.lowest[c]);
    limits.values.push_back(prior.highest[c]);
  }
  model.tensors["limits"] = limits;
}

ExamplePrior example_of(const Model& model) {
  ExamplePrior prior;
  prior.rate_hz = model.rate_hz;
  // Braces alone would be taken as a number of dimensions.
  using Shape = std::vector<std::size_t>;
  const Tensor& bases = model.tensor("bases", 3);
  FilterBases& b = prior.bases;
  b.window_frames = bases.shape[0];
  b.channels = bases.shape[1];
  b.count = bases.shape[2];
  if (b.channels != model.layout.channel_count() || b.window_frames == 0) {
    throw Error(ErrorKind::unreadable_input, "the model's bases are not those of its body");
  }
  b.bases = bases.values;
  b.eigenvalues = variances(model.tensor("eigenvalues", Shape{b.count}), "eigenvalues");
  b.mean = model.tensor("mean", Shape{b.channels}).values;
  b.residual = variances(model.tensor("residual", Shape{b.channels}), "residuals");
  b.total_energy = model.number("energy");
  const Tensor& limits = model.tensor("limits", Shape{b.channels, 2});
  for (std::size_t c = 0; c < b.channels; ++c) {
    prior.lowest.push_back(limits.values[2 * c]);
    prior.highest.push_back(limits.values[2 * c + 1]);
  }
  return prior;
}

ExampleWeights probable_weights(const ExamplePrior& prior, const WindowBases& bases,
                                std::span<const double> noise, double welsch_deviations) {
  // The number of windows over a frame.
  const double overlap =
      std::ceil(static_cast<double>(bases.frames) / static_cast<double>(bases.hop));
  const double windows = std::max(overlap, 1.0);
  ExampleWeights weights;
  for (std::size_t c = 0; c < bases.channels; ++c) {
    const double residual = std::max(prior.bases.residual[c], least_kept_variance);
    weights.data.push_back(1 / (noise[c] * noise[c]));
    weights.welsch.push_back(welsch_deviations * noise[c]);
    // Motion outside the bases is smooth: samples between two frames of the model are not
    // independent.
    weights.prior.push_back(1 / (2 * windows * static_cast<double>(bases.hop) * residual));
  }
  for (std::size_t k = 0; k < bases.count; ++k) {
    weights.coefficients.push_back(
        1 / (2 * windows * std::max(prior.bases.eigenvalues[k], least_kept_variance)));
  }
  return weights;
}

}  // namespace kinemend
