// A track over time, before and after, as values and as a drawing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Curves of one joint or marker. A sample that was not observed is NaN.
struct TrackCurves {
  std::string name;
  std::string quantity;  ///< "rotation" or "position", as in `ReportFinding`
  std::string unit;      ///< "deg" for rotations; for positions the file's, empty if not stated
  std::int64_t first_frame = 1;  ///< the number that the file gives to the first frame
  double frame_rate_hz = 0;
  std::vector<std::string> axes;            ///< "X", "Y", "Z", in the file's order
  std::vector<std::vector<double>> before;  ///< a curve of F values for each axis
  std::vector<std::vector<double>> after;
  /// F: the angle between the rotations, or the distance; NaN if either value is NaN.
  std::vector<double> difference;
};

/// Returns the rotation of a joint as the angles of its channels, without jumps from frame to
/// frame; the angles after cleaning are the ones nearest to the angles before. A joint without
/// rotation channels uses ZXY. All three functions throw `ErrorKind::usage` for takes of different
/// length and for a track that one of them does not have.
TrackCurves rotation_curves(const Take& before, const Take& after, std::size_t joint);
/// Returns the position of joint 0.
TrackCurves root_curves(const Take& before, const Take& after);
TrackCurves marker_curves(const Take& before, const Take& after, std::size_t marker);

struct CurveStyle {
  /// Frames [first, last] to draw, counted from 0; frames beyond the take are ignored.
  std::size_t first_frame = 0, last_frame = SIZE_MAX;
  bool one_take = false;  ///< only the curve after, without a difference
};
/// Draws a panel for each axis with the curve before under the curve after, and a panel of the
/// difference. If there are more frames than pixels, each pixel shows the smallest and the largest
/// value of its frames.
std::string curves_svg(const TrackCurves& curves, const CurveStyle& style = {});

}  // namespace kinemend
