// A take of markers: one of the two kinds of a take.
#pragma once

#include "kinemend/take.hpp"

namespace kinemend {

/// A take of markers.
struct MarkerClip : Take {
  MarkerClip() = default;
  MarkerClip(Take&& take) : Take(std::move(take)) {}
};

/// A clip of `frames` frames in which every sample is missing and every point is a position.
Take make_marker_clip(std::vector<std::string> names, std::size_t frames, double frame_rate_hz);

/// An estimate of the person's height in file units: 4.2 times the lower quartile of the distances
/// between any two markers of a frame, over at most 64 frames. It does not depend on position,
/// heading or the order of the markers; pose, outliers, props and a second person have little
/// effect. Where the unit is known the result is at most 2.2 m. Where no frame has two markers it
/// is 1.75 m, or 1 if the unit is unknown.
double body_height(const Take& clip);

/// Metres in a unit, by its usual names ("mm", "m", "cm", "in", "inches", ...); 0 for other names.
double metres_per_unit(std::string_view unit);

/// The name without its subject: `LASI` for `Ann:LASI`.
std::string_view without_subject(std::string_view name);

}  // namespace kinemend
