// Decides which data besides the points a C3D file keeps from its source.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

/// The samples besides the points that a new file keeps from its source.
struct C3dCarried {
  bool follows_frames = false;      ///< each frame of the clip is a frame of the source
  bool keeps_words = false;         ///< the points are also the source's points, with their cameras
  double source_frames = 1;         ///< source frames per frame of the clip
  std::size_t analog_count = 0;     ///< channels; 0: no analog samples are carried
  std::size_t analog_instants = 0;  ///< per frame of the clip

  /// Returns the source frame at the time of a frame of the clip, or the last frame before.
  std::size_t source_frame(std::size_t frame, std::size_t source_count) const;
};

C3dCarried c3d_carried(const Take& clip, const C3dOrigin& origin);

/// Returns the frame count of a file of this clip; the source's if neither has points.
std::size_t c3d_frame_count(const Take& clip, const C3dOrigin& origin);

/// Whether the clip can be written into the bytes of its source, changing only samples and rate.
bool goes_in_place(const Take& clip, const C3dOrigin& origin);

/// Lists the parts of the source that a C3D file made from the clip lacks.
Diagnostics c3d_losses(const Take& clip, const C3dOrigin& origin);

/// Lists the contents of a file besides points and events: "36 analog channels at 1000 Hz".
std::vector<std::string> beside_points(const C3dDocument& document);

}  // namespace kinemend
