// What a method makes of a span of a track.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/rotation.hpp"

namespace kinemend::fill {

/// What a method makes of a span of a track.
struct Filling {
  std::vector<Vec3> values = {};  ///< of the span's frames, as the track has them; empty: refused
  std::string method = {};        ///< that made them, or was tried last
  std::string reason = {};        ///< why it was refused
  /// Root mean square distance to the truth, file units or degrees; 0: unknown.
  double expected_error = 0;
  /// Refused for what other tracks lack now; a later round may see more.
  bool may_wait = false;
  /// Made from what other tracks show, so that it tells others something in turn; a curve does not.
  bool is_evidence = true;
  /// Markers whose movement it was made from; empty for a curve, and for joints.
  std::vector<std::size_t> markers_used = {};
  /// Why the model that was asked for has left the gap to `auto`; empty: it was not, or did not.
  std::string left_to_auto = {};

  bool made() const { return !values.empty(); }
  static Filling refused(std::string_view method, std::string reason, bool may_wait = false) {
    return {{}, std::string(method), std::move(reason), 0, may_wait};
  }
};

}  // namespace kinemend::fill
