#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "check/findings.hpp"
#include "kinemend/check.hpp"

namespace kinemend::check {

/// The points of a foot that touch the floor.
struct Foot {
  std::string name;                 ///< of the joint or marker that stands for it
  std::vector<std::size_t> points;  ///< toe, ball, heel: indices into `BodyPoints`
};

/// What stands and falls: F frames of P points, in metres.
struct BodyPoints {
  std::size_t frames = 0;
  std::size_t points = 0;
  double frame_rate_hz = 0;
  std::vector<Vec3> positions;         ///< F x P
  std::vector<std::uint8_t> observed;  ///< F x P; empty means all
  std::vector<Vec3> centres;           ///< F: root, or mean of the markers seen
  std::vector<Foot> feet;
  double height = 0;  ///< of the body

  Vec3 at(std::size_t frame, std::size_t point) const { return positions[frame * points + point]; }
  bool is_observed(std::size_t frame, std::size_t point) const {
    return observed.empty() || observed[frame * points + point] != 0;
  }
};

/// Joints with end sites. Feet are found by names and by what hangs on them.
BodyPoints body_points(const Clip& clip, double metres_per_unit);
/// Markers. Feet are found by the names of the marker sets in use (LTOE, RHEE, L_MT5, ...).
BodyPoints body_points(const MarkerClip& clip, const std::vector<std::size_t>& markers,
                       double metres_per_unit);

/// A direction along an axis.
struct Up {
  Axis axis = Axis::y;
  double sign = 1;
};
/// Where the body stands above its feet; none where no axis is clearly so.
std::optional<Up> find_up(const BodyPoints& body);

/// A time in which a foot stands.
struct Contact {
  std::size_t foot = 0;
  Span span;
  double slide_m = 0;  ///< how far the point that moves least has travelled from where it was
  Vec3 place;          ///< of its lowest points, on the whole
};

/// A point touches the floor where it is as low as where it stands as a rule and slow; thresholds
/// to begin are tighter than those to go on (hysteresis). By foot, then frame.
std::vector<Contact> find_contacts(const BodyPoints& body, Up up);

/// How deep each foot stands below the floor, metres; negative above it. The floor is the plane
/// (level where the contacts are few) that most contacts lie on, so that a tilted calibration is no
/// fault of a foot. Empty where less than two thirds of them lie within 2 cm of it: stairs,
/// climbing.
std::vector<double> depths_below_floor(const std::vector<Contact>& contacts, Up up);

/// Spans in which every point of every foot is clear of the floor.
std::vector<Span> find_flights(const BodyPoints& body, Up up);

double along(Vec3 v, Up up);

}  // namespace kinemend::check
