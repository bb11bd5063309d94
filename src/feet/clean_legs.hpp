// Cleans the legs of a motion within given limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kinemend/feet.hpp"

namespace kinemend::feet {

// Lengths by which floors are judged, in body heights. Chosen by hand, not swept; the height is
// that of docs/feet.md.
inline constexpr double usual_height_m = 1.7;    ///< converts metres
inline constexpr double close_to_floor = 0.012;  ///< 2 cm

/// The tracks that may change, and the state of the take.
struct FeetLimits {
  std::vector<std::uint8_t> joints;  ///< J; empty: all
  bool root_position = true;
  bool translations = true;
  bool is_noisy = false;  ///< noise was found in the joints; it also moves sliding feet
};

/// Implements `clean_feet` for a clip in which every frame is motion. Frames of settings and report
/// count from the first frame of the motion.
FeetReport clean_legs(Take& motion, const FeetSettings& settings, const FeetLimits& limits = {});

/// Renumbers contacts counted from frame `from` to count from frame `to`. Throws `ErrorKind::usage`
/// for one that begins before `from`.
void shift_contacts(std::vector<FootContact>& contacts, std::size_t from, std::size_t to);

}  // namespace kinemend::feet
