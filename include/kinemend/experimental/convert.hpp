// Converts takes to another rate, axis, unit or kind. What comes out is written anew, not in its
// source's layout; what a C3D file holds beside its points (analog samples, force plates,
// parameters) goes along all the same, and follows the points. What already has the rate, axis or
// unit asked for comes back as it is.
#pragma once

#include <string_view>

#include "kinemend/clip.hpp"
#include "kinemend/marker_clip.hpp"

namespace kinemend {

/// The same motion at another rate, from its first frame to its last or just before. A frame that
/// falls on one of the old frames is that frame, so that 120 Hz to 60 Hz drops every second one;
/// any other is interpolated (cubic through four frames; rotations in the tangent space of one of
/// them) and is observed where both of its neighbours are. Nothing is averaged: what is faster than
/// half the new rate is folded, as in a camera. A rate that agrees with the take's own to six
/// digits is its own. Events stay at their moment of the motion. Errors: `ErrorKind::usage` for a
/// rate outside of 0.1 to 100,000 Hz, or that would make more than 100 million samples.
Clip resample(const Clip& clip, double frame_rate_hz);
MarkerClip resample(const MarkerClip& clip, double frame_rate_hz);

/// The axis that points up or down, from the motion: the floor is where the lowest point of the
/// body keeps returning to. Where nothing tells (no samples), y for joints and z for markers.
Axis guess_up_axis(const Clip& clip);
Axis guess_up_axis(const MarkerClip& clip);

/// The same motion in axes turned by a quarter, so that `from` becomes `to`. Of a clip all frames
/// turn: offsets, rest rotations, channels and limits follow, and the rest pose stands upright in
/// the new axes. The same axis twice changes nothing.
Clip turn_axes(const Clip& clip, Axis from, Axis to);
MarkerClip turn_axes(const MarkerClip& clip, Axis from, Axis to);

/// Every length in another unit: multiplied by `factor`; `metres_per_unit` follows.
Clip scale_lengths(const Clip& clip, double factor);
/// The same for markers; `unit` is the name of the new one.
MarkerClip scale_lengths(const MarkerClip& clip, double factor, std::string_view unit);

/// The markers that are positions, without the angles, forces, moments and powers that a C3D file
/// keeps among its points.
MarkerClip positions_only(const MarkerClip& clip);

/// Makes the take one to be written anew, in its format's plain layout.
void drop_layout(SourceInfo& source);

/// Global joint positions as markers under the joints' names, then those of the end sites where
/// asked for (under their own names, else `<joint>_end`). A sample is observed where every rotation
/// between the root and the joint is. The unit is that of the clip; its name is empty unless the
/// clip is known to be in m, cm or mm.
MarkerClip joint_markers(const Clip& clip, bool with_end_sites = false);

/// The same motion of a skeleton whose rest rotations are all identity, for formats that have none:
/// every joint's frame is parallel to the world's at rest. Joints that turn get three rotation
/// channels, in their own order where they have three axes, else Z Y X.
Clip without_rest_rotations(const Clip& clip);

}  // namespace kinemend
