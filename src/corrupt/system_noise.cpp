#include "corrupt/system_noise.hpp"

#include <fmt/format.h>

#include <array>

#include "kinemend/error.hpp"

namespace kinemend::corrupt {

std::span<const SystemField> system_fields() {
  using S = SystemNoise;
  static constexpr std::array<SystemField, 27> fields{{
      {&S::std_mm, "std_mm", "mm", 1e4, "slow noise, standard deviation along each axis"},
      {&S::arm_factor, "arm_factor", "", 100, "times that at arms and hands, told by their names"},
      {&S::depth_factor, "depth_factor", "", 100, "times that in depth"},
      {&S::fc_hz, "fc_hz", "Hz", 100, "its corner: PSD (1 + (f/fc)^2)^(-slope/2)"},
      {&S::slope, "slope", "", 12, "how steeply that falls; above 1"},
      {&S::floor_mm, "floor_mm", "mm", 1e4, "fast noise at rest, standard deviation"},
      {&S::floor_depth_factor, "floor_depth_factor", "", 100, "times that in depth"},
      {&S::floor_hz, "floor_hz", "Hz", 1e4, "its corner; it falls with the fourth power above"},
      {&S::correlation, "correlation", "", 1,
       "share of slow and fast variance that the whole body has in common"},
      {&S::limb_correlation, "limb_correlation", "", 1, "the share that each limb has besides"},
      {&S::depth_correlation, "depth_correlation", "", 1, "correlation in depth"},
      {&S::depth_limb_correlation, "depth_limb_correlation", "", 1, "limb_correlation in depth"},
      {&S::motion_mm, "motion_mm", "mm", 1e4, "fast noise for each m/s of speed"},
      {&S::motion_depth_factor, "motion_depth_factor", "", 100, "times that in depth"},
      {&S::motion_hz, "motion_hz", "Hz", 1e4, "its corner; it falls with the fourth power above"},
      {&S::leak, "leak", "", 10,
       "share of a displacement along one axis that shows along another, standard deviation"},
      {&S::leak_depth_factor, "leak_depth_factor", "", 100, "times that in depth"},
      {&S::bursts_per_min, "bursts_per_min", "", 1e4, "bursts of each joint or marker a minute"},
      {&S::burst_min_s, "burst_min_s", "s", 100, "shortest burst"},
      {&S::burst_max_s, "burst_max_s", "s", 100, "longest burst"},
      {&S::burst_min_height, "burst_min_height", "", 1e4,
       "height of the lowest, in deviations of the fast noise"},
      {&S::burst_max_height, "burst_max_height", "", 1e4, "height of the highest"},
      {&S::limb_errors_per_min, "limb_errors_per_min", "", 1e4,
       "how often a limb is wrong as a whole, a minute and limb"},
      {&S::limb_error_s, "limb_error_s", "s", 1e4, "for how long, on average"},
      {&S::limb_error_mm, "limb_error_mm", "mm", 1e5,
       "by how much, standard deviation; times depth_factor in depth"},
      {&S::heading_deg, "heading_deg", "deg", 360, "drift of the heading in a minute"},
      {&S::root_mm, "root_mm", "mm", 1e6, "drift of the place on the floor in a minute"},
  }};
  return fields;
}

std::span<const SystemFamily> system_families() {
  // Measured by bench/papers/system_noise.cpp; docs/noise.md has the figures beside real ones.
  static constexpr std::array<SystemFamily, 5> families{{
      {"video",
       "a person tracked in the image of one camera, 30 to 60 Hz",
       {.std_mm = 5,
        .arm_factor = 2.4,
        .depth_factor = 3.2,
        .fc_hz = 0.55,
        .slope = 2.6,
        .floor_mm = 0.8,
        .floor_depth_factor = 7.6,
        .floor_hz = 40,
        .correlation = 0.05,
        .limb_correlation = 0.1,
        .depth_correlation = 0.2,
        .depth_limb_correlation = 0.35,
        .motion_mm = 12,
        .motion_depth_factor = 2.2,
        .motion_hz = 5.3,
        .leak = 0.06,
        .leak_depth_factor = 2,
        .bursts_per_min = 25,
        .burst_min_s = 0.05,
        .burst_max_s = 0.2,
        .burst_min_height = 2,
        .burst_max_height = 4,
        .limb_errors_per_min = 0,
        .limb_error_s = 0.5,
        .limb_error_mm = 0,
        .heading_deg = 0,
        .root_mm = 0}},
      {"triangulated",
       "points seen by several cameras and triangulated, raw",
       {.std_mm = 4,
        .arm_factor = 1,
        .depth_factor = 2.4,
        .fc_hz = 1,
        .slope = 2,
        .floor_mm = 8.3,
        .floor_depth_factor = 2.2,
        .floor_hz = 100,
        .correlation = 0,
        .limb_correlation = 0.1,
        .depth_correlation = 0,
        .depth_limb_correlation = 0.1,
        .motion_mm = 0,
        .motion_depth_factor = 1,
        .motion_hz = 100,
        .leak = 0,
        .leak_depth_factor = 1,
        .bursts_per_min = 30,
        .burst_min_s = 0.02,
        .burst_max_s = 0.06,
        .burst_min_height = 4,
        .burst_max_height = 10,
        .limb_errors_per_min = 3,
        .limb_error_s = 0.3,
        .limb_error_mm = 25,
        .heading_deg = 0,
        .root_mm = 0}},
      {"depth",
       "a depth camera's skeleton, 30 Hz",
       {.std_mm = 14,
        .arm_factor = 3.9,
        .depth_factor = 1.2,
        .fc_hz = 0.35,
        .slope = 2.3,
        .floor_mm = 0.4,
        .floor_depth_factor = 1,
        .floor_hz = 30,
        .correlation = 0.05,
        .limb_correlation = 0.4,
        .depth_correlation = 0.1,
        .depth_limb_correlation = 0.4,
        .motion_mm = 18,
        .motion_depth_factor = 1,
        .motion_hz = 9.8,
        .leak = 0,
        .leak_depth_factor = 1,
        .bursts_per_min = 20,
        .burst_min_s = 0.05,
        .burst_max_s = 0.2,
        .burst_min_height = 2,
        .burst_max_height = 4,
        .limb_errors_per_min = 11,
        .limb_error_s = 0.4,
        .limb_error_mm = 75,
        .heading_deg = 0,
        .root_mm = 0}},
      {"inertial",
       "an inertial suit, angles of joints",
       {.std_mm = 35,
        .arm_factor = 1,
        .depth_factor = 1,
        .fc_hz = 1.4,
        .slope = 4.3,
        .floor_mm = 0,
        .floor_depth_factor = 1,
        .floor_hz = 20,
        .correlation = 0.2,
        .limb_correlation = 0.2,
        .depth_correlation = 0.2,
        .depth_limb_correlation = 0.2,
        .motion_mm = 0,
        .motion_depth_factor = 1,
        .motion_hz = 20,
        .leak = 0,
        .leak_depth_factor = 1,
        .bursts_per_min = 0,
        .burst_min_s = 0.05,
        .burst_max_s = 0.2,
        .burst_min_height = 2,
        .burst_max_height = 4,
        .limb_errors_per_min = 0,
        .limb_error_s = 1,
        .limb_error_mm = 0,
        .heading_deg = 8,
        .root_mm = 300}},
      {"optical",
       "reflective markers, well calibrated, before any filter",
       {.std_mm = 0.2,
        .arm_factor = 1,
        .depth_factor = 1,
        .fc_hz = 0.5,
        .slope = 2,
        .floor_mm = 0.15,
        .floor_depth_factor = 1,
        .floor_hz = 200,
        .correlation = 0,
        .limb_correlation = 0.1,
        .depth_correlation = 0,
        .depth_limb_correlation = 0.1,
        .motion_mm = 0.1,
        .motion_depth_factor = 1,
        .motion_hz = 200,
        .leak = 0,
        .leak_depth_factor = 1,
        .bursts_per_min = 2,
        .burst_min_s = 0.02,
        .burst_max_s = 0.1,
        .burst_min_height = 5,
        .burst_max_height = 20,
        .limb_errors_per_min = 0,
        .limb_error_s = 0.3,
        .limb_error_mm = 0,
        .heading_deg = 0,
        .root_mm = 0}},
  }};
  return families;
}

namespace {

void check(const SystemNoise& noise) {
  const auto refuse = [](const std::string& text) { throw Error(ErrorKind::usage, text); };
  if (!(noise.fc_hz > 0)) refuse("fc_hz: must be above 0 Hz");
  if (!(noise.floor_hz > 0)) refuse("floor_hz: must be above 0 Hz");
  if (!(noise.motion_hz > 0)) refuse("motion_hz: must be above 0 Hz");
  if (!(noise.slope > 1)) refuse(fmt::format("slope: {:g} is not above 1", noise.slope));
  if (noise.correlation + noise.limb_correlation > 1 + 1e-12)
    refuse("correlation and limb_correlation are more than 1 together");
  if (noise.depth_correlation + noise.depth_limb_correlation > 1 + 1e-12)
    refuse("depth_correlation and depth_limb_correlation are more than 1 together");
  if (noise.burst_max_s < noise.burst_min_s) refuse("burst_max_s is below burst_min_s");
  if (noise.burst_max_height < noise.burst_min_height)
    refuse("burst_max_height is below burst_min_height");
}

}  // namespace

SystemNoise completed(const SystemNoise& given, const SystemFamily& family) {
  SystemNoise noise = given;
  for (const SystemField& field : system_fields()) {
    if (noise.*field.member < 0) noise.*field.member = family.noise.*field.member;
  }
  check(noise);
  return noise;
}

SystemNoise scaled(SystemNoise noise, double strength) {
  for (double SystemNoise::*const size :
       {&SystemNoise::std_mm, &SystemNoise::floor_mm, &SystemNoise::motion_mm, &SystemNoise::leak,
        &SystemNoise::limb_error_mm, &SystemNoise::heading_deg, &SystemNoise::root_mm})
    noise.*size *= strength;
  return noise;
}

}  // namespace kinemend::corrupt
