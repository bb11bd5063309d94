// Makes the network's steps from incoming frames.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/learned/motion_steps.hpp"

namespace kinemend {

/// Lookahead of the live form of the learned cleaner in frames: an eighth of a second, at most 14.
std::size_t live_motion_ahead(double frame_rate_hz);

/// The steps of a take frame by frame. A step is made once, as soon as enough frames beyond it
/// exist: as if the take ended at the lookahead of the first frame that needs it, and as if each
/// channel had stood still before its first frame. The strengths of channels are those of the last
/// 128 steps instead of the whole take. No noise is measured.
///
/// A missing sample holds the one before until the next is seen. Then frames of the gap that are
/// not yet out are interpolated linearly.
class LiveMotionSteps {
 public:
  /// `expects_slow_noise`: as of `MotionTake`.
  LiveMotionSteps(double frame_rate_hz, std::vector<std::uint8_t> is_position,
                  bool expects_slow_noise);

  std::size_t channels() const noexcept { return is_position_.size(); }
  std::size_t ahead() const noexcept { return ahead_; }
  std::size_t frames() const noexcept { return frames_; }

  /// `values`: C, degrees; `missing`: C, or empty. Does not allocate once warm.
  void push(std::span<const float> values, std::span<const std::uint8_t> missing);
  /// Called after the last frame: makes the remaining steps available.
  void end() { is_ended_ = true; }
  /// The next step of C channels; false if it is not available yet.
  bool next_step(MotionSteps& step);
  /// C: whether the channel has moved, as of the last step.
  const std::vector<std::uint8_t>& is_alive() const noexcept { return strengths_.is_alive; }

  /// The sample (C) of the last output frame or of one after it.
  std::span<const float> frame(std::size_t frame) const;
  /// Levels of such a frame by all frames so far: bank_levels x C.
  void levels(std::size_t frame, std::span<float> result);

 private:
  float* row_of(std::size_t frame) { return rows_.values.data() + row_index(frame) * channels(); }
  std::size_t row_index(std::size_t frame) const { return frame + past_ - dropped_; }
  void make_room();
  void begin_with(float value, std::size_t channel);
  void bridge(std::size_t channel);
  void extend();
  float missing_share(std::size_t frame, std::size_t channel) const;
  void keep_strengths(std::ptrdiff_t row);

  double frame_rate_hz_;
  std::vector<std::uint8_t> is_position_;
  bool expects_slow_noise_;
  SmootherBank bank_;
  BandHats hats_;
  std::size_t ahead_, step_ahead_;
  std::size_t past_ = 0, behind_ = 0;  // rows before the first frame in use, and after the last
  ExtendedChannels rows_;              // past, then frames, then their continuation
  std::vector<std::uint8_t> missing_;  // the same rows, C each
  std::size_t frames_ = 0;             // pushed
  std::size_t dropped_ = 0;            // rows before these that were dropped
  std::size_t extended_at_ = 0;        // frames when the end was continued last
  bool is_ended_ = false;
  std::vector<std::size_t> missed_;  // C, frames since the channel was seen
  std::vector<float> origins_;       // C, the first sample
  // A ring of the last steps' contributions to the sums.
  std::size_t steps_ = 0;
  std::vector<float> kept_squares_, kept_slowest_;
  StrengthSums sums_;
  MotionStrengths strengths_;
  BandBlock block_;
};

}  // namespace kinemend
