// Makes the steps that the network sees from frames as they come in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "learned/corrector/motion_bands.hpp"

namespace kinemend {

/// Frames that the live form of the learned cleaner looks ahead: an eighth of a second, at most 14.
std::size_t live_motion_ahead(double frame_rate_hz);

/// The steps of a take frame by frame. A step is made once, as soon as enough frames beyond it are
/// there: as if the take ended where the frame that first needs it looks ahead to, and as if each
/// channel had stood still before its first frame. What a whole take says of its channels, its last
/// 128 steps say. No noise is measured.
///
/// A sample that is missing is the one before until the next is seen, and then on the straight line
/// between the two as far as it has not come out.
class LiveMotionSteps {
 public:
  /// `expects_slow_noise`: as of `MotionTake`.
  LiveMotionSteps(double frame_rate_hz, std::vector<std::uint8_t> is_position,
                  bool expects_slow_noise);

  std::size_t channels() const noexcept { return is_position_.size(); }
  std::size_t ahead() const noexcept { return ahead_; }
  std::size_t frames() const noexcept { return frames_; }

  /// `values`: C, degrees; `missing`: C, or empty. Takes nothing from the heap once warm.
  void push(std::span<const float> values, std::span<const std::uint8_t> missing);
  /// No frame follows: the remaining steps are there.
  void end() { is_ended_ = true; }
  /// The next step, if it is there: one step of C channels.
  bool next_step(MotionSteps& step);
  /// C: whether anything has moved, as of the last step.
  const std::vector<std::uint8_t>& is_alive() const noexcept { return strengths_.is_alive; }

  /// The sample of a frame that has not come out yet, or has come out last: C.
  std::span<const float> frame(std::size_t frame) const;
  /// Levels of such a frame by all frames that are there: bank_levels x C.
  void levels(std::size_t frame, std::span<float> result);
  void reset();

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
  std::size_t past_ = 0, behind_ = 0;  // rows before the first frame in use, and beyond the last
  ExtendedChannels rows_;              // past, then frames, then what they are continued by
  std::vector<std::uint8_t> missing_;  // the same rows, C each
  std::size_t frames_ = 0;             // pushed
  std::size_t dropped_ = 0;            // of these, rows that are gone
  std::size_t extended_at_ = 0;        // frames when the end was continued last
  bool is_ended_ = false;
  std::vector<std::size_t> missed_;  // C, frames since it was seen
  std::vector<float> origins_;       // C, the first sample
  // Of the last steps: a ring of what the sums were added.
  std::size_t steps_ = 0;
  std::vector<float> kept_squares_, kept_slowest_;
  StrengthSums sums_;
  MotionStrengths strengths_;
  BandBlock block_;
};

}  // namespace kinemend
