#include <optional>
#include <utility>

#include "io/c3d.hpp"
#include "io/c3d_document.hpp"
#include "io/c3d_new_file.hpp"
#include "io/c3d_rewrite.hpp"

namespace kinemend {

std::string write_c3d(const MarkerClip& clip) {
  clip.validate();
  const auto* const document = dynamic_cast<const C3dDocument*>(clip.source.document.get());
  if (document != nullptr && keeps_c3d_layout(clip, *document)) {
    if (std::optional<std::string> bytes = rewrite_c3d(clip, *document)) return *std::move(bytes);
  }
  return new_c3d(clip, document);
}

}  // namespace kinemend
