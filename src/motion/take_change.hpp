// Describes a conversion of a take so that the rest of its file can follow it.
#pragma once

#include <array>
#include <memory>

#include "kinemend/take.hpp"

namespace kinemend {

/// Changes of a take by a conversion that other contents of its file have to follow.
struct TakeChange {
  double length_factor = 1;  ///< lengths were multiplied by it
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  ///< images of the three unit vectors
  Vec3 shift;                 ///< added last, in the new unit
  bool resampled = false;     ///< other frames, starting at the same time
  bool drops_layout = false;  ///< the file is written without its former layout

  bool turns() const { return !(axes[0] == Vec3{1, 0, 0} && axes[1] == Vec3{0, 1, 0}); }
  Vec3 turned(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  bool moves() const { return length_factor != 1 || turns() || !(shift == Vec3{}); }
  Vec3 moved(Vec3 p) const { return length_factor * turned(p) + shift; }
};

/// The composition of a first and a second change.
TakeChange both(const TakeChange& first, const TakeChange& second);

/// A document of a file with further contents, which follow the take through a conversion.
struct FollowingDocument : SourceDocument {
  virtual std::shared_ptr<const SourceDocument> after(const TakeChange& change) const = 0;
};

/// The document of a take after a change; null where it holds nothing beyond the take.
std::shared_ptr<const SourceDocument> document_after(const SourceInfo& source,
                                                     const TakeChange& change);

}  // namespace kinemend
