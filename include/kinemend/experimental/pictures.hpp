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

/// Frames [first, last], counted from 0; more than the take has are left out.
using FrameSpanToDraw = std::pair<std::size_t, std::size_t>;

/// Poses at `poses` moments from left to right, seen from the side along which the body is broad:
/// up is up, and the frame's number stands below each. `after` is drawn over `before`; null where
/// there is one take. Markers are dots. Errors: `ErrorKind::usage` for takes of different length.
std::string film_strip_svg(const Take& before, const Take* after, FrameSpanToDraw frames,
                           std::size_t poses = 9);

/// The take in motion, as an animation (SMIL) that browsers play over and over: from the side along
/// which it reaches farthest, by a camera that stands still, at up to 30 poses a second. With
/// `after` the two move side by side. Errors: `ErrorKind::usage` for takes of different length, and
/// for more than 1800 poses (a minute).
std::string moving_picture_svg(const Take& before, const Take* after, FrameSpanToDraw frames);

/// When each track is missing: a row a track, a bar a gap, and how much is missing of each. A
/// second take's gaps are drawn below those of the first. Tracks without gaps are counted, not
/// drawn.
std::string gap_chart_svg(const Take& before, const Take* after);

/// Power density of a track over frequency.
struct TrackSpectrum {
  std::vector<double> hertz;
  std::vector<double> before, after;  ///< unit^2 / Hz, all axes together
};
/// By Welch's method: Hann windows of up to 1024 samples that overlap by half, each without its
/// mean. Windows with a gap are left out; nothing where none is whole.
TrackSpectrum track_spectrum(const TrackCurves& curves);
/// Both as curves on logarithmic density; `one_take`: only that after.
std::string spectrum_svg(const TrackCurves& curves, bool one_take = false);

}  // namespace kinemend
