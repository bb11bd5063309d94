// Compares the second differences beside a gap with the usual ones.
#include "fill/doubt.hpp"

#include <algorithm>

namespace kinemend::fill {

namespace {

// Not swept.
constexpr double clearly = 3;
constexpr double compared_s = 0.5;
constexpr std::size_t compared_more = 8, least_seen = 8;
constexpr std::size_t most_doubted = 2;

// Returns the size of the second difference over frames f - 1 to f + 1, negative if one is not
// observed.
double leap(const Track& track, std::size_t f) {
  if (!track.observed[f - 1] || !track.observed[f] || !track.observed[f + 1]) return -1;
  return size_of(track, track.values[f - 1] - 2 * track.values[f] + track.values[f + 1]);
}

}  // namespace

std::size_t doubt_reach(double frame_rate_hz) {
  return static_cast<std::size_t>(compared_s * frame_rate_hz) + compared_more;
}

Doubt doubt_beside(const Track& track, FrameSpan gap, double frame_rate_hz, double least) {
  const std::size_t frames = track.frames();
  const FrameSpan compared = surroundings(gap, {}, doubt_reach(frame_rate_hz), frames);
  const auto is_near = [](std::size_t a, std::size_t b) {
    return (a > b ? a - b : b - a) <= most_doubted;
  };
  // The middle frames of the second differences that end at the samples next to the gap.
  const std::size_t before = gap.first >= 2 ? gap.first - 2 : frames;
  const std::size_t behind = gap.last + 2 < frames ? gap.last + 2 : frames;
  double usual = least / clearly;
  std::size_t seen = 0;
  for (std::size_t f = std::max<std::size_t>(compared.first, 1); f < compared.last; ++f) {
    if (is_near(f, before) || is_near(f, behind)) continue;
    const double size = leap(track, f);
    seen += size >= 0;
    usual = std::max(usual, size);
  }
  Doubt doubt;
  if (seen < least_seen) return doubt;
  if (gap.first >= 3 + most_doubted && leap(track, before) > clearly * usual)
    doubt.before = most_doubted;
  if (gap.last + 3 + most_doubted < frames && leap(track, behind) > clearly * usual)
    doubt.behind = most_doubted;
  return doubt;
}

}  // namespace kinemend::fill
