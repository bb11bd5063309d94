// Converts a track of a take to vectors in degrees, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "motion/rotation_chart.hpp"

namespace kinemend {

struct TrackVectors {
  std::vector<Vec3> vectors;           ///< F; gaps are bridged
  std::vector<std::uint8_t> suspects;  ///< F, initial spike candidates; empty: none
  std::optional<RotationChart> chart;  ///< of rotations
};

/// Rotations in their smooth chart, positions by `degrees_per_unit`.
TrackVectors vectors_of(const TakeView& take, std::size_t number);

/// A cleaned track from its vectors: those of all samples if it is smoothed, else those of spikes
/// (F marks). `chart` is that of `vectors_of`, which takes more memory than the vectors; null: it
/// is computed again.
CleanedTrack track_of(const TakeView& take, std::size_t number, std::span<const Vec3> vectors,
                      std::span<const std::uint8_t> spikes, bool smoothed,
                      const RotationChart* chart = nullptr);

}  // namespace kinemend
