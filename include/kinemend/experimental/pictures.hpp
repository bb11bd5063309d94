// Drawings of whole takes as SVG. Names may hold any characters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/experimental/curves.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Frames [first, last], counted from 0; frames beyond the take are ignored.
using FrameSpanToDraw = std::pair<std::size_t, std::size_t>;

/// Draws `poses` poses from left to right, seen from the direction in which the body is broadest,
/// with up at the top and the frame's number below each pose. `after` is drawn over `before`; null
/// for a single take. Markers are dots. Errors: `ErrorKind::usage` for takes of different length.
std::string film_strip_svg(const Take& before, const Take* after, FrameSpanToDraw frames,
                           std::size_t poses = 9);

/// Draws the take in motion, as an animation (SMIL) that browsers repeat: a fixed camera shows the
/// side along which the motion reaches farthest, at up to 30 poses per second. With `after` the two
/// takes move side by side. Errors: `ErrorKind::usage` for takes of different length, and for more
/// than 1800 poses (a minute).
std::string moving_picture_svg(const Take& before, const Take* after, FrameSpanToDraw frames);

/// Power density of a track over frequency.
struct TrackSpectrum {
  std::vector<double> hertz;
  std::vector<double> before, after;  ///< unit^2 / Hz, all axes together
};
/// Computes the spectrum by Welch's method: Hann windows of up to 1024 samples that overlap by
/// half, each without its mean. Windows with a gap are left out; the result is empty if every
/// window has a gap.
TrackSpectrum track_spectrum(const TrackCurves& curves);
/// Draws both spectra as curves on a logarithmic scale; `one_take`: only the curve after.
std::string spectrum_svg(const TrackCurves& curves, bool one_take = false);

}  // namespace kinemend
