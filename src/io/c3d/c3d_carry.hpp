#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/diagnostics.hpp"

namespace kinemend {

/// What a new file takes over of the samples that its source holds beside the points.
struct C3dCarried {
  bool follows_frames = false;      ///< each frame of the clip stands for one of the source
  bool keeps_words = false;         ///< and its points are those of the source, with their cameras
  double source_frames = 1;         ///< from one frame of the clip to the next
  std::size_t analog_count = 0;     ///< channels; 0: none are carried
  std::size_t analog_instants = 0;  ///< of a frame of the clip

  /// The frame of the source that a frame of the clip lies on, or behind.
  std::size_t source_frame(std::size_t frame, std::size_t source_count) const;
};

C3dCarried c3d_carried(const MarkerClip& clip, const C3dOrigin& origin);

/// Frames that a file of this clip has: those of the source where neither has points.
std::size_t c3d_frame_count(const MarkerClip& clip, const C3dOrigin& origin);

/// Whether the clip goes into the bytes of its source as they are, but for samples and rate.
bool goes_in_place(const MarkerClip& clip, const C3dOrigin& origin);

/// What a C3D file made of the clip will not have of what its source has.
Diagnostics c3d_losses(const MarkerClip& clip, const C3dOrigin& origin);

/// What a file holds beside points and events, in words: "36 analog channels at 1000 Hz".
std::vector<std::string> beside_points(const C3dDocument& document);

}  // namespace kinemend
