// The tables of joint angles over the stride.
#include "lab/synthesis/gait_data.hpp"

namespace kinemend::synth {

namespace {

// clang-format off
constexpr double walk_hip[] = {33, 31.5, 28.5, 24.5, 19.5, 14, 8.5, 3, -2, -6.5,
                               -9.5, -9, -3, 7.5, 18, 26, 31.5, 34.5, 35, 34};
constexpr double walk_knee[] = {5.5, 12.7, 18.9, 19.3, 16.9, 13.9, 10.8, 8.3, 6.8, 7.5,
                                11.6, 20.3, 34.1, 49.8, 59.4, 59.2, 50.8, 36.2, 19.0, 5.9};
constexpr double walk_ankle[] = {-0.5, -4.5, -2.5, 1.5, 4.5, 6.5, 8.2, 9.8, 11.2, 11.8,
                                 9.5, 2, -11, -17, -12, -5, -0.5, 2, 2.3, 1};

constexpr double run_hip[] = {42, 40, 36, 29, 21, 13, 5, -2, -6, -4,
                              4, 15, 26, 36, 44, 50, 53, 53, 50, 46};
constexpr double run_knee[] = {15, 28, 39, 43, 40, 33, 26, 25, 31, 44,
                               58, 78, 94, 101, 98, 85, 66, 43, 24, 13};
constexpr double run_ankle[] = {6, 9, 17, 22, 23, 18, 6, -10, -17, -14,
                                -8, -3, 0, 2, 4, 5, 5, 5, 6, 7};
// clang-format on

constexpr GaitData walking{
    .hip = walk_hip,
    .knee = walk_knee,
    .ankle = walk_ankle,
    .stride_s = 1.10,
    .stance = 0.60,
    .flat_from = 0.085,
    .flat_to = 0.34,
    .heel_off_done = 0.46,
    .pelvis_tilt = 10,
    .pelvis_tilt_swing = 1.2,
    .pelvis_obliquity = 4.2,
    .pelvis_rotation = 4.5,
    .pelvis_sway_cm = 2.0,
    .trunk_lean = 2,
    .trunk_rotation = 4,
    .shoulder_mean = -5,
    .shoulder_swing = 17,
    .elbow_mean = 28,
    .elbow_swing = 12,
    .longest_leg = 0.998,
    .step_width_cm = 10,
    .clearance_cm = 3,
    .arm_abduction = 8,
};

constexpr GaitData running{
    .hip = run_hip,
    .knee = run_knee,
    .ankle = run_ankle,
    .stride_s = 0.71,
    .stance = 0.35,
    .flat_from = 0.05,
    .flat_to = 0.15,
    .heel_off_done = 0.27,
    .pelvis_tilt = 16,
    .pelvis_tilt_swing = 2,
    .pelvis_obliquity = 6,
    .pelvis_rotation = 6,
    .pelvis_sway_cm = 1.2,
    .trunk_lean = 8,
    .trunk_rotation = 10,
    .shoulder_mean = -12,
    .shoulder_swing = 32,
    .elbow_mean = 92,
    .elbow_swing = 16,
    .longest_leg = 0.995,
    .step_width_cm = 4,
    .clearance_cm = 0,
    .arm_abduction = 14,
};

}  // namespace

const GaitData& walk_data() { return walking; }
const GaitData& run_data() { return running; }

}  // namespace kinemend::synth
