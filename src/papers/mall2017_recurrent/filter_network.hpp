// Runs the networks of Mall et al. 2017 on takes: EBF, its ablations BF and NN, and EBD, which
// fills gaps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/model.hpp"
#include "nn/layers.hpp"
#include "papers/mall2017_recurrent/predicted_filter.hpp"

namespace kinemend {

/// Channels of a joint: the axes of a rotation vector. By definition.
inline constexpr std::size_t axes_of_turn = 3;

/// A take as input of these networks: F frames of the C channels of all joints but the root.
struct FilterTake {
  std::size_t frames = 0;
  std::size_t channels = 0;    ///< C, three per joint
  std::vector<float> values;   ///< F x C, degrees; gaps are bridged
  std::vector<float> turning;  ///< F x 3, angular velocity of the root, degrees / s, its axes
  std::vector<std::uint8_t> missing;  ///< F x C / 3, 1 for unmeasured samples
};
FilterTake filter_take_of(const BodyChannels& channels, const BodyLayout& layout);
/// Writes the C channels back into the take's channels.
void put_filtered(std::span<const float> values, PoseMatrix& poses);

/// Statistics over the takes of a training.
struct FilterStatistics {
  std::vector<float> mean, deviation;  ///< C, degrees
  std::vector<float> turning;          ///< 3, deviation, degrees / s
};

/// Optional inputs of a network. Poses and turning, both normalised, always are C + 3 numbers a
/// frame.
struct FilterInputs {
  bool has_roughness = false;  ///< C: normalised log deviation of the white noise with the same
                               ///< second differences, over the 31 frames about a frame
  bool has_masks = false;      ///< C / 3: marks of unmeasured samples
};
std::size_t filter_feature_count(std::size_t channels, FilterInputs inputs);
/// The roughness feature of a channel from the mean square of its second differences, square
/// degrees, and its deviation over the training, degrees.
float roughness_feature(double mean_square, float deviation);
/// F x features.
std::vector<float> filter_features(const FilterTake& take, const FilterStatistics& statistics,
                                   FilterInputs inputs);

/// Dense layers with tanh (the encoder), recurrent layers in both directions side by side, then
/// dense layers, all but the last with tanh. BF has no encoder. NN has no recurrent layers, and its
/// first dense layer takes `reach` frames on either side, zeros beyond the ends.
struct FilterNetwork {
  struct BothWays {
    nn::Lstm forward, backward;
  };

  FilterHead head = FilterHead::gaussian;
  std::size_t stride = 1;  ///< frames between two inputs of the network, which runs once for
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

/// Errors: `ErrorKind::unreadable_input` naming the missing or inconsistent tensor or number.
FilterNetwork filter_network_of(const Model& model);

/// Maps F x features to F x outputs.
std::vector<float> run(const FilterNetwork& network, std::span<const float> features);
/// The take after the network at the take's own rate, F x C.
std::vector<float> filtered(const FilterNetwork& network, const FilterTake& take);

/// Poses (F x D) with the joints' unobserved samples filled by an EBD: straight lines over the
/// gaps, plus the network's additions. The additions at the ends of a gap are subtracted again,
/// decaying over a tenth of a second, so that the fill meets the measurements. The network runs at
/// its own rate. The root, the place and joints that were never seen keep straight lines. Observed
/// samples keep their values.
PoseMatrix filled_by_network(const FilterNetwork& network, const BodyLayout& layout,
                             const BodyChannels& channels);

/// Reads a network that fills gaps. Errors: `ErrorKind::usage` for a model of the cleaning method.
FilterNetwork gap_network_of(const Model& model);

/// Whether a take's rate is that of the network, whose filters have fixed lengths in frames.
bool has_rate_of(const FilterNetwork& network, double frame_rate_hz);

}  // namespace kinemend
