#pragma once

#include <cstddef>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"

namespace kinemend {

/// What became of every sample of the take's motion (calibration frames left out).
struct Changes {
  std::vector<double> degrees;       ///< F x J
  std::vector<Action> actions;       ///< F x J
  std::vector<double> root;          ///< F, file units
  std::vector<Action> root_actions;  ///< F
};

/// How far frame f goes from its input to the cleaned value, 0..1: the strength, and the range with
/// its slopes. `first_frame` is the number of calibration frames; one weight a frame of motion.
std::vector<double> frame_weights(const CleanSettings& settings, std::size_t frames,
                                  std::size_t first_frame, double frame_rate_hz);

/// Blends `cleaned` (the motion after the cleaner) with the same frames of `input`, in place, and
/// says what changed. Whatever may not change, and whatever hardly did, gets its input value back.
Changes blend_changes(const Clip& input, std::size_t first_frame, const Selection& selection,
                      const CleanSettings& settings, const std::vector<double>& weights,
                      const CleanTrace& trace, Clip& cleaned);

/// Fills in the report's joints, root figures, spans and peak-loss warnings.
void write_report(const Clip& input, std::size_t first_frame, const Clip& cleaned,
                  const Changes& changes, const CleanTrace& trace, const CleanSettings& settings,
                  CleanReport& report);

}  // namespace kinemend
