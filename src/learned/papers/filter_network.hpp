// The networks of Mall et al. 2017, for inference: EBF, its ablations BF and NN, and EBD.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/body.hpp"
#include "kinemend/experimental/model.hpp"
#include "learned/papers/predicted_filter.hpp"
#include "nn/recurrent_layers.hpp"

namespace kinemend {

/// A take as these networks see it: F frames of the C channels of all joints but the root.
struct FilterTake {
  std::size_t frames = 0;
  std::size_t channels = 0;    ///< C, three a joint
  std::vector<float> values;   ///< F x C, degrees; bridges where nothing was measured
  std::vector<float> turning;  ///< F x 3, angular velocity of the root, degrees / s, its axes
  std::vector<std::uint8_t> missing;  ///< F x C / 3, 1 where not measured
};
FilterTake filter_take_of(const BodyChannels& channels, const BodyLayout& layout);
/// Writes C channels back into those of the take.
void put_filtered(std::span<const float> values, PoseMatrix& poses);

/// Over the takes of a training.
struct FilterStatistics {
  std::vector<float> mean, deviation;  ///< C, degrees
  std::vector<float> turning;          ///< 3, deviation, degrees / s
};

/// What a network sees beside poses and turning, both normalised, which are C + 3 numbers a frame.
struct FilterInputs {
  bool has_roughness = false;  ///< C: logarithm of what the second differences of the 31 frames
                               ///< about a frame would be as white noise, normalised
  bool has_masks = false;      ///< C / 3: the marks
};
std::size_t filter_feature_count(std::size_t channels, FilterInputs inputs);
/// The number that tells of a channel's roughness: of the mean square of its second differences,
/// square degrees, and its deviation over the training, degrees.
float roughness_feature(double mean_square, float deviation);
/// F x that many.
std::vector<float> filter_features(const FilterTake& take, const FilterStatistics& statistics,
                                   FilterInputs inputs);

/// Dense layers with tanh (the encoder), recurrent layers in both directions side by side, dense
/// layers with tanh and a last one without. BF has no encoder. NN has no recurrent layers, and its
/// first dense layer sees `reach` frames on either side, zeros beyond the ends.
struct FilterNetwork {
  struct BothWays {
    nn::Lstm forward, backward;
  };

  FilterHead head = FilterHead::gaussian;
  std::size_t stride = 1;  ///< frames from one that the network sees to the next; it runs once for
                           ///< each phase
  std::size_t reach = 0;
  FilterInputs inputs;
  FilterStatistics statistics;
  std::vector<nn::Dense> encoder;
  std::vector<BothWays> recurrent;
  std::vector<nn::Dense> decoder;
  double rate_hz = 120;

  std::size_t channels() const noexcept { return statistics.mean.size(); }
};

/// Errors: `ErrorKind::unreadable_input` naming the tensor or number that is missing or does not
/// fit.
FilterNetwork filter_network_of(const Model& model);

/// F x features to F x outputs.
std::vector<float> run(const FilterNetwork& network, std::span<const float> features);
/// F x C: what the network makes of a take at its own rate.
std::vector<float> filtered(const FilterNetwork& network, const FilterTake& take);

}  // namespace kinemend
