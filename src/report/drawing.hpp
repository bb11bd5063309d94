// Holds what the drawings share: colours and letters, and points and bones of poses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend::inks {

inline constexpr std::string_view before = "#d9480f", after = "#0b7285", difference = "#5f3dc4";
inline constexpr std::string_view text = "#343a40", quiet = "#868e96", grid = "#e9ecef";
inline constexpr std::string_view font =
    "font-size=\"13\" font-family=\"system-ui,-apple-system,Segoe "
    "UI,Helvetica,Arial,sans-serif\"";

}  // namespace kinemend::inks

namespace kinemend {

/// Throws `ErrorKind::usage` unless both takes have the same number of frames. `drawing`: its name
/// for the message.
void check_frame_counts(std::string_view drawing, const Take& before, const Take& after);

/// Points of poses (none for a missing one), and the pairs that bones join.
struct Poses {
  std::vector<std::vector<std::optional<Vec3>>> moments;
  std::vector<std::pair<std::size_t, std::size_t>> bones;
};

/// Returns the joints with their end sites, or the markers, at these frames, in the take's unit.
Poses poses_of(const Take& clip, const std::vector<std::size_t>& frames);

/// The range of the added numbers; without numbers `low` is above `high`.
struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return low <= high ? high - low : 0; }
  double middle() const { return low <= high ? (low + high) / 2 : 0; }
};

/// Returns the extent of a pose's points along an axis, 0 to 2; missing points are left out.
Range range_of(const std::vector<std::optional<Vec3>>& points, std::size_t axis);

}  // namespace kinemend
