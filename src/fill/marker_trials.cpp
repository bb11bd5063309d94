#include <algorithm>

#include "fill/marker_methods.hpp"
#include "fill/trial_places.hpp"

namespace kinemend::fill {

std::vector<MarkerGap> trial_gaps(const Samples& samples, const MarkerGap& gap,
                                  std::span<const std::size_t> helpers) {
  const FrameSpan evidence = evidence_around(samples, gap);
  std::vector<std::uint8_t> usable(evidence.length());
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    usable[f - evidence.first] = samples.measures(f, gap.marker) && !gap.covers(f) &&
                                 std::all_of(helpers.begin(), helpers.end(),
                                             [&](std::size_t m) { return samples.sees(f, m); });
  }
  const bool at_start = gap.span.first == 0, at_end = gap.span.last + 1 == samples.frames;
  std::vector<MarkerGap> trials;
  for (const FrameSpan span : trial_places(usable, evidence.first, gap.span))
    trials.push_back({gap.marker, span, at_start, at_end});
  return trials;
}

}  // namespace kinemend::fill
