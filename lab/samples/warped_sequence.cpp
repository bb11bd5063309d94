// Reads a cubic through the frames of a sequence at another pace.
#include "lab/samples/warped_sequence.hpp"

#include <algorithm>

namespace kinemend {

PoseMatrix warped(const PoseMatrix& poses, double speed, std::size_t frames) {
  PoseMatrix result(frames, poses.channels);
  const auto row = [&](std::ptrdiff_t f) {
    return poses.row(static_cast<std::size_t>(
        std::clamp<std::ptrdiff_t>(f, 0, static_cast<std::ptrdiff_t>(poses.frames) - 1)));
  };
  for (std::size_t f = 0; f < frames; ++f) {
    const double time = speed * static_cast<double>(f);
    const auto before = static_cast<std::ptrdiff_t>(time);
    const double u = time - static_cast<double>(before);
    const auto p = row(before - 1), q = row(before), r = row(before + 1), s = row(before + 2);
    for (std::size_t c = 0; c < poses.channels; ++c) {
      result(f, c) =
          q[c] +
          0.5 * u *
              (r[c] - p[c] +
               u * (2 * p[c] - 5 * q[c] + 4 * r[c] - s[c] + u * (3 * (q[c] - r[c]) + s[c] - p[c])));
    }
  }
  return result;
}

}  // namespace kinemend
