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

// The places nearest to the gap, up to `most` on either side, half a length apart at least, then
// the `most` nearest of these.
std::vector<std::size_t> nearest(const std::vector<std::size_t>& starts, Span gap,
                                 std::size_t length, std::size_t most) {
  const std::size_t apart = std::max<std::size_t>(1, length / 2);
  std::vector<std::pair<std::size_t, std::size_t>> found;  // distance, start
  const auto behind = std::upper_bound(starts.begin(), starts.end(), gap.last);
  std::size_t next = 0;
  for (auto s = behind; s != starts.end() && next < most; ++s) {
    if (next > 0 && *s < found.back().second + apart) continue;
    found.emplace_back(*s - gap.last, *s);
    ++next;
  }
  next = 0;
  for (auto s = behind; s != starts.begin() && next < most;) {
    --s;
    if (next > 0 && *s + apart > found.back().second) continue;
    found.emplace_back(gap.first - (*s + length - 1), *s);
    ++next;
  }
  std::sort(found.begin(), found.end());
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i) chosen.push_back(found[i].second);
  return chosen;
}

}  // namespace

std::vector<MarkerGap> trial_gaps(const Samples& samples, const MarkerGap& gap,
                                  std::span<const std::size_t> helpers) {
  constexpr std::size_t most_near = 4, most_elsewhere = 3, least = 3;
  const Span evidence = evidence_around(samples, gap);
  std::vector<std::uint8_t> usable(evidence.length());
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    usable[f - evidence.first] = samples.measures(f, gap.marker) && !gap.covers(f) &&
                                 std::all_of(helpers.begin(), helpers.end(),
                                             [&](std::size_t m) { return samples.sees(f, m); });
  }
  for (std::size_t length = gap.span.length(); length > 0; length /= 2) {
    const std::vector<std::size_t> starts = starts_of(usable, evidence.first, length);
    if (starts.size() < least) continue;
    std::vector<std::size_t> chosen = nearest(starts, gap.span, length, most_near);
    for (const std::size_t start : evenly(starts, most_elsewhere)) chosen.push_back(start);
    std::vector<MarkerGap> trials;
    trials.reserve(chosen.size());
    for (const std::size_t start : chosen) {
      MarkerGap trial = gap;
      trial.span = {start, start + length - 1};
      trial.starts_take = gap.span.first == 0;
      trial.ends_take = gap.span.last + 1 == samples.frames;
      trials.push_back(trial);
    }
    return trials;
  }
  return {};
}

}  // namespace kinemend::fill
