// Keeps the document of a C3D file through conversions, and retrieves it.
#include "io/c3d/c3d_document.hpp"

namespace kinemend {

std::shared_ptr<const SourceDocument> C3dDocument::after(const TakeChange& further) const {
  auto converted = std::make_shared<ConvertedC3d>();
  converted->original = shared_from_this();
  converted->change = further;
  return converted;
}

std::shared_ptr<const SourceDocument> ConvertedC3d::after(const TakeChange& further) const {
  auto converted = std::make_shared<ConvertedC3d>();
  converted->original = original;
  converted->change = both(change, further);
  return converted;
}

C3dOrigin c3d_origin(const SourceInfo& source) {
  const SourceDocument* const document = source.document.get();
  if (const auto* converted = dynamic_cast<const ConvertedC3d*>(document))
    return {converted->original.get(), true, converted->change};
  return {dynamic_cast<const C3dDocument*>(document), false, {}};
}

}  // namespace kinemend
