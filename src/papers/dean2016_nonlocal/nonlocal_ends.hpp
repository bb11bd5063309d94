// Extends tracks beyond their ends for the non-local means.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "motion/sample_steps.hpp"
#include "papers/dean2016_nonlocal/nonlocal_filter.hpp"

namespace kinemend {

/// Index of the sample at i, which may be beyond the ends.
inline std::size_t source_index(std::ptrdiff_t i, std::size_t frames, NonlocalBoundary boundary) {
  const auto last = static_cast<std::ptrdiff_t>(frames) - 1;
  if (boundary != NonlocalBoundary::mirror || last == 0) {
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 0, last));
  }
  const std::ptrdiff_t phase = ((i % (2 * last)) + 2 * last) % (2 * last);
  return static_cast<std::size_t>(std::min(phase, 2 * last - phase));
}

/// The least-squares line through the `count` samples at an end, relative to the end sample.
struct EndLine {
  Vec3 value, slope;
};

template <class Track>
EndLine fit_end(const Track& track, bool front, std::size_t count) {
  const std::size_t end = front ? 0 : track.frames - 1;
  const double n = static_cast<double>(count);
  const double middle = (n - 1) / 2;
  Vec3 sum, moment;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 d = difference(track[end], track[front ? i : end - i]);
    sum += d;
    moment += (static_cast<double>(i) - middle) * d;
  }
  const Vec3 slope = count < 2 ? Vec3{} : (12 / (n * (n * n - 1))) * moment;
  return {(1 / n) * sum - middle * slope, slope};
}

/// The track with `pad` samples on either side.
template <class Track>
Track pad_ends(const Track& track, std::size_t pad, const NonlocalSettings& settings) {
  const std::size_t frames = track.frames;
  Track padded(frames + 2 * pad);
  for (std::size_t i = 0; i < padded.frames; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad);
    padded.set(i, track[source_index(from, frames, settings.boundary)]);
  }
  if (settings.boundary != NonlocalBoundary::neumann) return padded;
  const std::size_t count = std::min(frames, 2 * settings.patch_radius + 1);
  for (const bool front : {true, false}) {
    const EndLine line = fit_end(track, front, count);
    for (std::size_t i = 1; i <= pad; ++i) {
      const Vec3 by = line.value - static_cast<double>(i) * line.slope;
      padded.set(front ? pad - i : pad + frames - 1 + i, moved(track[front ? 0 : frames - 1], by));
    }
  }
  return padded;
}

inline std::vector<double> pad_weights(const std::vector<double>& weights, std::size_t frames,
                                       std::size_t pad, NonlocalBoundary boundary) {
  if (weights.empty()) return {};
  std::vector<double> padded(frames + 2 * pad + lane_room);
  for (std::size_t i = 0; i < frames + 2 * pad; ++i) {
    const auto from = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad);
    padded[i] = weights[source_index(from, frames, boundary)];
  }
  return padded;
}

}  // namespace kinemend
