// The path of a walking person on the floor.
#pragma once

#include <functional>
#include <vector>

#include "kinemend/extend/rotation.hpp"

namespace kinemend::synth {

/// A curve on the floor from the origin, given by its heading (degrees, 0 is z, 90 is x, any size)
/// as a function of the distance walked in cm.
class Path {
 public:
  /// Covers distances from `first` (at most 0) to `last`; beyond them the path is straight.
  Path(std::function<double(double)> heading_deg, double first, double last);

  double heading_deg(double distance) const { return heading_(distance); }
  Vec3 position(double distance) const;
  /// Returns the unit vector to the left of the heading.
  Vec3 left(double distance) const;

 private:
  Vec3 forward(double distance) const;

  std::function<double(double)> heading_;
  double first_;
  std::vector<Vec3> points_;  // one every `step` cm from first_
};

}  // namespace kinemend::synth
