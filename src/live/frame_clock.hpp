// Tells from the times at which frames arrive how many were lost between them, and at what rate
// they come.
#pragma once

#include <cstddef>
#include <string>

namespace kinemend {

class FrameClock {
 public:
  /// `longest_gap_s`: after a longer one nothing counts as lost.
  FrameClock(double frame_rate_hz, double longest_gap_s)
      : frame_rate_hz_(frame_rate_hz), longest_gap_s_(longest_gap_s) {}

  /// How many frames are missing before one that arrived at `now_s`, which is then the last one.
  std::size_t frames_before(double now_s);
  /// A silence follows: nothing before the next frame counts as lost.
  void pause() { runs_ = false; }
  /// Frames per second of the last seconds without a silence; 0: not measured yet.
  double measured_hz() const { return measured_hz_; }
  /// A message where another rate than the expected one is measured, once for each; else empty.
  std::string take_note(std::size_t latency_frames);

 private:
  void measure(double now_s);

  double frame_rate_hz_, longest_gap_s_;
  bool runs_ = false;
  double expected_s_ = 0;  ///< when the next frame is due
  double window_begin_s_ = 0;
  std::size_t window_frames_ = 0;
  double measured_hz_ = 0;
  double told_hz_ = 0;
  std::size_t notes_ = 0;
};

}  // namespace kinemend
