// Ground contacts of feet, and flights, for the checks of the body.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "check/checks.hpp"
#include "feet/body_points.hpp"
#include "feet/floor.hpp"
#include "kinemend/check.hpp"

namespace kinemend::check {

using feet::along, feet::body_points, feet::BodyPoints, feet::find_up, feet::Foot, feet::Up;

/// The points of a body, in metres.
struct NamedBody {
  Subject subject;  ///< whose markers they are; empty for joints
  BodyPoints points;
};
/// Returns the joints as one body, or the markers of each subject; none without the scale from
/// `check_unit`.
std::vector<NamedBody> bodies_of(const Rows& rows, const CheckSettings& settings,
                                 const CheckReport& report);

/// Returns the points of a foot, smoothed over 20 ms on either side.
std::vector<feet::SolePoint> sole_points(const BodyPoints& body, const Foot& foot, Up up);

/// A span in which a foot has ground contact.
struct Contact {
  std::size_t foot = 0;
  FrameSpan span;
  double slide_m = 0;  ///< displacement of the point that moves least
  Vec3 place;          ///< median of the foot's lowest points in each frame
};

/// Finds contacts, by foot, then frame. A point touches the floor if it is slow and near its usual
/// standing height; the thresholds to begin are tighter than those to continue (hysteresis).
std::vector<Contact> find_contacts(const BodyPoints& body, Up up);

/// Returns the direction that is up: that of the settings, or else that of the body above its feet.
/// None if that is ambiguous, if the body has no feet, or if it has less than 10 frames.
std::optional<Up> up_of_body(const BodyPoints& body, const CheckSettings& settings);

/// Returns the spans in which every point of every foot is clear of the floor.
std::vector<FrameSpan> find_flights(const BodyPoints& body, Up up);

/// Returns the downward acceleration of the body in a flight, m/s^2: that of the least-squares
/// parabola through the heights of its centre.
double fall(const BodyPoints& body, Up up, const FrameSpan& span);

}  // namespace kinemend::check
