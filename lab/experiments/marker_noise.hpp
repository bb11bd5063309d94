// Markers of bodies in millimetres, and noise and motion that experiments add to them.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/take.hpp"

namespace kinemend::papers {

struct MarkerNoise {
  std::string name;
  double std_mm;       ///< per axis
  double correlation;  ///< from frame to frame; 0: white
};

inline Take in_millimetres(const Take& clip) {
  const auto unit = guess_length_unit(clip.skeleton);
  return joint_markers(scale_lengths(clip, 1000 * (unit ? unit->metres : 1)));
}

inline Take with_marker_noise(Take clip, const MarkerNoise& noise, std::uint64_t seed) {
  Random random(seed);
  const std::size_t markers = clip.marker_count();
  const double fresh = std::sqrt(1 - noise.correlation * noise.correlation);
  for (std::size_t m = 0; m < markers; ++m) {
    Vec3 error{};
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Vec3 drawn{random.normal(), random.normal(), random.normal()};
      error = f == 0 ? drawn : noise.correlation * error + fresh * drawn;
      clip.positions[f * markers + m] += noise.std_mm * error;
    }
  }
  return clip;
}

/// Root mean square distance, millimetres.
inline double distance_mm(const Take& a, const Take& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Vec3 d = a.positions[i] - b.positions[i];
    square += dot(d, d);
  }
  return std::sqrt(square / static_cast<double>(a.positions.size()));
}

/// Shakes the hand markers up and down by 6 cm for two seconds, from a third of the take on.
inline Take with_shaking_hands(Take still, double frequency_hz) {
  constexpr double size_mm = 60;
  const std::size_t markers = still.marker_count(), first = still.frame_count() / 3,
                    last = first + static_cast<std::size_t>(2 * still.frame_rate_hz);
  for (std::size_t f = first; f < std::min(last, still.frame_count()); ++f) {
    const auto inside = static_cast<double>(std::min(f - first, last - 1 - f));
    const double shake = size_mm * std::min(1.0, inside / (0.2 * still.frame_rate_hz)) *
                         std::sin(2 * std::numbers::pi * frequency_hz * static_cast<double>(f) /
                                  still.frame_rate_hz);
    for (std::size_t m = 0; m < markers; ++m) {
      if (still.names[m].find("Hand") != std::string::npos)
        still.positions[f * markers + m].z += shake;
    }
  }
  return still;
}

}  // namespace kinemend::papers
