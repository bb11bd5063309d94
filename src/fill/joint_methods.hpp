#pragma once

#include <array>
#include <span>
#include <string_view>

#include "fill/joint_track.hpp"
#include "fill/pose_regression.hpp"

// The ways to fill a gap of one joint.
namespace kinemend::fill {

/// What the methods know of the take.
struct JointContext {
  double frame_rate_hz = 0;
  const PoseRegression& poses;
  double height = 0;  ///< of the skeleton, file units

  CurveSettings curve() const { return {.frame_rate_hz = frame_rate_hz}; }
};

/// Lengths for which `JointMethod::usual_errors` stand.
inline constexpr std::array usual_lengths_s = {0.05, 0.1, 0.25, 0.5, 1.0, 2.0};

/// One method. `fill` writes the span's vectors into the track and says whether it could;
/// `longest_s` is the rule of how long a gap between observed samples may be, `longest_at_end_s` of
/// one at the start or the end of the take.
struct JointMethod {
  std::string_view name;
  double longest_s = 0;
  double longest_at_end_s = 0;
  bool positions = true;  ///< fills positions too
  bool (*fill)(JointTrack& track, FrameSpan span, const JointContext& context) = nullptr;
  std::string_view cannot;  ///< why, when it could not
  /// Its mean error as a share of slerp's, from gaps made in CMU takes 02_03, 05_02, 05_10, 06_03.
  std::array<double, usual_lengths_s.size()> usual_errors{};
};

/// All but `auto`; nullptr for a name that is none of joints.
std::span<const JointMethod> joint_methods();
const JointMethod* find_joint_method(std::string_view name);

}  // namespace kinemend::fill
