// Computes global poses (forward kinematics), converts takes to another rate, axis, unit or kind,
// numbers frames as people do, and separates the people of a take of markers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

/// Global rotations and positions of one frame: J of each, in file units.
/// R_j = R_parent rest_j q_j and p_j = p_parent + R_parent offset_j, roots in the world frame.
struct Pose {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;
};

Pose forward_kinematics(const Take& clip, std::size_t frame);

/// Returns joint positions of every frame, F x J, or F x (J + E) with end sites, in file units.
std::vector<Vec3> joint_positions(const Take& clip, bool with_end_sites = false);

// Converts takes to another rate, axis, unit or kind. The result is written in a plain layout, not
// in its source's layout. The other data of a C3D file (analog samples, force plates, parameters)
// is kept and converted with the points. A take that already has the requested rate, axis or unit
// is returned unchanged.

/// Returns the motion at another rate, from its first frame to its last or just before. A frame
/// that coincides with an old frame is copied, so that 120 Hz to 60 Hz drops every second frame.
/// Any other frame is interpolated (cubic through four frames; rotations in the tangent space of
/// one of them) and is observed if both of its neighbours are. No low-pass filter is applied:
/// motion faster than half the new rate is aliased. A rate that agrees with the take's own to six
/// digits changes nothing. Events keep their moment in the motion. Errors: `ErrorKind::usage` for a
/// rate outside 0.1 to 100,000 Hz, or that would make more than 100 million samples.
Take resample(const Take& take, double frame_rate_hz);

/// Guesses the axis that points up or down from the motion: the lowest point of the body keeps
/// returning to the floor. Without samples, y for joints and z for markers.
Axis guess_up_axis(const Take& take);

/// Returns the motion in axes rotated by 90 degrees, so that `from` becomes `to`. In a clip of
/// joints, offsets, rest rotations, channels and limits are rotated too, and the rest pose is
/// upright in the new axes. If both axes are equal nothing changes.
Take turn_axes(const Take& take, Axis from, Axis to);

/// Multiplies every length by `factor`, to convert the unit. `metres_per_unit` of joints is
/// adjusted; `unit` is the name of the new unit of markers.
Take scale_lengths(const Take& take, double factor, std::string_view unit = {});

/// Returns the markers that are positions, without the angles, forces, moments and powers that a
/// C3D file keeps among its points.
Take positions_only(const Take& clip);

/// Drops the layout of the source, so that the take is written in its format's plain layout.
void drop_layout(SourceInfo& source);

/// Returns the global joint positions as markers with the joints' names, then the end sites if
/// asked for (with their own names, else `<joint>_end`). A sample is observed if every rotation
/// between the root and the joint is. The unit is the clip's; its name is empty unless the clip is
/// known to be in m, cm or mm.
Take joint_markers(const Take& clip, bool with_end_sites = false);

/// Returns the motion of a skeleton whose rest rotations are all identity, for formats without rest
/// rotations: at rest every joint's frame is parallel to the world's. Joints that turn get three
/// rotation channels, in their own order if they have three axes, else Z Y X.
Take without_rest_rotations(const Take& clip);

/// Returns the number of frame `frame` (from 0) in a take whose first frame has the number `first`.
std::int64_t frame_number(std::size_t frame, std::int64_t first);

struct Subject {
  std::string name;                  ///< "Ann"; empty for markers without a subject
  std::vector<std::size_t> markers;  ///< the markers that are positions, ascending
};

/// Returns the subjects of a take by the part of the names before the last colon (`Ann:LASI`), in
/// the order of their first markers; markers without a subject come last. If fewer than two
/// subjects are found, all markers are one subject without a name. Empty for a take without
/// positions.
std::vector<Subject> subjects_of(const Take& clip);

}  // namespace kinemend
