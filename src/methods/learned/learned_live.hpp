// Runs the method `learned` on a stream of frames: the network's steps from incoming frames, and
// its network on channels frame by frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "body/representation.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "methods/learned/motion_filter.hpp"
#include "methods/learned/motion_network.hpp"
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

/// The method `learned` on streams of takes like this one. `network`, a `live_form`, and `layout`
/// must outlive the filter. A skeleton is matched by its names. Joints that the model does not
/// know, or whose poses are unlike those it has learned, and markers are cleaned by their own
/// motion. The source of `like` decides whether slow noise is expected. Errors: as of `match_body`
/// for mapped names that do not match.
std::unique_ptr<LiveFilter> make_learned_live(const MotionNetwork& network,
                                              const BodyLayout& layout, const NameMap& names,
                                              const TakeView& like);

/// The learned cleaner frame by frame: frame t enters, frame t - `ahead()` leaves.
class LiveMotionFilter {
 public:
  /// `network`: a `live_form`; it must outlive this.
  LiveMotionFilter(const MotionNetwork& network, double frame_rate_hz,
                   const std::vector<std::int32_t>& slots, std::vector<std::uint8_t> is_position,
                   bool expects_slow_noise);

  std::size_t ahead() const noexcept { return steps_.ahead(); }
  /// As of `LiveMotionSteps::push`. True when `out` (C) holds the next frame.
  bool push(std::span<const float> values, std::span<const std::uint8_t> missing,
            std::span<float> out);
  /// As of `LiveMotionNetwork`.
  void show_body(bool is_shown) { network_.show_body(is_shown); }
  /// The samples (C) of the last output frame; missing ones are bridged.
  std::span<const float> samples_given() const { return steps_.frame(given_ - 1); }
  /// Called after the last frame: gives the remaining frames one by one, then returns false.
  bool flush(std::span<float> out);

 private:
  std::size_t step_before(std::size_t frame) const;
  bool take_step();
  void give(std::span<float> out);

  double frame_rate_hz_;
  LiveMotionSteps steps_;
  LiveMotionNetwork network_;
  MotionSteps step_;
  // The mixes of the last steps; step s is at index s modulo the size.
  std::array<MotionMixes, 4> mixes_;
  std::vector<float> levels_;
  std::size_t known_ = 0, given_ = 0;  // steps, frames
};

}  // namespace kinemend
