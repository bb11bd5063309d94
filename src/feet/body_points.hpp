// The points of a body that touch the floor, and its up direction.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend::feet {

/// The height of a body of unknown height, metres (docs/feet.md). Chosen by hand, not swept.
inline constexpr double usual_height_m = 1.7;

/// The points of a foot that touch the floor.
struct Foot {
  std::string name;                 ///< of the joint or marker that represents it
  std::vector<std::size_t> points;  ///< toe, ball, heel: indices into `BodyPoints`
  /// The markers on the heel, and those on the toe and the ball of the foot, by `FootPart`; empty
  /// for joints.
  std::array<std::vector<std::size_t>, 2> parts = {};
};

/// Points of a body in contact with the floor or in flight: F frames of P points, in one unit of
/// length.
struct BodyPoints {
  std::size_t frames = 0;
  std::size_t points = 0;
  double frame_rate_hz = 0;
  std::vector<Vec3> positions;         ///< F x P
  std::vector<std::uint8_t> observed;  ///< F x P; empty means all
  std::vector<Vec3> centres;           ///< F: pelvis, or mean of the markers seen
  std::vector<Foot> feet;
  std::vector<std::size_t> pelvis;  ///< markers on it, if any are recognised
  double height = 0;                ///< of the body

  Vec3 at(std::size_t frame, std::size_t point) const { return positions[frame * points + point]; }
  bool is_observed(std::size_t frame, std::size_t point) const {
    return observed.empty() || observed[frame * points + point] != 0;
  }
};

/// Returns joints with end sites, in metres. Feet are found by names and by their descendants.
BodyPoints body_points(const Take& clip, double metres_per_unit, const KnownNames& names = {});
/// Returns markers, in metres. Feet are found by the names of the marker sets in use (LTOE, RHEE,
/// L_MT5, ...).
BodyPoints body_points(const Take& clip, const std::vector<std::size_t>& markers,
                       double metres_per_unit, const KnownNames& names = {});

/// A direction along an axis.
struct Up {
  Axis axis = Axis::y;
  double sign = 1;

  Vec3 direction() const {
    return {axis == Axis::x ? sign : 0, axis == Axis::y ? sign : 0, axis == Axis::z ? sign : 0};
  }
};
/// Returns the axis along which the body is above its feet; none if that is ambiguous.
std::optional<Up> find_up(const BodyPoints& body);

double along(Vec3 v, Up up);
/// Returns the horizontal component of `v`.
Vec3 level_part(Vec3 v, Up up);

}  // namespace kinemend::feet
