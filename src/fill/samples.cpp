#include "fill/samples.hpp"

#include <algorithm>
#include <cmath>

#include "base/frame_span.hpp"

namespace kinemend::fill {

std::size_t Samples::frames_in(double seconds, std::size_t least) const {
  return kinemend::frames_in(seconds, frame_rate_hz, least);
}

double body_radius(const Samples& samples) {
  double sum = 0, count = 0;
  constexpr std::size_t most_frames = 64;
  const std::size_t step = samples.frames / most_frames + 1;
  for (std::size_t f = 0; f < samples.frames; f += step) {
    Vec3 centre;
    double seen = 0;
    for (const std::size_t m : samples.bodies) {
      if (samples.sees(f, m)) centre += samples.at(f, m), seen += 1;
    }
    if (seen < 2) continue;
    centre = (1 / seen) * centre;
    for (const std::size_t m : samples.bodies) {
      if (!samples.sees(f, m)) continue;
      const Vec3 off = samples.at(f, m) - centre;
      sum += dot(off, off), count += 1;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

FrameSpan evidence_around(const Samples& samples, const MarkerGap& gap) {
  const std::size_t reach = std::max(samples.frames_in(60, 1), 10 * gap.span.length());
  return {gap.span.first - std::min(gap.span.first, reach),
          std::min(samples.frames - 1, gap.span.last + reach)};
}

std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::size_t most, std::size_t reach) {
  std::vector<std::size_t> found;
  const std::size_t before_reach = gap.starts_take ? 0 : reach;
  const std::size_t lowest = gap.span.first - std::min(gap.span.first, before_reach);
  for (std::size_t f = gap.span.first; f-- > lowest && found.size() < most;) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  std::reverse(found.begin(), found.end());
  const std::size_t before = found.size();
  const std::size_t behind_reach = gap.ends_take ? 0 : reach;
  const std::size_t end = std::min(samples.frames, gap.span.last + 1 + behind_reach);
  for (std::size_t f = gap.span.last + 1; f < end && found.size() < before + most; ++f) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  return found;
}

std::vector<std::size_t> helpers_of(const Samples& samples, const MarkerGap& gap) {
  std::vector<std::size_t> helpers;
  for (const std::size_t m : samples.bodies) {
    if (m == gap.marker) continue;
    bool whole = true;
    for (std::size_t f = gap.span.first; whole && f <= gap.span.last; ++f) {
      whole = samples.sees(f, m);
    }
    if (whole) helpers.push_back(m);
  }
  return helpers;
}

std::vector<std::size_t> evenly(const std::vector<std::size_t>& frames, std::size_t most) {
  if (frames.size() <= most) return frames;
  std::vector<std::size_t> chosen(most);
  for (std::size_t i = 0; i < most; ++i) {
    chosen[i] = frames[(2 * i + 1) * frames.size() / (2 * most)];
  }
  return chosen;
}

}  // namespace kinemend::fill
