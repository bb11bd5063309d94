// Runs the network of the learned cleaner, over all steps of a take or step by step with the last
// inputs of each layer kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/model.hpp"
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

/// A network in its live form, step by step, with the result of `run` on the same steps at once.
/// Nothing is computed twice.
class LiveMotionNetwork {
 public:
  /// `network` is a `live_form`, and must outlive this. `slots`: C, as of `MotionTake`.
  LiveMotionNetwork(const MotionNetwork& network, std::vector<std::int32_t> slots);

  /// `step`: one step with features of the take. Returns C x `motion_outputs`, valid until the next
  /// call. Does not allocate.
  std::span<float> run(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  /// Whether the channels are those of the body from the next step on, as at first, or each by
  /// itself.
  void show_body(bool is_shown) { is_body_shown_ = is_shown; }

 private:
  /// The last inputs of a convolution, one row of `width` numbers for each of `rows`.
  struct History {
    std::size_t size = 0;  // rows x width
    std::vector<float> values;
    std::size_t next = 0, steps = 0;

    History(std::size_t steps_back, std::size_t numbers)
        : size(numbers), values(steps_back * numbers), steps(steps_back) {}
    /// The oldest inputs; `keep` overwrites them.
    const float* oldest() const { return values.data() + next * size; }
    void keep(std::span<const float> now);
  };

  void encode(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  void run_trunk(const MotionSteps& step, std::span<const std::uint8_t> is_alive);
  void run_head(std::span<const std::uint8_t> is_alive);
  std::size_t channels() const { return slots_.size(); }
  const std::vector<std::int32_t>& slots() const { return is_body_shown_ ? slots_ : no_slots_; }

  const MotionNetwork& network_;
  std::vector<std::int32_t> slots_, no_slots_;
  bool is_body_shown_ = true;
  History features_, first_;
  std::vector<History> trunk_;
  std::vector<float> of_take_, encoded_, scratch_, body_, pooled_, wide_, added_, taps_;
  std::vector<float> of_slots_, corrections_, shared_, input_, hidden_, outputs_;
};

}  // namespace kinemend
