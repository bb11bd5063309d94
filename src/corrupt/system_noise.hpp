// The numbers that describe the errors of a capture system, and five families of such systems.
#pragma once

#include <span>
#include <string_view>

namespace kinemend::corrupt {

/// The error that a kind of capture system makes, as numbers. Millimetres at markers and positions;
/// joints turn by as many as an arc. Along an axis that is depth to a camera some are multiplied.
struct SystemNoise {
  // Slow: stationary, PSD (1 + (f / fc)^2)^(-slope / 2).
  double std_mm = 0;        ///< standard deviation along each axis
  double arm_factor = 1;    ///< times that at arms and hands
  double depth_factor = 1;  ///< times that in depth
  double fc_hz = 1;         ///< above 0
  double slope = 2;         ///< above 1
  // Floor: the same at rest and in motion; its density falls with the fourth power above its
  // corner.
  double floor_mm = 0;  ///< standard deviation along each axis
  double floor_depth_factor = 1;
  double floor_hz = 100;  ///< above 0
  // Of slow noise and floor the share of variance that the whole body, and each limb besides, have
  // in common: 0 to 1 together.
  double correlation = 0;
  double limb_correlation = 0;
  double depth_correlation = 0;
  double depth_limb_correlation = 0;
  // Fast noise in proportion to a track's speed, coloured as the floor.
  double motion_mm = 0;  ///< standard deviation at 1 m/s
  double motion_depth_factor = 1;
  double motion_hz = 100;  ///< above 0
  // Displacements along one axis that show along the others, by a fixed share of each pair of axes.
  double leak = 0;  ///< standard deviation of the share
  double leak_depth_factor = 1;
  // Bursts of single tracks.
  double bursts_per_min = 0;  ///< of each track
  double burst_min_s = 0.05;
  double burst_max_s = 0.2;
  double burst_min_height = 2;  ///< standard deviations of floor and motion at the moment
  double burst_max_height = 4;
  // Limbs that are wrong as a whole for a while.
  double limb_errors_per_min = 0;  ///< of each limb
  double limb_error_s = 0.3;       ///< mean duration
  double limb_error_mm = 0;        ///< standard deviation; times `depth_factor` in depth
  // Paths of heading and place, standard deviation after a minute.
  double heading_deg = 0;
  double root_mm = 0;
};

struct SystemFamily {
  std::string_view name;
  std::string_view about;  ///< which systems
  SystemNoise noise;
};
/// Five families; docs/noise.md has their numbers as a table, and their figures beside real ones.
std::span<const SystemFamily> system_families();

/// All that is a size multiplied by `strength`.
SystemNoise scaled(SystemNoise noise, double strength);

}  // namespace kinemend::corrupt
