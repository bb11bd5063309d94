// The rest pose of a skeleton, its up direction, the body height, and the frames of bones:
// rotations of joints in the frames of a layout, and continued rotation vectors of a track.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "body/body_frame.hpp"
#include "body/body_names.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/take.hpp"

namespace kinemend::representation {

/// The pose relative to which joints turn: the pose of a skeleton with identity local rotations,
/// or, if that is not a standing person, the straightest frame of the take.
struct RestPose {
  std::vector<Quat> rotations;  ///< J, global
  std::vector<Quat> unturned;   ///< J, the same with the joint's own rotation set to identity
  std::vector<Vec3> positions;  ///< J, then the end sites
  Quat upright;  ///< turns the file's axes so that the person at rest stands along y and faces z
};
RestPose rest_pose(const Take& clip, const std::vector<BoneName>& bones);

/// Returns the rotation that turns the motion's axes so that y points up. If the person's usual
/// posture is unclear or head down, the world is taken to be that of the rest pose.
Quat upright_world(const Take& clip, const std::vector<BoneName>& bones, const RestPose& rest);

/// Returns the body height from the lengths of the legs, whatever the rest pose, else from the
/// longest path along bones between two ends; 1 for a skeleton without lengths.
double body_height_from_legs(const Skeleton& skeleton, const std::vector<BoneName>& bones);

/// Returns the shortest rotation from one direction to another; exactly identity if they are equal
/// up to rounding.
Quat shortest_rotation(Vec3 from, Vec3 to);

/// Returns the positive or negative axis nearest to a direction; y for the zero vector.
Vec3 nearest_axis(Vec3 direction);

/// Returns the directions of the bones of a take's tracks at rest, in upright axes: to the track's
/// only child, or to the single child joint or end site of a track without children. Zero if the
/// direction is ambiguous or the bone has no length.
std::vector<Vec3> bone_directions(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                                  const std::vector<std::int32_t>& tracks);

/// Sets `match.before` and `match.after`. Tracks are handled from the root outward. A track's frame
/// is turned from the take's rest to that of the layout by the shortest rotation that aligns their
/// bones once the parent track is turned, so that a bone keeps its twist against its neighbour. A
/// bone of unknown direction turns with its parent track.
void align_joints(const BodyLayout& layout, const Take& clip, const RestPose& rest,
                  BodyMatch& match);

/// Returns the nearest ancestor in the layout's tree that the take has; -1 if the take has no
/// ancestor of the track.
std::int32_t matched_parent(const BodyLayout& layout, const std::vector<std::int32_t>& tracks,
                            std::size_t track);

/// Returns the rotations q of a track that the take has, in the layout's frames (F); those of the
/// first track are in the body's frame.
std::vector<Quat> track_rotations(const Take& clip, const BodyMatch& match, const RootMotion& root,
                                  const BodyChannels& channels, std::size_t track);

/// Continues rotation vectors of length up to pi from sample to sample, beyond half a turn. A few
/// outlier samples (more than 60 degrees) do not affect the motion after them. A joint that turns
/// farther than 210 degrees for half a second restarts at the vector of length up to pi, because
/// models know no joint that has made a full turn.
void continue_vectors(std::span<Vec3> vectors, double frame_rate_hz);

}  // namespace kinemend::representation
