#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "base/frame_span.hpp"
#include "base/parallel.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/clip.hpp"
#include "kinemend/pose_matrix.hpp"

// What the cleaners of joints share: the selected tracks of a clip and its gaps.
namespace kinemend {

/// The joints that are selected and move at all.
std::vector<std::size_t> selected_joints(const Clip& clip, const Selection& selection);
/// Whether positions of `clip.translated_joints[index]` may change.
bool translation_selected(const Clip& clip, const Selection& selection, std::size_t index);

/// The positions of one joint in all frames: frame f is `values[f * stride]`.
struct PositionTrack {
  Vec3* values = nullptr;
  std::size_t stride = 1;
};
/// The selected position tracks: the root's, then the translated joints'.
std::vector<PositionTrack> selected_positions(Clip& clip, const Selection& selection);

bool is_root(const Clip& clip, const PositionTrack& track);

/// What was done to the positions of one joint: that of frame f is `values[f * stride]`.
struct ActionTrack {
  Action* values = nullptr;
  std::size_t stride = 1;
};
/// Where `trace` states what is done to one of `selected_positions`; makes room for it, all kept.
ActionTrack position_actions(const Clip& clip, const PositionTrack& track, CleanTrace& trace);

/// One joint's rotations in all frames.
std::vector<Quat> joint_track(const Clip& clip, std::size_t joint);
void set_joint_track(Clip& clip, std::size_t joint, std::span<const Quat> track);
std::vector<Vec3> position_track(const PositionTrack& track, std::size_t frames);
void set_position_track(const PositionTrack& track, std::span<const Vec3> values);

/// Marks the unobserved samples of these joints as filled, where anything was observed at all.
void mark_gaps(const Clip& clip, std::span<const std::size_t> joints, CleanTrace& trace);
/// Puts the geodesic between its observed neighbours into each unobserved sample of these joints
/// (the nearest observed sample at the ends of the take), and marks it as filled.
void bridge_gaps(Clip& clip, std::span<const std::size_t> joints, CleanTrace& trace);

/// Gives what a cleaner made of a copy of `clip` to `sink`, joint by joint, and everything else to
/// `clip`. `trace.actions` go to the sink, too.
void hand_over(Clip& clip, Clip cleaned, const JointSink& sink, CleanTrace& trace);

/// Puts the straight line between its observed neighbours into each position that was not observed.
void bridge_positions(Clip& clip);

/// Mean length of the bones (offsets that are not zero), file units; 1 when there are none. It puts
/// positions and rotations on one scale: a turn of one radian moves a bone's end by about this.
double typical_bone_length(const Skeleton& skeleton);

enum class ChannelChoice {
  quaternion,  ///< for linear filters: they commute with turning the frame on either side
  suitable     ///< tangent space where the joint allows it: the noise is even there
};
/// Encodes the selected joints and positions (block by block, in parallel), lets `filter` work on
/// the channels in place, and decodes. Gaps are bridged first.
CleanTrace clean_channels(Clip& clip, const Selection& selection, ChannelChoice choice,
                          const std::function<void(PoseMatrix&)>& filter);

}  // namespace kinemend
