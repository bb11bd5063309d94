#include "io/c3d.hpp"
#include "io/c3d_document.hpp"

namespace kinemend {

std::string write_c3d(const MarkerClip& clip) {
  const auto* const document = dynamic_cast<const C3dDocument*>(clip.source.document.get());
  return document == nullptr ? std::string() : document->bytes;
}

}  // namespace kinemend
