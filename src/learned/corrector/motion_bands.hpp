// The parts that the features of a step are made of, for whole takes and for live ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "learned/corrector/motion_steps.hpp"
#include "learned/corrector/smoother_bank.hpp"

namespace kinemend {

/// Weights of the frames about a step from the middle outwards, for quick bands and for slow ones.
struct BandHats {
  std::vector<float> quick, slow;

  explicit BandHats(double frame_rate_hz);
  /// Frames about a step that are looked at.
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
/// Of steps at these frames, which ascend. Nothing is allocated where `block` was read before with
/// as many of them.
void read_bands(const SmootherBank& bank, const ExtendedChannels& extended, const BandHats& hats,
                std::span<const std::ptrdiff_t> frames, BandBlock& block);

/// Sums over steps, of which the strengths of channels are means.
struct StrengthSums {
  std::vector<double> squares;      ///< C x motion_bands
  std::vector<double> sum, square;  ///< C, of the slowest level
  double steps = 0;

  explicit StrengthSums(std::size_t channels);
  /// `squares`: C x motion_bands of one step; `slowest`: C, its slowest level, about any origin
  /// that stays. `weight` -1 takes a step out again.
  void add(std::span<const float> squares, std::span<const float> slowest, double weight);
  /// At least one step was added. `expects_slow_noise`: as of `MotionTake`.
  void strengths(std::span<const std::uint8_t> is_position, bool expects_slow_noise,
                 MotionStrengths& result) const;
};

/// The smoothing by the measured noise at a step of a channel.
struct MeasuredAt {
  float level = 0, change = 0;  ///< degrees, degrees per 1/120 s
  float taken_out = 0;          ///< mean square about the step
  bool is_known = false;
};

/// Where the parts of `MotionSteps` of one channel and step go.
struct StepRow {
  float *features, *levels, *changes, *scales;
};
StepRow step_row(MotionSteps& steps, std::size_t channel, std::size_t step);

/// Step `step` of a block, at `frame`, of channel `channel`. `missing`: share of the samples about
/// it that were not measured.
void write_step(const BandBlock& block, std::size_t step, std::ptrdiff_t frame, std::size_t channel,
                double frame_rate_hz, const MotionStrengths& strengths, float missing,
                const MeasuredAt& measured, const StepRow& row);

}  // namespace kinemend
