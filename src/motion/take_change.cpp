// Composes conversions, and applies them to the source document of a take.
#include "motion/take_change.hpp"

#include "kinemend/experimental/convert.hpp"

namespace kinemend {

TakeChange both(const TakeChange& first, const TakeChange& second) {
  TakeChange result;
  result.length_factor = first.length_factor * second.length_factor;
  for (std::size_t i = 0; i < result.axes.size(); ++i)
    result.axes[i] = second.turned(first.axes[i]);
  result.shift = second.moved(first.shift);
  result.resampled = first.resampled || second.resampled;
  result.drops_layout = first.drops_layout || second.drops_layout;
  return result;
}

std::shared_ptr<const SourceDocument> document_after(const SourceInfo& source,
                                                     const TakeChange& change) {
  const auto* const document = dynamic_cast<const FollowingDocument*>(source.document.get());
  return document == nullptr ? nullptr : document->after(change);
}

void drop_layout(SourceInfo& source) {
  TakeChange change;
  change.drops_layout = true;
  source.document = document_after(source, change);
}

}  // namespace kinemend
