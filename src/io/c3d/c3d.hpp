// The format C3D: recognises, reads and writes it, into the bytes of its source or as a new file,
// and decides which data besides the points are kept.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/c3d/c3d_document.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// Returns how likely the head of a file is C3D, 0 to 100.
int sniff_c3d(std::string_view head);
/// Reads C3D of every processor type and number format. Errors: `unreadable_input`, naming the
/// byte.
TakeResult read_c3d(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes a clip. A clip read from C3D is written as its source's bytes with every changed sample
/// replaced, in the source's processor type and number format. If frames, markers, events or units
/// differ, or samples are too large for the source's integers, it is a new file of Intel floats
/// that keeps the source's parameters. Errors: `usage` if the format cannot hold the clip.
std::string write_c3d(const Take& clip);
/// Lists the parts of the source that `write_c3d` leaves out.
Diagnostics lost_in_c3d(const Take& clip);
/// Lists the parts of a C3D file besides points and events, which no other format can hold: "36
/// analog channels at 1000 Hz".
std::vector<std::string> c3d_beside_points(const SourceInfo& source);

/// Returns a C3D file of Intel reals. `origin`: the source file of the clip, if any. Its parameters
/// are kept if they are still valid; `C3dCarried` decides which of its analog samples and cameras
/// are kept. Errors: `usage` for names longer than 255 bytes, more than 65,535 markers, and
/// positions too large for a real.
std::string new_c3d(const Take& clip, const C3dOrigin& origin);

/// Values for the parameters of a new file besides the clip's names, events, rate and units.
struct C3dNewFile {
  std::size_t frame_count = 0;
  double scale = 0;                 ///< > 0: resolution of residuals, and of integers made from it
  std::size_t analog_count = 0;     ///< channels; 0 removes the source's parameters of analog data
  std::size_t analog_instants = 0;  ///< per frame
};

/// Returns the parameters of a new file of reals. `origin`: the source file of the clip, if any.
/// Its parameters that do not describe the clip are kept; places and lengths (force plates, the
/// axes of the screen) are converted with the clip. POINT:DATA_START exists but is 0.
C3dParameters new_c3d_parameters(const Take& clip, const C3dOrigin& origin, const C3dNewFile& file);

bool same_c3d_events(const std::vector<MarkerEvent>& a, const std::vector<MarkerEvent>& b);

/// Whether the clip differs from its document in samples and rate only.
bool keeps_c3d_layout(const Take& clip, const C3dDocument& document);

/// Returns the document's bytes with every changed sample replaced, for a clip that keeps its
/// layout; empty if a sample does not fit into the document's integers.
std::optional<std::string> rewrite_c3d(const Take& clip, const C3dDocument& document);

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

}  // namespace kinemend
