// The network of the learned cleaner, for inference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "learned/corrector/motion_steps.hpp"
#include "nn/layers.hpp"

namespace kinemend {

/// What a step says of a channel: the logarithm of the weight of each smoother (the levels of the
/// bank, then, of those between the first and the last, twice the level less the next, which keeps
/// peaks better, then the smoothing by the measured noise), corrections in units of the channel's
/// scales, and the logarithm of the variance of what will be wrong with the result, degrees
/// squared. By definition.
inline constexpr std::size_t motion_smoothers = bank_levels + (bank_levels - 2) + 1;
inline constexpr std::size_t motion_outputs = motion_smoothers + motion_scales + 1;
/// Corrections that a known body adds to those of its channels. Chosen by hand; the network has
/// learned with it.
inline constexpr std::size_t motion_body_corrections = 3;
inline constexpr std::size_t first_body_correction = motion_scales - motion_body_corrections;

/// Poses of the body beyond so many deviations, and paces beyond so many typical speeds, are shown
/// as these: what is stranger than all that was learned from must not lead the network further
/// astray. Chosen by hand; the network has learned with them.
inline constexpr float most_pose = 4, most_pace = 6;

/// An encoder and a head that all channels share, and a trunk over the body between them: it sees
/// the encoded channels and the pose of those that it knows, and the mean of all that there are.
struct MotionNetwork {
  struct Block {
    nn::Convolution convolution;
    nn::Dense dense;
  };

  std::size_t slots = 0;               ///< D, channels of the body that it knows
  std::vector<float> mean, deviation;  ///< D, degrees
  std::vector<float> speed;            ///< D, deviation of changes, degrees per 1/120 s
  nn::Convolution encoder, second_encoder;
  nn::Dense of_take;     ///< what the take's strengths add to the encoder
  nn::Dense body, pool;  ///< into the trunk
  std::vector<Block> blocks;
  nn::Dense to_slots;          ///< trunk to D x units of each channel
  nn::Dense slot_corrections;  ///< trunk to D x `motion_body_corrections`
  nn::Dense to_all, head, output;

  std::size_t encoded() const noexcept { return encoder.outputs(); }
  std::size_t slot_units() const noexcept { return to_slots.outputs() / slots; }
  /// Steps on either side that a step depends on.
  std::size_t reach() const;
};

/// Errors: `ErrorKind::unreadable_input` naming the tensor or number that is missing or does not
/// fit.
MotionNetwork motion_network_of(const Model& model);

/// The network as it runs live: no layer looks ahead, beyond what the features of a step see.
MotionNetwork live_form(const MotionNetwork& network);

/// What a network is told of the channels of a take.
struct MotionChannels {
  std::span<const std::int32_t> slots;     ///< C, as of `MotionTake`
  std::span<const std::uint8_t> is_alive;  ///< C
};

/// Into the trunk, of one step: D (encoded + 2), the encoded channels of the body in its order,
/// then their poses and paces. `encoded`: C x steps x encoded.
void fill_body_input(const MotionNetwork& network, const MotionChannels& channels,
                     const MotionSteps& steps, std::size_t step, std::span<const float> encoded,
                     std::span<float> result);
/// steps x 2 encoded: means and mean squares over the channels that are alive.
void fill_pooled(const MotionNetwork& network, const MotionChannels& channels,
                 std::span<const float> encoded, std::size_t steps, std::span<float> result);

/// C x steps x `motion_outputs`. Channels that are not alive have no say; their outputs mean
/// nothing.
std::vector<float> run(const MotionNetwork& network, const MotionChannels& channels,
                       const MotionSteps& steps);

}  // namespace kinemend
