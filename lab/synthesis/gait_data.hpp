// Published joint angles and measures of walking and running.
#pragma once

#include <span>

namespace kinemend::synth {

/// Mean joint angles of a gait at every 5 % of the stride, from one contact of a foot to its next,
/// and related measures. Degrees; flexion, dorsiflexion and forward lean are positive.
struct GaitData {
  std::span<const double> hip, knee, ankle;
  double stride_s;            ///< time of one stride
  double stance;              ///< share of the stride in which a foot is on the ground
  double flat_from, flat_to;  ///< phases between which the whole sole is on the ground
  double heel_off_done;       ///< phase by which the foot turns about its ball as the angles give
  double pelvis_tilt, pelvis_tilt_swing;
  double pelvis_obliquity, pelvis_rotation;  ///< amplitudes
  double pelvis_sway_cm;
  double trunk_lean, trunk_rotation;  ///< mean lean; amplitude against the pelvis
  double shoulder_mean, shoulder_swing, elbow_mean, elbow_swing;
  double longest_leg;  ///< largest stretch relative to its length, which keeps the knee bent
  double step_width_cm;
  double clearance_cm;  ///< by which the swinging foot is raised
  double arm_abduction;
};

/// Walking at a free speed.
/// Knee: mean curve of Schwartz, Rozumalski and Trost, J. Biomech. 41 (2008) 1639-1650. Hip and
/// ankle: after the mean curves of Kadaba, Ramakrishnan and Wootten, J. Orthop. Res. 8 (1990)
/// 383-392, and Perry and Burnfield, Gait Analysis, 2nd ed. (2010), ch. 4: their key values,
/// tabulated by hand, as are pelvis and trunk. Arms: Murray, Sepic and Barnard, Phys. Ther. 47
/// (1967) 272-284. Stride time and stance: Winter, Biomechanics and Motor Control of Human Gait
/// (1991).
const GaitData& walk_data();

/// Running at about 3.2 m/s, after the mean curves of Novacheck, Gait and Posture 7 (1998) 77-95,
/// key values tabulated by hand and shifted by up to 7 degrees so that stance and flight agree;
/// arms after Hinrichs, Int. J. Sport Biomech. 3 (1987) 222-241.
const GaitData& run_data();

}  // namespace kinemend::synth
