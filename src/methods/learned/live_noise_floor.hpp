// The noise floor of each track of a stream, and the bound by it, frame by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/learned/noise_floor.hpp"

namespace kinemend {

/// `keep_to_noise_floor` for a stream: windows end at the frame, floors are those of the last 16
/// seconds, and no noise is measured. A stream is noisy after three seconds at the earliest, and a
/// track that the model does not know has no floor in the first `shortest_floor_s`.
class LiveNoiseFloor {
 public:
  /// `counts`: one per track, 1 if it helps decide whether the stream is noisy.
  LiveNoiseFloor(double frame_rate_hz, std::vector<std::uint8_t> counts);

  /// Moves `cleaned` (3 per track, degrees) of the next frame towards `samples`. `is_known`:
  /// whether the model knows the body now; `may_be_known`: one per track, 1 if its joint belongs to
  /// the body. Does not allocate.
  void bound(std::span<const float> samples, bool is_known,
             std::span<const std::uint8_t> may_be_known, std::span<float> cleaned);

 private:
  void look_back(bool is_known, std::span<const std::uint8_t> may_be_known);
  bool has_floor(std::size_t track, double& floor);
  double middle_of_last(std::size_t track);

  double frame_rate_hz_;
  std::vector<std::uint8_t> counts_, moves_;
  bool is_noisy_ = false;
  std::vector<float> first_;  // tracks x 3: the first samples
  std::size_t tracks_, window_, lag_, hop_, spike_;
  std::vector<double> last_;  // spike_ x tracks: squared lengths of removals
  std::size_t frames_ = 0;
  std::vector<float> removals_;    // window x tracks x 3, a ring
  std::vector<double> squares_;    // window x tracks: medians of those
  std::vector<double> changes_;    // window x tracks: half their squared changes
  std::vector<double> sums_;       // tracks: of `squares_`
  std::vector<double> lost_;       // tracks: root mean squares of the window
  std::vector<double> levels_;     // kept levels x tracks: root mean squares at every hop, a ring
  std::vector<double> floors_;     // tracks
  std::vector<double> quartiles_;  // tracks, of `changes_`
  std::vector<double> sorted_;
};

}  // namespace kinemend
