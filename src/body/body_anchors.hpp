// The frame of a body of markers, found from the markers that keep their distances (anchors).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// Fewer points do not tell how a body is turned. By definition.
inline constexpr std::size_t least_anchors = 3;

/// A marker where it is seen, and where it is in the body's shape; any axes and one unit.
struct Anchor {
  Vec3 seen, expected;
};

/// seen = rotation (expected - expected_centre) + seen_centre
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
/// Least squares (Horn 1987); anchors that lie far off where the others say are left out. None for
/// fewer than three, or where all are at one spot.
std::optional<RigidFit> fit_rigidly(std::vector<Anchor> anchors, double body_height);

/// The fit of the layout's shape to the anchors seen in a frame, file units, upright axes.
std::optional<RigidFit> fit_frame(const Take& clip, const BodyLayout& layout,
                                  const BodyMatch& match, std::size_t frame);

/// Headings and places of the channels, from the anchors. `floor`: height of the floor.
void follow_anchors(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    double floor, BodyChannels& channels);

/// Height of the floor in upright axes: the feet return to it again and again.
double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match);

/// The lowest of some markers, frame by frame, smoothed over a tenth of a second; empty where none
/// of them is ever seen.
double low_level(const Take& clip, Quat upright, std::span<const std::int32_t> markers);

/// A marker in upright axes.
inline Vec3 upright_position(const Take& clip, Quat upright, std::size_t frame,
                             std::size_t marker) {
  return rotate(upright, clip.position(frame, marker));
}

/// Twice as cheap as a quaternion: a turn about y.
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
