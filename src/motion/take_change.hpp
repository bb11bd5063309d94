#pragma once

#include <array>
#include <memory>

#include "kinemend/clip.hpp"

namespace kinemend {

/// What a conversion did to all of a take, as far as it concerns what else its file holds.
struct TakeChange {
  double length_factor = 1;  ///< lengths were multiplied by it
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  ///< where the three unit vectors went: signed unit vectors
  bool resampled = false;     ///< other frames, from the same first moment on
  bool drops_layout = false;  ///< the take is to be written anew

  bool turns() const { return !(axes[0] == Vec3{1, 0, 0} && axes[1] == Vec3{0, 1, 0}); }
  Vec3 turned(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
};

/// First one change, then the other.
TakeChange both(const TakeChange& first, const TakeChange& second);

/// A document whose file holds more than the take, all of which follows the take through a
/// conversion.
struct FollowingDocument : SourceDocument {
  virtual std::shared_ptr<const SourceDocument> after(const TakeChange& change) const = 0;
};

/// The document of a take after a change; null where it says nothing beyond the take.
std::shared_ptr<const SourceDocument> document_after(const SourceInfo& source,
                                                     const TakeChange& change);

}  // namespace kinemend
