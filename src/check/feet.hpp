// Feet of a take in metres, their contacts with the floor, and flights, for the checks of the body.
#pragma once

#include <cstddef>
#include <vector>

#include "check/checks.hpp"
#include "feet/body_points.hpp"
#include "kinemend/check.hpp"

namespace kinemend::check {

using feet::along, feet::BodyPoints, feet::find_up, feet::Foot, feet::Up;

/// Joints with end sites, in metres. Feet are found by names and by their descendants.
BodyPoints body_points(const Take& clip, double metres_per_unit, const KnownNames& names = {});
/// Markers, in metres. Feet are found by the names of the marker sets in use (LTOE, RHEE, L_MT5,
/// ...).
BodyPoints body_points(const Take& clip, const std::vector<std::size_t>& markers,
                       double metres_per_unit, const KnownNames& names = {});

/// A span in which a foot stands.
struct Contact {
  std::size_t foot = 0;
  FrameSpan span;
  double slide_m = 0;  ///< displacement of the point that moves least
  Vec3 place;          ///< mean of its lowest points
};

/// A point touches the floor where it is slow and near its usual standing height; thresholds to
/// begin are tighter than those to continue (hysteresis). By foot, then frame.
std::vector<Contact> find_contacts(const BodyPoints& body, Up up);

/// Spans in which every point of every foot is clear of the floor.
std::vector<FrameSpan> find_flights(const BodyPoints& body, Up up);

}  // namespace kinemend::check
