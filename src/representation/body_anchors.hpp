#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kinemend/body.hpp"

// The frame of a body of markers: where its steady markers stand.
namespace kinemend::representation {

/// A marker where it is seen, and where it is in the body.
struct Anchor {
  Vec3 seen;      ///< upright axes, file units
  Vec3 expected;  ///< body's frame, file units
};

/// A turn about y and a shift along the floor.
struct Standing {
  double heading = 0;  ///< radians
  Vec3 place;          ///< y is 0
  double spread = 0;   ///< summed squared distances of the expected anchors from their centre
};
/// The least squares fit, heights aside; anchors that lie far off the others are left out. None for
/// fewer than three, or where all are expected at one spot.
std::optional<Standing> fit_standing(std::vector<Anchor> anchors, double stature);

/// Headings and places of the channels, from the anchors. `floor`: height of the floor.
void follow_anchors(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match,
                    double floor, BodyChannels& channels);

/// Height of the floor in upright axes: the feet return to it again and again.
double floor_height(const MarkerClip& clip, const BodyLayout& layout, const BodyMatch& match);

/// The lowest of some markers, frame by frame, smoothed over a tenth of a second; empty where none
/// of them is ever seen.
double low_level(const MarkerClip& clip, Quat upright, std::span<const std::int32_t> markers);

/// A marker in upright axes.
inline Vec3 upright_position(const MarkerClip& clip, Quat upright, std::size_t frame,
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
