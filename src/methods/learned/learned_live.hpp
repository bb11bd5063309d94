// Runs the method `learned` on a stream of frames, and its network on channels frame by frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "methods/learned/live_motion_steps.hpp"
#include "methods/learned/motion_filter.hpp"
#include "methods/learned/motion_network.hpp"

namespace kinemend {

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
