// The numbers that describe the errors of a capture system, and five families of such systems.
#pragma once

#include <span>
#include <string_view>

namespace kinemend::corrupt {

/// The numbers of the error of a kind of capture system, in millimetres at markers and positions;
/// joints turn by arcs of that length. Depth factors apply along the axis that is depth to a
/// camera.
struct SystemNoise {
  // Slow noise: stationary, PSD (1 + (f / fc)^2)^(-slope / 2).
  double std_mm = 0;        ///< standard deviation along each axis
  double arm_factor = 1;    ///< multiplies it at arms and hands
  double depth_factor = 1;  ///< multiplies it in depth
  double fc_hz = 1;         ///< above 0
  double slope = 2;         ///< above 1
  // Floor: equal at rest and in motion; its density falls with the fourth power above its corner.
  double floor_mm = 0;  ///< standard deviation along each axis
  double floor_depth_factor = 1;
  double floor_hz = 100;  ///< above 0
  // Shares of the variance of slow noise and floor that are common to the whole body, and to each
  // limb; together 0 to 1.
  double correlation = 0;
  double limb_correlation = 0;
  double depth_correlation = 0;
  double depth_limb_correlation = 0;
  // Motion noise: fast, proportional to a track's speed, coloured as the floor.
  double motion_mm = 0;  ///< standard deviation at 1 m/s
  double motion_depth_factor = 1;
  double motion_hz = 100;  ///< above 0
  // Leaks: displacements along one axis that appear along the others, by a fixed share for each
  // pair of axes.
  double leak = 0;  ///< standard deviation of the share
  double leak_depth_factor = 1;
  // Bursts: errors of single tracks.
  double bursts_per_min = 0;  ///< for each track
  double burst_min_s = 0.05;
  double burst_max_s = 0.2;
  double burst_min_height = 2;  ///< standard deviations of the current floor and motion noise
  double burst_max_height = 4;
  // Limb errors: whole limbs that are displaced for a while.
  double limb_errors_per_min = 0;  ///< for each limb
  double limb_error_s = 0.3;       ///< mean duration
  double limb_error_mm = 0;        ///< standard deviation; multiplied by `depth_factor` in depth
  // Drift: paths of heading and place, standard deviation after a minute.
  double heading_deg = 0;
  double root_mm = 0;
};

struct SystemFamily {
  std::string_view name;
  std::string_view about;  ///< the systems that it describes
  SystemNoise noise;
};
/// Returns five families; docs/details/noise.md has their numbers as a table, and compares their
/// figures with real ones.
std::span<const SystemFamily> system_families();

/// Returns the noise with all sizes multiplied by `strength`.
SystemNoise scaled(SystemNoise noise, double strength);

}  // namespace kinemend::corrupt
