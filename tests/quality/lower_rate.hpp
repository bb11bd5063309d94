// Makes clips in which only every n-th frame was measured.
#pragma once

#include <cstddef>

#include "kinemend/take.hpp"

namespace kinemend::quality {

/// A clip in which only every step-th frame was measured. The frames between repeat the one before
/// (`is_held`) or lie on the arc to the next one; then the take ends with a measurement.
inline Take of_lower_rate(Take clip, std::size_t step, bool is_held) {
  if (!is_held) clip = slice(clip, 0, clip.frame_count() - (clip.frame_count() - 1) % step);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const std::size_t before = f - f % step, after = before + step;
    if (f == before) continue;
    const double share = is_held ? 0 : static_cast<double>(f - before) / static_cast<double>(step);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Quat from = clip.rotation(before, j);
      clip.rotation(f, j) = from;
      if (share == 0) continue;
      const Quat to = align_hemisphere(clip.rotation(after, j), from);
      clip.rotation(f, j) = from * exp(share * log(conjugate(from) * to));
    }
  }
  return clip;
}

}  // namespace kinemend::quality
