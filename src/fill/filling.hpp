// The result of filling a span of a track by one method.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend::fill {

/// The result of filling a span of a track by one method.
struct Filling {
  std::vector<Vec3> values = {};  ///< of the span's frames, in the track's vectors; empty: refused
  std::string method = {};        ///< the method that made them, or was tried last
  std::string reason = {};        ///< the reason for the refusal
  /// Root mean square distance to the ground truth, file units or degrees; 0: unknown.
  double expected_error = 0;
  /// Refused because other tracks are missing now; a later round may succeed.
  bool may_wait = false;
  /// Made from other tracks, so that it is evidence for them in turn; a curve is not.
  bool is_evidence = true;
  /// Markers whose movement it was made from; empty for a curve, and for joints.
  std::vector<std::size_t> markers_used = {};
  /// The reason why the requested model left the gap to `auto`; empty: no model was requested, or
  /// it filled the gap.
  std::string left_to_auto = {};

  bool made() const { return !values.empty(); }
  static Filling refused(std::string_view method, std::string reason, bool may_wait = false) {
    return {{}, std::string(method), std::move(reason), 0, may_wait};
  }
};

}  // namespace kinemend::fill
