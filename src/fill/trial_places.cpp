#include "fill/trial_places.hpp"

#include <algorithm>
#include <utility>

#include "fill/samples.hpp"

namespace kinemend::fill {

namespace {

// Where a span of `length` frames may start.
std::vector<std::size_t> starts_of(std::span<const std::uint8_t> usable, std::size_t first,
                                   std::size_t length) {
  std::vector<std::size_t> starts;
  std::size_t run = 0;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    run = usable[i] ? run + 1 : 0;
    if (run >= length + 2) starts.push_back(first + i - length);
  }
  return starts;
}

std::vector<std::size_t> nearest(const std::vector<std::size_t>& starts, FrameSpan gap,
                                 std::size_t length, std::size_t most) {
  const std::size_t apart = std::max<std::size_t>(1, length / 2);
  std::vector<std::pair<std::size_t, std::size_t>> found;  // distance, start
  const auto behind = std::upper_bound(starts.begin(), starts.end(), gap.last);
  std::size_t count = 0;
  for (auto s = behind; s != starts.end() && count < most; ++s) {
    if (count > 0 && *s < found.back().second + apart) continue;
    found.emplace_back(*s - gap.last, *s);
    ++count;
  }
  count = 0;
  for (auto s = behind; s != starts.begin() && count < most;) {
    --s;
    if (count > 0 && *s + apart > found.back().second) continue;
    found.emplace_back(gap.first - (*s + length - 1), *s);
    ++count;
  }
  std::sort(found.begin(), found.end());
  if (found.size() > most) found.resize(most);
  std::vector<std::size_t> chosen;
  chosen.reserve(found.size());
  for (const auto& [distance, start] : found) chosen.push_back(start);
  return chosen;
}

}  // namespace

std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap) {
  constexpr std::size_t most_near = 6, most_elsewhere = 3, least = 3;
  for (std::size_t length = gap.length(); length > 0; length /= 2) {
    const std::vector<std::size_t> starts = starts_of(usable, first_frame, length);
    if (starts.size() < least) continue;
    std::vector<std::size_t> chosen = nearest(starts, gap, length, most_near);
    for (const std::size_t start : evenly(starts, most_elsewhere)) chosen.push_back(start);
    std::vector<FrameSpan> spans;
    spans.reserve(chosen.size());
    for (const std::size_t start : chosen) spans.push_back({start, start + length - 1});
    return spans;
  }
  return {};
}

}  // namespace kinemend::fill
