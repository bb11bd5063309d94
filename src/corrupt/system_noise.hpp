#pragma once

#include <span>
#include <string_view>

namespace kinemend::corrupt {

/// The error that a kind of capture system makes, as numbers. Millimetres at markers and positions;
/// joints turn by as many as an arc. Along an axis that is depth to a camera some are multiplied.
/// A value below zero is not given: see `completed`.
struct SystemNoise {
  // Slow: stationary, PSD (1 + (f / fc)^2)^(-slope / 2).
  double std_mm = -1;
  double arm_factor = -1;    ///< times that at arms and hands
  double depth_factor = -1;  ///< times that in depth
  double fc_hz = -1;
  double slope = -1;
  // Floor: the same at rest and in motion.
  double floor_mm = -1;
  double floor_depth_factor = -1;
  double floor_hz = -1;
  // Of slow noise and floor the share of variance that the whole body, and each limb, have in
  // common.
  double correlation = -1;
  double limb_correlation = -1;
  double depth_correlation = -1;
  double depth_limb_correlation = -1;
  // Fast noise in proportion to a track's speed.
  double motion_mm = -1;  ///< standard deviation at 1 m/s
  double motion_depth_factor = -1;
  double motion_hz = -1;
  // Displacements along one axis that show along the others, by a fixed share of each pair of axes.
  double leak = -1;  ///< standard deviation of the share
  double leak_depth_factor = -1;
  // Bursts of single tracks.
  double bursts_per_min = -1;
  double burst_min_s = -1;
  double burst_max_s = -1;
  double burst_min_height = -1;  ///< standard deviations of floor and motion at the moment
  double burst_max_height = -1;
  // Limbs that are wrong as a whole for a while.
  double limb_errors_per_min = -1;
  double limb_error_s = -1;
  double limb_error_mm = -1;
  // Paths of heading and place, standard deviation after a minute.
  double heading_deg = -1;
  double root_mm = -1;
};

/// A number of `SystemNoise` with its range; 0 is the least of all but frequencies and slope.
struct SystemField {
  double SystemNoise::*member;
  const char* name;
  const char* unit;
  double maximum;
  const char* help;
};
std::span<const SystemField> system_fields();

struct SystemFamily {
  std::string_view name;
  std::string_view about;  ///< which systems, and where its numbers come from
  SystemNoise noise;       ///< all of them given
};
std::span<const SystemFamily> system_families();

/// `given` with the family's numbers for those that are not. Errors: `ErrorKind::usage` for numbers
/// that contradict each other: a frequency of zero, a slope of 1 or less, correlations of more than
/// 1 together, bursts that end before they begin.
SystemNoise completed(const SystemNoise& given, const SystemFamily& family);
/// All that is a size multiplied by `strength`.
SystemNoise scaled(SystemNoise noise, double strength);

}  // namespace kinemend::corrupt
