// The parts of a step's features, for whole takes and for live ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/learned/motion_steps.hpp"
#include "methods/learned/smoother_bank.hpp"

namespace kinemend {

/// Weights of the frames about a step from the middle outwards, for quick bands and for slow ones.
struct BandHats {
  std::vector<float> quick, slow;

  explicit BandHats(double frame_rate_hz);
  /// Frames on either side of a step that are needed.
  std::ptrdiff_t margin() const { return static_cast<std::ptrdiff_t>(slow.size()); }
};

/// Levels about some steps, and the mean squares of the bands at each.
struct BandBlock {
  std::ptrdiff_t first_frame = 0;
  std::size_t frames = 0, channels = 0;
  std::vector<std::vector<float>> levels;  ///< each frames x C
  std::vector<float> squares;              ///< steps x C x motion_bands
  std::vector<float> sums;                 ///< scratch, C

  float level_at(std::size_t level, std::ptrdiff_t frame, std::size_t channel) const {
    return levels[level][static_cast<std::size_t>(frame - first_frame) * channels + channel];
  }
};
/// Reads the bands of steps at these ascending frames. Does not allocate if `block` was read before
/// with as many.
void read_bands(const SmootherBank& bank, const ExtendedChannels& extended, const BandHats& hats,
                std::span<const std::ptrdiff_t> frames, BandBlock& block);

/// Sums over steps; the strengths of channels are their means.
struct StrengthSums {
  std::vector<double> squares;      ///< C x motion_bands
  std::vector<double> sum, square;  ///< C, of the slowest level
  double steps = 0;

  explicit StrengthSums(std::size_t channels);
  /// `squares`: C x motion_bands of one step; `slowest`: C, its slowest level, about any fixed
  /// origin. `weight` -1 removes a step.
  void add(std::span<const float> squares, std::span<const float> slowest, double weight);
  /// Requires at least one added step. `expects_slow_noise`: as of `MotionTake`.
  void strengths(std::span<const std::uint8_t> is_position, bool expects_slow_noise,
                 MotionStrengths& result) const;
};

/// The smoothing by the measured noise at a step of a channel.
struct MeasuredAt {
  float level = 0, change = 0;  ///< degrees, degrees per 1/120 s
  float taken_out = 0;          ///< mean square about the step
  bool is_known = false;
};

/// Destinations in `MotionSteps` of one channel and step.
struct StepRow {
  float *features, *levels, *changes, *scales;
};
StepRow step_row(MotionSteps& steps, std::size_t channel, std::size_t step);

/// Writes step `step` of a block, at `frame`, of channel `channel`. `missing`: share of unmeasured
/// samples about it.
void write_step(const BandBlock& block, std::size_t step, std::ptrdiff_t frame, std::size_t channel,
                double frame_rate_hz, const MotionStrengths& strengths, float missing,
                const MeasuredAt& measured, const StepRow& row);

}  // namespace kinemend
