// The frame of a body of markers, found from the markers that keep their distances (anchors).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/extend/body.hpp"

namespace kinemend::representation {

/// With fewer points a body's rotation is unknown. By definition.
inline constexpr std::size_t least_anchors = 3;

/// A marker's observed position and its position in the body's shape; any axes, one unit.
struct Anchor {
  Vec3 seen, expected;
};

/// A rigid fit: seen = rotation (expected - expected_centre) + seen_centre.
struct RigidFit {
  Quat rotation;
  Vec3 expected_centre, seen_centre;
  double spread = 0;  ///< summed squared distances of the expected anchors from their centre

  Vec3 seen_at(Vec3 expected) const {
    return rotate(rotation, expected - expected_centre) + seen_centre;
  }
  Vec3 expected_at(Vec3 seen) const {
    return rotate(conjugate(rotation), seen - seen_centre) + expected_centre;
  }
};
/// Fits by least squares (Horn 1987) without outlier anchors. Returns none for fewer than three
/// anchors, or if all are at one point.
std::optional<RigidFit> fit_rigidly(std::vector<Anchor> anchors, double body_height);

/// Returns the fit of the layout's shape to the anchors seen in a frame, in file units and upright
/// axes.
std::optional<RigidFit> fit_frame(const Take& clip, const BodyLayout& layout,
                                  const BodyMatch& match, std::size_t frame);

/// Writes headings and places of the channels from the anchors. `floor`: height of the floor.
void follow_anchors(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    double floor, BodyChannels& channels);

/// Returns the height of the floor in upright axes, the level to which the feet keep returning.
double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match);

/// Returns the low level of the lowest of some markers, smoothed over a tenth of a second; 0 if
/// none of them is ever seen.
double low_level(const Take& clip, Quat upright, std::span<const std::int32_t> markers);

/// Returns a marker's position in upright axes.
inline Vec3 upright_position(const Take& clip, Quat upright, std::size_t frame,
                             std::size_t marker) {
  return rotate(upright, clip.position(frame, marker));
}

/// A turn about y, which costs half as much as a quaternion.
class TurnAboutY {
 public:
  explicit TurnAboutY(double angle);
  Vec3 operator()(Vec3 v) const {
    return {cosine_ * v.x + sine_ * v.z, v.y, cosine_ * v.z - sine_ * v.x};
  }
  Vec3 back(Vec3 v) const {
    return {cosine_ * v.x - sine_ * v.z, v.y, cosine_ * v.z + sine_ * v.x};
  }

 private:
  double cosine_, sine_;
};

}  // namespace kinemend::representation
