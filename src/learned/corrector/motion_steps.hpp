// A take as the network of the learned cleaner sees it: features of each channel, thirty times a
// second whatever the frame rate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "learned/corrector/smoother_bank.hpp"

namespace kinemend {

// Steps of the network a second: every fourth frame of 120 Hz. A model file is made for it. Chosen
// by hand, not swept.
inline constexpr double motion_steps_hz = 30;
/// Changes are told per this part of a second. By definition.
inline constexpr double motion_change_rate_hz = 120;
/// The frame that a step looks at, where the take is that long.
std::size_t frame_of_motion_step(std::size_t step, double frame_rate_hz);
/// A 25th of a second, in frames: noise is quick if it is another so much later.
std::size_t frames_of_quick_noise(double frame_rate_hz);

/// Steps of a take: every frame lies between two of them.
std::size_t motion_step_count(std::size_t frames, double frame_rate_hz);

/// A take as channels. Three belong to a track: the axes of a rotation vector, or of a position.
struct MotionTake {
  std::size_t frames = 0, channels = 0;
  double frame_rate_hz = 0;
  std::vector<float> values;    ///< F x C, degrees; bridges where nothing was measured
  std::vector<float> measured;  ///< F x C, smoothed by the noise that is measured; empty: not known
  std::vector<std::uint8_t> missing;  ///< F x C, 1 where not measured; empty: nowhere
  /// C: which channel of the model's body this is, in the same axes and about the same reference;
  /// -1 where it is none of them, or the body is not known.
  std::vector<std::int32_t> slots;
  std::vector<std::uint8_t> is_position;  ///< C
  /// Whether the take comes from a system whose errors are slow (video, depth cameras, suits).
  bool expects_slow_noise = false;

  std::size_t steps() const { return motion_step_count(frames, frame_rate_hz); }
  /// The frame that a step looks at.
  std::size_t frame_of_step(std::size_t step) const;
  bool is_missing(std::size_t frame, std::size_t channel) const {
    return !missing.empty() && missing[frame * channels + channel] != 0;
  }
};

/// What can be mixed: the levels of the bank, and the smoothing by the measured noise. By
/// definition.
inline constexpr std::size_t motion_levels = bank_levels + 1;
/// Bands lie between neighbouring levels of the bank. By definition.
inline constexpr std::size_t motion_bands = bank_levels - 1;
/// Of these, the ones whose value counts beside their strength: below about 6 Hz. Chosen by hand;
/// the network has learned with it.
inline constexpr std::size_t first_signed_band = 4;
/// Strengths of bands about the step, the same against the whole take's, values of slow bands in
/// units of the take's strength, share of samples that are missing; of the smoothing by the
/// measured noise what it takes out, how it lies to the level of 50 ms, and whether it is known. By
/// definition.
inline constexpr std::size_t missing_feature =
    2 * motion_bands + (motion_bands - first_signed_band);
inline constexpr std::size_t motion_features = missing_feature + 4;
/// Strengths of bands over the take, spread of its slowest level, whether it is a position, whether
/// slow noise is expected. By definition.
inline constexpr std::size_t motion_take_features = motion_bands + 3;
/// What corrections of a channel are measured by: the strengths of four bands about the step, and
/// where samples are missing the spread of the channel. Chosen by hand; the network has learned
/// with them.
inline constexpr std::size_t motion_scales = 5;
inline constexpr std::size_t scale_bands[motion_scales - 1] = {2, 4, 6, 8};

/// What a whole take says of its channels.
struct MotionStrengths {
  std::vector<float> bands;            ///< C x motion_bands: root mean square, degrees
  std::vector<float> spread;           ///< C: deviation of the slowest level
  std::vector<float> features;         ///< C x motion_take_features
  std::vector<std::uint8_t> is_alive;  ///< C: 1 where anything moves
};

/// Some steps of a take.
struct MotionSteps {
  std::size_t first = 0, count = 0;
  /// C x motion_take_features of the whole take; live C x count x motion_take_features, of what was
  /// there at each step.
  std::vector<float> take_features;
  std::vector<float> features;  ///< C x count x motion_features
  std::vector<float> levels;    ///< C x count x motion_levels, at the step's frame
  std::vector<float> changes;   ///< the same: to the next frame, degrees per 1/120 s
  std::vector<float> scales;    ///< C x count x motion_scales

  /// All but `take_features`.
  void resize(std::size_t channels, std::size_t steps);
};

/// A take with what is needed to make steps of it. The take outlives it.
class MotionReader {
 public:
  explicit MotionReader(const MotionTake& take);

  const MotionTake& take() const noexcept { return take_; }
  const SmootherBank& bank() const noexcept { return bank_; }
  const ExtendedChannels& extended() const noexcept { return extended_; }
  const MotionStrengths& strengths() const noexcept { return strengths_; }
  MotionSteps steps(std::size_t first, std::size_t count) const;

 private:
  std::vector<std::ptrdiff_t> frames_of(std::size_t first, std::size_t count) const;
  void read_taken_out(std::size_t frame, const std::vector<float>& weights,
                      std::vector<float>& result) const;
  float missing_share(std::size_t frame, std::size_t channel) const;

  const MotionTake& take_;
  SmootherBank bank_;
  ExtendedChannels extended_;
  MotionStrengths strengths_;
};

}  // namespace kinemend
