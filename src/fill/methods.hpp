// The table of all ways to fill a gap, and how methods for joints are judged.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fill/curves.hpp"
#include "fill/judgement.hpp"
#include "fill/marker_methods.hpp"
#include "fill/pose_regression.hpp"
#include "kinemend/fill.hpp"

namespace kinemend::fill {

/// What the methods for joints know of the take.
struct JointContext {
  double frame_rate_hz = 0;
  const PoseRegression& poses;
  double height = 0;  ///< of the skeleton, file units

  CurveSettings curve() const { return {.frame_rate_hz = frame_rate_hz}; }
};

/// Lengths for which `JointRules::usual_errors` stand. By definition.
inline constexpr std::array usual_lengths_s = {0.05, 0.1, 0.25, 0.5, 1.0, 2.0};

/// How a method is judged among those for joints. Limits are not swept.
struct JointRules {
  int place = 0;  ///< among them: the order in which they are listed and summed up
  CandidateKind kind = CandidateKind::curve;
  /// Its mean error as a share of slerp's, from gaps made in CMU takes 02_03, 05_02, 05_10, 06_03.
  std::array<double, usual_lengths_s.size()> usual_errors{};
  double longest_s = 0.25;        ///< of a gap between observed samples
  double longest_at_end_s = 0.1;  ///< of one at the start or the end of the take
  bool positions = true;          ///< fills positions too
  std::string_view cannot = "none of its samples is observed";  ///< why, when it could not
};

/// One method: a curve through the track's own samples, or a function for each kind of track. The
/// one for joints writes the span's vectors into the track and says whether it could.
struct Method {
  FillMethod about;
  std::optional<Curve> curve = {};
  bool (*fill_joint)(Track& track, FrameSpan span, const JointContext& context) = nullptr;
  FillMarkerGap fill_marker = nullptr;
  JointRules joint_rules = {};
  LearnedFill FillModels::*model = nullptr;  ///< of a learned method
};

/// All but `auto` that fill joints, by their place.
std::vector<const Method*> joint_methods();
/// Errors: `ErrorKind::usage` for a name that is none of this kind of track.
const Method& find_method(std::string_view name, bool of_joints);
/// Errors: `ErrorKind::usage` for a learned method without its model.
void check_model(const Method& method, const FillModels& models);
/// The model of a learned method; null for any other.
const LearnedFill* model_of(const Method& method, const FillModels& models);

bool fill_joint(const Method& method, Track& track, FrameSpan span, const JointContext& context);
Filling fill_marker(const Method& method, const Samples& samples, const MarkerGap& gap,
                    const MarkerRequest& request);

bool fill_by_squad(Track& track, FrameSpan span, const JointContext& context);
bool fill_joint_by_cycles(Track& track, FrameSpan span, const JointContext& context);
/// By the rotations of the other joints.
bool fill_by_poses(Track& track, FrameSpan span, const JointContext& context);

}  // namespace kinemend::fill
