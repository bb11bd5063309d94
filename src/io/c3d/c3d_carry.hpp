// Decides what a C3D file takes over from its source beside the points.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

/// Which samples beside the points a new file takes over from its source.
struct C3dCarried {
  bool follows_frames = false;      ///< each frame of the clip is one of the source
  bool keeps_words = false;         ///< and its points are those of the source, with their cameras
  double source_frames = 1;         ///< from one frame of the clip to the next
  std::size_t analog_count = 0;     ///< channels; 0: no analog samples are carried
  std::size_t analog_instants = 0;  ///< of a frame of the clip

  /// The frame of the source at the time of a frame of the clip, or the last one before.
  std::size_t source_frame(std::size_t frame, std::size_t source_count) const;
};

C3dCarried c3d_carried(const Take& clip, const C3dOrigin& origin);

/// Frames that a file of this clip has: those of the source where neither has points.
std::size_t c3d_frame_count(const Take& clip, const C3dOrigin& origin);

/// Whether the clip can be written into the bytes of its source, changing only samples and rate.
bool goes_in_place(const Take& clip, const C3dOrigin& origin);

/// The parts of the source that a C3D file made from the clip lacks.
Diagnostics c3d_losses(const Take& clip, const C3dOrigin& origin);

/// The content of a file beside points and events, in words: "36 analog channels at 1000 Hz".
std::vector<std::string> beside_points(const C3dDocument& document);

}  // namespace kinemend
