// Measures how much each track of a stream changes, as the stream runs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace kinemend {

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
