// Holds feet that stand, frame by frame: with nothing of the frames to come, and no delay of its
// own.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "feet/leg_motion.hpp"
#include "kinemend/feet.hpp"

namespace kinemend::feet {

/// Frames of one stream of joints. A foot that is low and slow is held where it is; when it lifts,
/// its correction fades. Only legs change, and only horizontally. Does nothing for a skeleton
/// without legs.
class LiveFeet {
 public:
  /// `like`: a take of joints, whose frames do not matter.
  explicit LiveFeet(const Take& like);

  /// The rotations (J) and positions of a frame, as a take has them.
  void hold(std::vector<Quat>& rotations, const std::vector<Vec3>& positions);
  std::size_t feet() const { return feet_.size(); }
  bool stands(std::size_t foot) const { return feet_[foot].anchor >= 0; }

 private:
  static constexpr std::size_t parts = 2;  ///< the ankle, in place of the heel; the toe
  /// A point of a foot over the last frames, as it came.
  struct Part {
    std::deque<Vec3> path;
    std::deque<double> heights;
    double level = 0;  ///< its height where it stands
    double speed = 0;  ///< body heights a second
  };
  struct Foot {
    std::array<Part, parts> at;
    int anchor = -1;  ///< the part that is held; -1: none
    Vec3 target;      ///< of the anchor
    Vec3 offset;      ///< of the foot from where it came
  };

  void track(Part& part, Vec3 place, double height) const;
  int anchor_of(const Foot& foot) const;
  void move(Foot& foot) const;

  std::vector<kinemend::Leg> legs_;
  Take one_;  ///< a take of one frame
  LegMotion motion_;
  std::optional<Up> up_;
  std::vector<Foot> feet_;
};

}  // namespace kinemend::feet
