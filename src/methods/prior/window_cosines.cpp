// Builds the matrix of cosines and the places of windows.
#include "methods/prior/window_cosines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/portable.hpp"

namespace kinemend {

Eigen::MatrixXd window_cosines(Eigen::Index frames, Eigen::Index count) {
  Eigen::MatrixXd cosines(frames, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < frames; ++i) {
      const double phase = std::numbers::pi * static_cast<double>(k) *
                           (static_cast<double>(i) + 0.5) / static_cast<double>(frames);
      cosines(i, k) = k == 0 ? 1.0 : std::numbers::sqrt2 * portable::cos(phase);
    }
  }
  return cosines;
}

Eigen::Index window_frames(double window_s, double rate_hz) {
  return std::max<Eigen::Index>(4, std::lround(window_s * rate_hz));
}

std::vector<Eigen::Index> window_starts(Eigen::Index frames, Eigen::Index window) {
  const Eigen::Index hop = std::max<Eigen::Index>(1, window / 4);
  std::vector<Eigen::Index> starts;
  for (Eigen::Index start = 0; start + window < frames; start += hop) starts.push_back(start);
  starts.push_back(std::max<Eigen::Index>(0, frames - window));
  return starts;
}

}  // namespace kinemend
