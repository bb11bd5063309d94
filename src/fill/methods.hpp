// The table of all ways to fill a gap, the rules by which methods for joints are judged, and the
// functions that fill a gap of one marker.
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fill/curves.hpp"
#include "fill/judgement.hpp"
#include "fill/regression.hpp"
#include "fill/samples.hpp"
#include "fill/track.hpp"
#include "kinemend/fill.hpp"

namespace kinemend::fill {

struct Method;

/// The request for one gap, from the settings of a run or a row of a plan.
struct GapRequest {
  const Method* method = nullptr;
  std::size_t donor = no_marker;            ///< used by `pattern`
  double longest_gap_s = 0;                 ///< 0: the limit of the method's rules
  bool fill_all = false;                    ///< also fills gaps that the rules refuse
  double max_error = 0, max_error_deg = 0;  ///< as `FillSettings`; 0: no limit
  bool unlabelled = false;                  ///< unlabelled markers are evidence
  std::optional<Filling> refusal = {};      ///< set if the gap must stay open, whatever the method
  const LearnedFill* learned = nullptr;     ///< for a learned method

  static constexpr std::size_t no_marker = std::numeric_limits<std::size_t>::max();
};

using FillMarkerGap = Filling (*)(const Samples& samples, const MarkerGap& gap,
                                  const GapRequest& request);

Filling fill_by_pattern(const Samples& samples, const MarkerGap& gap, const GapRequest& request);
Filling fill_by_rigid_body(const Samples& samples, const MarkerGap& gap, const GapRequest& request);
Filling fill_by_pca(const Samples& samples, const MarkerGap& gap, const GapRequest& request);
Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap,
                                 const GapRequest& request);
Filling fill_marker_by_cycles(const Samples& samples, const MarkerGap& gap,
                              const GapRequest& request);
Filling fill_by_auto(const Samples& samples, const MarkerGap& gap, const GapRequest& request);
/// The longest gap that a curve fills by its own rule, and in which `auto` tries one. Not swept.
inline constexpr double longest_curve_s = 0.25;
/// Fills by a curve through the marker's own samples; `name` is the method's.
Filling fill_by_curve(const Samples& samples, const MarkerGap& gap, const GapRequest& request,
                      Curve curve, std::string_view name);

/// Returns the curve through the marker's own samples at the span's frames; empty if it has none.
std::vector<Vec3> curve_positions(const Samples& samples, const MarkerGap& gap, Curve curve);

/// Markers of one segment keep their distance to within this share of the body's radius (standard
/// deviation). Chosen on the takes that docs/measured/fill.md names.
inline constexpr double segment_spread = 0.02;
/// The number of other markers that a regression needs to know the body's rotation.
inline constexpr std::size_t least_companions = 3;

/// The data of the take that the methods for joints use.
struct JointContext {
  double frame_rate_hz = 0;
  const PoseRegression& poses;
  double height = 0;  ///< of the skeleton, file units

  CurveSettings curve() const { return {.frame_rate_hz = frame_rate_hz}; }
};

/// The lengths to which the entries of `JointRules::usual_errors` belong. By definition.
inline constexpr std::array usual_lengths_s = {0.05, 0.1, 0.25, 0.5, 1.0, 2.0};

/// The rules by which a method for joints is judged. Limits are not swept.
struct JointRules {
  int place = 0;  ///< the order in which methods are listed and summed
  CandidateKind kind = CandidateKind::curve;
  /// The method's mean error relative to slerp's, from artificial gaps in CMU takes 02_03, 05_02,
  /// 05_10, 06_03.
  std::array<double, usual_lengths_s.size()> usual_errors{};
  double longest_s = 0.25;        ///< for a gap between observed samples
  double longest_at_end_s = 0.1;  ///< for a gap at the start or the end of the take
  bool positions = true;          ///< fills positions too
  std::string_view cannot = "none of its samples is observed";  ///< if it cannot fill a gap
};

/// One method: a curve through the track's own samples, or a function for each kind of track. The
/// function for joints writes the span's vectors into the track and returns whether it could.
struct Method {
  FillMethod about;
  std::optional<Curve> curve = {};
  bool (*fill_joint)(Track& track, FrameSpan span, const JointContext& context) = nullptr;
  FillMarkerGap fill_marker = nullptr;
  JointRules joint_rules = {};
  LearnedFill FillModels::*model = nullptr;  ///< of a learned method, else null
};

/// Returns all methods that fill joints except `auto`, by their place.
std::vector<const Method*> joint_methods();
/// Throws `ErrorKind::usage` if no method for this kind of track has the name.
const Method& find_method(std::string_view name, bool of_joints);
/// Throws `ErrorKind::usage` for a learned method without its model.
void check_model(const Method& method, const FillModels& models);
/// Returns the model of a learned method, or null for any other.
const LearnedFill* model_of(const Method& method, const FillModels& models);

bool fill_joint(const Method& method, Track& track, FrameSpan span, const JointContext& context);
Filling fill_marker(const Method& method, const Samples& samples, const MarkerGap& gap,
                    const GapRequest& request);

bool fill_by_squad(Track& track, FrameSpan span, const JointContext& context);
bool fill_joint_by_cycles(Track& track, FrameSpan span, const JointContext& context);
/// Fills by regression on the rotations of the other joints.
bool fill_by_poses(Track& track, FrameSpan span, const JointContext& context);

}  // namespace kinemend::fill
