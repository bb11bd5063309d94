// Chooses the method that fills a joint's gap.
#pragma once

#include <span>
#include <vector>

#include "fill/methods.hpp"

namespace kinemend::fill {

/// One method's proposal for a gap of a track.
struct JointProposal {
  const Method* method = nullptr;
  std::vector<Vec3> values = {};  ///< of the span's frames; empty: the method cannot fill it
  double score = 0;               ///< least is best
  /// Root mean square distance to the ground truth, file units or degrees; 0 if the take has no
  /// observed span for a trial.
  double expected_error = 0;
};

/// Fills the gap with each of the methods, and fills observed spans of the track (`trial_places`)
/// as if they were gaps, at an end of the take if the gap is at one. In a trial that a method
/// cannot fill, slerp's result is used.
///
/// Returns the best first. The score is the logarithm of the expected mean square error
/// (`Judgement`), with a bonus for the spline in short gaps. There are few trials, and shorter ones
/// say less: they are averaged with four more that have the methods' usual errors
/// (`JointRules::usual_errors`).
std::vector<JointProposal> propose(const Track& track, FrameSpan gap,
                                   std::span<const Method* const> methods,
                                   const JointContext& context);

}  // namespace kinemend::fill
