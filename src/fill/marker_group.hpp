// A group of markers that move nearly as a rigid body, and the frame of reference that moves with
// it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "fill/samples.hpp"

namespace kinemend::fill {

/// The place of a group of markers in one frame.
struct Placement {
  Quat rotation;  ///< from the group's mean shape to the world
  Vec3 centre;

  Vec3 to_local(Vec3 world) const { return rotate(conjugate(rotation), world - centre); }
  Vec3 to_world(Vec3 local) const { return centre + rotate(rotation, local); }
};

/// Markers that move nearly as a rigid body, and the frame of reference that moves with them: the
/// rotation and shift that fit their mean shape to them by weighted least squares (Kabsch 1976; by
/// quaternions, Horn 1987).
class MarkerGroup {
 public:
  MarkerGroup(std::vector<std::size_t> markers, std::vector<double> weights);

  /// Finds the mean shape over these frames. Every marker of the group must be seen in them.
  void fit_shape(const Samples& samples, std::span<const std::size_t> frames);

  std::span<const std::size_t> markers() const { return markers_; }
  std::span<const Vec3> shape() const { return shape_; }
  /// False for fewer than three markers, or if they lie nearly on one line: the group's rotation is
  /// then unknown, and placements only shift.
  bool turns() const { return turns_; }
  Placement placement(const Samples& samples, std::size_t frame) const;

 private:
  Vec3 centre_of(const Samples& samples, std::size_t frame) const;
  bool spans_a_plane() const;

  std::vector<std::size_t> markers_;
  std::vector<double> weights_;  // sum 1
  std::vector<Vec3> shape_;      // about its weighted centre
  bool turns_ = false;
};

/// A marker that keeps its distance to another one.
struct Companion {
  std::size_t marker = 0;
  double spread = 0;  ///< standard deviation of the distance, file units
};

/// Returns the helpers by the spread of their distance to the gap's marker, least first, without
/// those never seen together with it. Uses at most 192 frames.
std::vector<Companion> companions_of(const Samples& samples, const MarkerGap& gap,
                                     std::span<const std::size_t> helpers);

}  // namespace kinemend::fill
