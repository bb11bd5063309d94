// Records a repair of a C3D file with its place.
#include "io/c3d/c3d_source.hpp"

namespace kinemend {

void C3dSource::note(std::string_view kind, std::size_t offset, std::string_view message,
                     std::size_t count) const {
  if (strict) throw Error(ErrorKind::quality_limit, error_at(offset, message).what());
  for (std::size_t i = 0; i < count; ++i) diagnostics.add(kind, message, offset);
}

}  // namespace kinemend
