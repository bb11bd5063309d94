// Chooses the method that fills a joint's gap.
#pragma once

#include <span>
#include <vector>

#include "fill/methods.hpp"

namespace kinemend::fill {

/// What one method makes of a gap of a track.
struct JointProposal {
  const Method* method = nullptr;
  std::vector<Vec3> values = {};  ///< of the span's frames; empty: it cannot fill it
  double score = 0;               ///< least is best
  /// Root mean square distance to the truth, file units or degrees; 0 where the take has no room to
  /// try.
  double expected_error = 0;
};

/// Fills the gap with each of the methods, and spans of the track that are observed
/// (`trial_places`), as if these were gaps of it: at an end of the take where the gap is. A method
/// that cannot fill one of those counts with slerp there.
///
/// Best first. The score is the logarithm of the mean square error to be expected (`Judgement`), in
/// short gaps with favour for the spline. The trials are few, and tell less where there was room
/// for shorter ones only: they count beside four more that went as those methods usually do
/// (`JointRules::usual_errors`).
std::vector<JointProposal> propose(const Track& track, FrameSpan gap,
                                   std::span<const Method* const> methods,
                                   const JointContext& context);

}  // namespace kinemend::fill
