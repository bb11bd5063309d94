#include <algorithm>

#include "fill/marker_methods.hpp"

namespace kinemend::fill {

namespace {

// Places where a span of `length` frames, with a frame on either side, is usable throughout;
// `usable` starts at frame `first`.
std::vector<std::size_t> starts_of(const std::vector<std::uint8_t>& usable, std::size_t first,
                                   std::size_t length) {
  std::vector<std::size_t> starts;
  std::size_t run = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    run = usable[i] ? run + 1 : 0;
    if (run >= length + 2) starts.push_back(first + i - length);
  }
  return starts;
}

}  // namespace

std::vector<Span> trial_spans(const Samples& samples, const MarkerGap& gap,
                              std::span<const std::size_t> helpers, std::size_t most) {
  const Span evidence = evidence_around(samples, gap);
  std::vector<std::uint8_t> usable(evidence.length());
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    usable[f - evidence.first] = samples.measures(f, gap.marker) && !gap.covers(f) &&
                                 std::all_of(helpers.begin(), helpers.end(),
                                             [&](std::size_t m) { return samples.sees(f, m); });
  }
  for (std::size_t length = gap.span.length(); length > 0; length /= 2) {
    const std::vector<std::size_t> starts = evenly(starts_of(usable, evidence.first, length), most);
    if (starts.size() < std::min<std::size_t>(most, 3)) continue;
    std::vector<Span> spans;
    spans.reserve(starts.size());
    for (const std::size_t start : starts) spans.push_back({start, start + length - 1});
    return spans;
  }
  return {};
}

}  // namespace kinemend::fill
