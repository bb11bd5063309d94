// The network of the learned cleaner, for inference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/model.hpp"
#include "methods/learned/motion_steps.hpp"
#include "nn/layers.hpp"

namespace kinemend {

/// Outputs for a channel and step, by definition: the logarithm of the weight of each smoother (the
/// levels of the bank; then, for those between the first and the last, twice the level less the
/// next, which preserves peaks better; then the smoothing by the measured noise), corrections in
/// units of the channel's scales, and the logarithm of the variance of the result's error, square
/// degrees.
inline constexpr std::size_t motion_smoothers = bank_levels + (bank_levels - 2) + 1;
inline constexpr std::size_t motion_outputs = motion_smoothers + motion_scales + 1;
/// Corrections that a known body adds to those of its channels. Chosen by hand; the network has
/// learned with it.
inline constexpr std::size_t motion_body_corrections = 3;
inline constexpr std::size_t first_body_correction = motion_scales - motion_body_corrections;

/// Limits of the body's poses, in deviations, and paces, in typical speeds: motion far from the
/// training must not mislead the network further. Chosen by hand; the network has learned with
/// them.
inline constexpr float most_pose = 4, most_pace = 6;

/// An encoder and a head that all channels share, with a trunk over the body between them. The
/// trunk takes the encoded channels and poses of known channels, and the mean over all channels.
struct MotionNetwork {
  struct Block {
    nn::Convolution convolution;
    nn::Dense dense;
  };

  std::size_t slots = 0;               ///< D, channels of the known body
  std::vector<float> mean, deviation;  ///< D, degrees
  std::vector<float> speed;            ///< D, deviation of changes, degrees per 1/120 s
  nn::Convolution encoder, second_encoder;
  nn::Dense of_take;     ///< contribution of the take's strengths to the encoder
  nn::Dense body, pool;  ///< inputs of the trunk
  std::vector<Block> blocks;
  nn::Dense to_slots;          ///< trunk to D x units of each channel
  nn::Dense slot_corrections;  ///< trunk to D x `motion_body_corrections`
  nn::Dense to_all, head, output;

  std::size_t encoded() const noexcept { return encoder.outputs(); }
  std::size_t slot_units() const noexcept { return to_slots.outputs() / slots; }
  /// Steps on either side that a step depends on.
  std::size_t reach() const;
};

/// Errors: `ErrorKind::unreadable_input` naming the missing or inconsistent tensor or number.
MotionNetwork motion_network_of(const Model& model);

/// The network for live use: no layer looks ahead, beyond the frames of a step's features.
MotionNetwork live_form(const MotionNetwork& network);

/// Properties of a take's channels that the network uses.
struct MotionChannels {
  std::span<const std::int32_t> slots;     ///< C, as of `MotionTake`
  std::span<const std::uint8_t> is_alive;  ///< C
};

/// Computes the trunk's input for one step: D (encoded + 2), the encoded channels of the body in
/// its order, then their poses and paces. `encoded`: C x steps x encoded.
void fill_body_input(const MotionNetwork& network, const MotionChannels& channels,
                     const MotionSteps& steps, std::size_t step, std::span<const float> encoded,
                     std::span<float> result);
/// steps x 2 encoded: means and mean squares over the alive channels.
void fill_pooled(const MotionNetwork& network, const MotionChannels& channels,
                 std::span<const float> encoded, std::size_t steps, std::span<float> result);

/// Returns C x steps x `motion_outputs`. Channels that are not alive are ignored; their outputs are
/// meaningless.
std::vector<float> run(const MotionNetwork& network, const MotionChannels& channels,
                       const MotionSteps& steps);

}  // namespace kinemend
