// Converts takes to another rate, axis, unit or kind. What comes out is written anew, not in its
// source's layout; what a C3D file holds beside its points (analog samples, force plates,
// parameters) goes along all the same, and follows the points. What already has the rate, axis or
// unit asked for comes back as it is.
#pragma once

#include <string_view>

#include "kinemend/take.hpp"

namespace kinemend {

/// The same motion at another rate, from its first frame to its last or just before. A frame that
/// falls on one of the old frames is that frame, so that 120 Hz to 60 Hz drops every second one;
/// any other is interpolated (cubic through four frames; rotations in the tangent space of one of
/// them) and is observed where both of its neighbours are. Nothing is averaged: what is faster than
/// half the new rate is folded, as in a camera. A rate that agrees with the take's own to six
/// digits is its own. Events stay at their moment of the motion. Errors: `ErrorKind::usage` for a
/// rate outside of 0.1 to 100,000 Hz, or that would make more than 100 million samples.
Take resample(const Take& take, double frame_rate_hz);

/// The axis that points up or down, from the motion: the floor is where the lowest point of the
/// body keeps returning to. Where nothing tells (no samples), y for joints and z for markers.
Axis guess_up_axis(const Take& take);

/// The same motion in axes turned by a quarter, so that `from` becomes `to`. Of a clip all frames
/// turn: offsets, rest rotations, channels and limits follow, and the rest pose stands upright in
/// the new axes. The same axis twice changes nothing.
Take turn_axes(const Take& take, Axis from, Axis to);

/// Every length in another unit: multiplied by `factor`. `metres_per_unit` of joints follows;
/// `unit` is the name of the new unit of markers.
Take scale_lengths(const Take& take, double factor, std::string_view unit = {});

/// The markers that are positions, without the angles, forces, moments and powers that a C3D file
/// keeps among its points.
Take positions_only(const Take& clip);

/// Makes the take one to be written anew, in its format's plain layout.
void drop_layout(SourceInfo& source);

/// Global joint positions as markers under the joints' names, then those of the end sites where
/// asked for (under their own names, else `<joint>_end`). A sample is observed where every rotation
/// between the root and the joint is. The unit is that of the clip; its name is empty unless the
/// clip is known to be in m, cm or mm.
Take joint_markers(const Take& clip, bool with_end_sites = false);

/// The same motion of a skeleton whose rest rotations are all identity, for formats that have none:
/// every joint's frame is parallel to the world's at rest. Joints that turn get three rotation
/// channels, in their own order where they have three axes, else Z Y X.
Take without_rest_rotations(const Take& clip);

}  // namespace kinemend
