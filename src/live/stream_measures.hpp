// Measures a stream as it runs: how many frames were lost between two, by their arrival times,
// their rate, and how much each track changes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace kinemend {

class FrameClock {
 public:
  /// `longest_gap_s`: after a longer gap no frame counts as lost.
  FrameClock(double frame_rate_hz, double longest_gap_s)
      : frame_rate_hz_(frame_rate_hz), longest_gap_s_(longest_gap_s) {}

  /// Returns the number of frames missing before the one that arrived at `now_s`, which becomes the
  /// last one.
  std::size_t frames_before(double now_s);
  /// Announces a silence: no frame before the next one counts as lost.
  void pause() { runs_ = false; }
  /// Returns the frames per second over the last seconds without a silence; 0: not measured yet.
  double measured_hz() const { return measured_hz_; }
  /// Returns a message if the measured rate differs from the expected one, once for each rate; else
  /// empty.
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

/// The root mean square of changes for each track.
class RunningChanges {
 public:
  explicit RunningChanges(std::size_t tracks) : squares_(tracks, 0), counts_(tracks, 0) {}

  void add(std::size_t track, double change) {
    // Older changes fade, so that a loose sensor becomes visible: 10 s at 60 Hz. Not swept.
    constexpr std::size_t most = 600;
    counts_[track] = std::min(counts_[track] + 1, most);
    squares_[track] += (change * change - squares_[track]) / static_cast<double>(counts_[track]);
  }
  bool has(std::size_t track) const { return counts_[track] > 0; }
  double rms(std::size_t track) const { return std::sqrt(squares_[track]); }

 private:
  std::vector<double> squares_;
  std::vector<std::size_t> counts_;
};

}  // namespace kinemend
