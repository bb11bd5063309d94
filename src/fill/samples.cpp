// Finds the size of the body, the frames beside a gap, and the markers that help.
#include "fill/samples.hpp"

#include <algorithm>
#include <cmath>

#include "fill/trials.hpp"

namespace kinemend::fill {

namespace {

// The support of the splines, doubled because it may contain other gaps, and a minimum of frames.
constexpr double window_s = 0.5;
constexpr std::size_t least_window = 64;
// Chosen with the memories of `Bridge`, on the takes that docs/methods/fill.md names.
constexpr std::size_t most_beside = 12;
constexpr double beside_s = 0.5;
constexpr std::size_t most_radius_frames = 64;  // for speed

}  // namespace

std::size_t Samples::frames_in(double seconds, std::size_t least) const {
  return kinemend::frames_in(seconds, frame_rate_hz, least);
}

double body_radius(const Samples& samples) {
  double sum = 0, count = 0;
  const std::size_t step = samples.frames / most_radius_frames + 1;
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

Track track_around(const Samples& samples, const MarkerGap& gap) {
  const FrameSpan window = surroundings(
      gap.span, gap.ends, 2 * samples.frames_in(window_s, least_window), samples.frames);
  Track track{std::vector<Vec3>(window.length()), std::vector<std::uint8_t>(window.length())};
  track.first_frame = window.first;
  for (std::size_t f = window.first; f <= window.last; ++f) {
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    track.values[f - window.first] = samples.at(f, gap.marker);
    track.observed[f - window.first] = 1;
  }
  return track;
}

std::vector<std::size_t> frames_showing(const Samples& samples, const MarkerGap& gap,
                                        std::span<const std::size_t> others) {
  const FrameSpan evidence = evidence_around(gap.span, samples.frames, samples.frame_rate_hz);
  std::vector<std::size_t> frames;
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    if (samples.measures(f, gap.marker) && !gap.covers(f) && samples.sees(f, others))
      frames.push_back(f);
  }
  return frames;
}

std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::span<const std::size_t> others) {
  const FrameSpan reached =
      surroundings(gap.span, gap.ends, samples.frames_in(beside_s, most_beside), samples.frames);
  std::vector<std::size_t> found;
  for (std::size_t f = gap.span.first; f-- > reached.first && found.size() < most_beside;) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  std::reverse(found.begin(), found.end());
  const std::size_t most = found.size() + most_beside;
  for (std::size_t f = gap.span.last + 1; f <= reached.last && found.size() < most; ++f) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  std::erase_if(found, [&](std::size_t f) { return !samples.sees(f, others); });
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

}  // namespace kinemend::fill
