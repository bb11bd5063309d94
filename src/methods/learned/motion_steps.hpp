// Makes the input of the learned cleaner's network from a take: features of each channel, thirty
// times a second whatever the frame rate. They come from Gaussian means over a range of widths,
// which the cleaner mixes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace kinemend {

/// The channel itself, and its means over Gaussians of these deviations, seconds: each band between
/// two of them is half an octave. Chosen by hand; the network has learned with them.
inline constexpr std::array<double, 10> bank_widths_s{0.0125, 0.0177, 0.025,  0.0354, 0.05,
                                                      0.0708, 0.1,    0.1415, 0.2,    0.283};
inline constexpr std::size_t bank_levels = bank_widths_s.size() + 1;

/// F frames x C channels with `reach` more on either side, where each channel continues as its
/// point reflection about the end of a line fitted to its outermost tenth of a second. Straight
/// lines thus continue, and noise of the last sample does not shift the continuation.
struct ExtendedChannels {
  std::size_t frames = 0, channels = 0, reach = 0;
  std::vector<float> values;  ///< (F + 2 reach) x C

  /// Frame `frame`, from -reach to F + reach - 1.
  const float* row(std::ptrdiff_t frame) const {
    return values.data() +
           (frame + static_cast<std::ptrdiff_t>(reach)) * static_cast<std::ptrdiff_t>(channels);
  }
};

/// The kernels at one frame rate, cut at 3.3 deviations and normalised to sum 1.
class SmootherBank {
 public:
  explicit SmootherBank(double frame_rate_hz);

  std::size_t reach() const noexcept { return reach_; }
  /// `values`: F x C, at least one frame.
  ExtendedChannels extended(std::span<const float> values, std::size_t channels) const;
  /// Continues channels beyond their end: writes `rows` rows, `row` numbers apart, after the one at
  /// `end`, which is the last of `frames`.
  void extend(float* end, std::ptrdiff_t row, std::size_t channels, std::size_t frames,
              std::size_t rows) const;
  /// Level 0 to `bank_levels` - 1 of frames [first, first + count), which may exceed the ends by
  /// `input.reach` less `reach()`: count x C.
  void level(const ExtendedChannels& input, std::size_t level, std::ptrdiff_t first,
             std::size_t count, std::span<float> result) const;

 private:
  double frame_rate_hz_;
  std::size_t reach_ = 0;
  std::vector<std::vector<float>> taps_;  // of each level, from the middle outwards
};

/// The inner loop of the bank: rows of `width` numbers follow each other around `middle`. Writes
/// taps[0] middle + the sum over k of taps[k] (row k before + row k after). Every processor gives
/// the same numbers.
void sum_rows(const float* middle, std::size_t width, std::span<const float> taps, float* result);

// Steps of the network per second: every fourth frame at 120 Hz. A model file is made for it.
// Chosen by hand, not swept.
inline constexpr double motion_steps_hz = 30;
/// Changes are per this fraction of a second. By definition.
inline constexpr double motion_change_rate_hz = 120;
/// The frame of a step, if the take is long enough.
std::size_t frame_of_motion_step(std::size_t step, double frame_rate_hz);
/// A 25th of a second, in frames: quick noise changes within this time.
std::size_t frames_of_quick_noise(double frame_rate_hz);

/// Steps of a take: every frame lies between two of them.
std::size_t motion_step_count(std::size_t frames, double frame_rate_hz);

/// A take as channels. Each track has three: the axes of a rotation vector, or of a position.
struct MotionTake {
  std::size_t frames = 0, channels = 0;
  double frame_rate_hz = 0;
  std::vector<float> values;          ///< F x C, degrees; gaps are bridged
  std::vector<float> measured;        ///< F x C, smoothed by the measured noise; empty: not known
  std::vector<std::uint8_t> missing;  ///< F x C, 1 for unmeasured samples; empty: none
  /// C: the channel of the model's body that this is, in the same axes and about the same
  /// reference; -1 if the model has no such channel, or the body is not known.
  std::vector<std::int32_t> slots;
  std::vector<std::uint8_t> is_position;  ///< C
  /// Whether the take comes from a system with slow errors (video, depth cameras, suits).
  bool expects_slow_noise = false;

  std::size_t steps() const { return motion_step_count(frames, frame_rate_hz); }
  /// The frame of a step.
  std::size_t frame_of_step(std::size_t step) const;
  bool is_missing(std::size_t frame, std::size_t channel) const {
    return !missing.empty() && missing[frame * channels + channel] != 0;
  }
};

/// Levels that can be mixed: those of the bank, and the smoothing by the measured noise. By
/// definition.
inline constexpr std::size_t motion_levels = bank_levels + 1;
/// Bands lie between neighbouring levels of the bank. By definition.
inline constexpr std::size_t motion_bands = bank_levels - 1;
/// The first band, below about 6 Hz, whose value is a feature besides its strength. Chosen by hand;
/// the network has learned with it.
inline constexpr std::size_t first_signed_band = 4;
/// Features, by definition: strengths of bands about the step, the same relative to the whole
/// take's, values of slow bands in units of the take's strength, share of missing samples; for the
/// smoothing by the measured noise what it removes, its difference from the level of 50 ms, and
/// whether it is known.
inline constexpr std::size_t missing_feature =
    2 * motion_bands + (motion_bands - first_signed_band);
inline constexpr std::size_t motion_features = missing_feature + 4;
/// Features of a take, by definition: strengths of bands, spread of the slowest level, whether it
/// is a position, whether slow noise is expected.
inline constexpr std::size_t motion_take_features = motion_bands + 3;
/// Scales of a channel's corrections: the strengths of four bands about the step, and in gaps the
/// spread of the channel. Chosen by hand; the network has learned with them.
inline constexpr std::size_t motion_scales = 5;
inline constexpr std::size_t scale_bands[motion_scales - 1] = {2, 4, 6, 8};

/// Properties of channels over a whole take.
struct MotionStrengths {
  std::vector<float> bands;            ///< C x motion_bands: root mean square, degrees
  std::vector<float> spread;           ///< C: deviation of the slowest level
  std::vector<float> features;         ///< C x motion_take_features
  std::vector<std::uint8_t> is_alive;  ///< C: 1 if the channel moves
};

/// Some steps of a take.
struct MotionSteps {
  std::size_t first = 0, count = 0;
  /// C x motion_take_features of the whole take; live: C x count x motion_take_features, of the
  /// frames available at each step.
  std::vector<float> take_features;
  std::vector<float> features;  ///< C x count x motion_features
  std::vector<float> levels;    ///< C x count x motion_levels, at the step's frame
  std::vector<float> changes;   ///< the same: to the next frame, degrees per 1/120 s
  std::vector<float> scales;    ///< C x count x motion_scales

  /// Resizes all but `take_features`.
  void resize(std::size_t channels, std::size_t steps);
};

/// A take with the data for its steps. The take must outlive it.
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
