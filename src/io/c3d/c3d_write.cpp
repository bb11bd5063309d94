// Writes C3D into the bytes of its source if they can hold the take, else as a new file.
#include <optional>
#include <utility>

#include "io/c3d/c3d.hpp"
#include "io/c3d/c3d_carry.hpp"
#include "io/c3d/c3d_writing.hpp"

namespace kinemend {

std::string write_c3d(const Take& clip) {
  clip.validate();
  const C3dOrigin origin = c3d_origin(clip.source);
  if (origin.document != nullptr && !origin.converted && keeps_c3d_layout(clip, *origin.document)) {
    if (std::optional<std::string> bytes = rewrite_c3d(clip, *origin.document))
      return *std::move(bytes);
  }
  return new_c3d(clip, origin);
}

Diagnostics lost_in_c3d(const Take& clip) { return c3d_losses(clip, c3d_origin(clip.source)); }

std::vector<std::string> c3d_beside_points(const SourceInfo& source) {
  const C3dOrigin origin = c3d_origin(source);
  return origin.document == nullptr ? std::vector<std::string>() : beside_points(*origin.document);
}

}  // namespace kinemend
