// Describes a conversion of a take so that the other data of its file can be converted too.
#pragma once

#include <array>
#include <memory>

#include "kinemend/take.hpp"

namespace kinemend {

/// A conversion of a take that must also be applied to the other data of its file.
struct TakeChange {
  double length_factor = 1;  ///< factor applied to all lengths
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  ///< images of the three unit vectors
  Vec3 shift;                 ///< added last, in the new unit
  bool resampled = false;     ///< the frames differ but start at the same time
  bool drops_layout = false;  ///< the file is written without its former layout

  bool turns() const { return !(axes[0] == Vec3{1, 0, 0} && axes[1] == Vec3{0, 1, 0}); }
  Vec3 turned(Vec3 v) const { return v.x * axes[0] + v.y * axes[1] + v.z * axes[2]; }
  bool moves() const { return length_factor != 1 || turns() || !(shift == Vec3{}); }
  Vec3 moved(Vec3 p) const { return length_factor * turned(p) + shift; }
};

/// Returns the composition of a first and a second change.
TakeChange both(const TakeChange& first, const TakeChange& second);

/// A document of a file with other data, which is converted together with the take.
struct FollowingDocument : SourceDocument {
  virtual std::shared_ptr<const SourceDocument> after(const TakeChange& change) const = 0;
};

/// Returns the document of a take after a change; null if it holds no data besides the take.
std::shared_ptr<const SourceDocument> document_after(const SourceInfo& source,
                                                     const TakeChange& change);

}  // namespace kinemend
