// Chooses the trial spans near a gap and elsewhere in the take, and runs the candidates on them.
#include "fill/trials.hpp"

#include <algorithm>
#include <utility>

namespace kinemend::fill {

namespace {

// The number of trials near the gap and elsewhere: chosen on the takes that docs/methods/fill.md
// names.
constexpr std::size_t most_near = 6, most_elsewhere = 3, least_places = 3;
// The evidence on either side of a gap; for speed.
constexpr double evidence_s = 60;
constexpr std::size_t evidence_lengths = 10;  // gap lengths, if that is more

// Returns the frames at which a span of `length` usable frames may start.
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

// Returns the number of disjoint trials to which the spans amount.
double independent(std::vector<FrameSpan> spans) {
  std::sort(spans.begin(), spans.end(),
            [](const FrameSpan& a, const FrameSpan& b) { return a.first < b.first; });
  std::size_t covered = 0, end = 0;
  for (const FrameSpan span : spans) {
    covered += span.last + 1 - std::min(span.last + 1, std::max(span.first, end));
    end = std::max(end, span.last + 1);
  }
  return static_cast<double>(covered) / static_cast<double>(spans[0].length());
}

}  // namespace

FrameSpan evidence_around(FrameSpan gap, std::size_t frames, double frame_rate_hz) {
  const std::size_t reach =
      std::max(frames_in(evidence_s, frame_rate_hz, 1), evidence_lengths * gap.length());
  return surroundings(gap, {}, reach, frames);
}

std::vector<FrameSpan> trial_places(std::span<const std::uint8_t> usable, std::size_t first_frame,
                                    FrameSpan gap) {
  for (std::size_t length = gap.length(); length > 0; length /= 2) {
    const std::vector<std::size_t> starts = starts_of(usable, first_frame, length);
    if (starts.size() < least_places) continue;
    std::vector<std::size_t> chosen = nearest(starts, gap, length, most_near);
    for (const std::size_t start : evenly(starts, most_elsewhere)) chosen.push_back(start);
    std::vector<FrameSpan> spans;
    spans.reserve(chosen.size());
    for (const std::size_t start : chosen) spans.push_back({start, start + length - 1});
    return spans;
  }
  return {};
}

TrialRoom room_around(FrameSpan gap, std::size_t frames, double frame_rate_hz) {
  const FrameSpan evidence = evidence_around(gap, frames, frame_rate_hz);
  return {gap,
          {gap.first == 0, gap.last + 1 == frames},
          evidence,
          std::vector<std::uint8_t>(evidence.length())};
}

Trials try_out(const TrialRoom& room, const TryOn& try_on) {
  Trials trials;
  trials.at_end = room.ends.any();
  const std::vector<FrameSpan> spans = trial_places(room.usable, room.evidence.first, room.gap);
  if (spans.empty()) return trials;
  for (const FrameSpan span : spans)
    trials.products.push_back(products_of(try_on(span, frames_of(span, trial_frames))));
  trials.longer = static_cast<double>(room.gap.length()) / static_cast<double>(spans[0].length());
  trials.weight = independent(spans) / (trials.longer * trials.longer);
  return trials;
}

}  // namespace kinemend::fill
