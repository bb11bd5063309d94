#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fill/joint_methods.hpp"

namespace kinemend::fill {

/// How well a method fills a track where it is observed.
struct Trial {
  const JointMethod* method = nullptr;
  double error = 0;       ///< mean distance to what was observed, in the track's unit
  std::size_t spans = 0;  ///< that the method filled
  double score = 0;       ///< least is best
};

/// Hides up to `most` spans of `length` frames, spread evenly over what is observed of the track,
/// and fills them with each of the methods; `at_end`: as if the take ended with each of them. Spans
/// that a method cannot fill count with the mean error of the others. Shorter spans where there is
/// no room for that length, the errors then growing with the length; no spans where there is no
/// room at all.
///
/// Best first by a score, the mean logarithm of the error beside slerp's. The trials are few, so
/// they count beside six more that went as those methods usually do
/// (`JointMethod::usual_errors`).
std::vector<Trial> try_methods(const JointTrack& track, std::size_t length, bool at_end,
                               std::span<const JointMethod* const> methods,
                               const JointContext& context, std::size_t most = 8);

}  // namespace kinemend::fill
