// The frame of the body (floor, heading and place) from one frame of a take to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/extend/body.hpp"

namespace kinemend::representation {

/// The floor (docs/details/bodies.md) is this quantile of the lowest heights, which are means over
/// this time. Chosen by hand, not swept.
inline constexpr double floor_mean_s = 0.1, floor_quantile = 0.2;

/// The motion of the first track's joint in upright axes.
struct RootMotion {
  std::vector<Quat> ancestors;  ///< F, turns of the joints above it from their rest; identity for
                                ///< the take's first joint
  std::vector<Quat> rotations;  ///< F, global
  std::vector<Vec3> positions;  ///< F, file units
};
RootMotion root_motion(const Take& clip, const BodyMatch& match);

/// Writes the position of the first track's joint in a frame, in upright axes, into the joint's own
/// channels if it has any, else into those of joint 0.
void place_root(Take& clip, const BodyMatch& match, std::size_t frame, Vec3 position);

/// Returns the track of the positions that carry the root: see `Take::is_position_observed`.
std::size_t root_track(const Take& clip, const BodyMatch& match);

/// The turn about y in a rotation, and its certainty: 1 upright, falling to 0 upside down, where
/// the turn is undefined. Near upside down the weight is set to 0.
struct Heading {
  double angle = 0;  ///< radians
  double weight = 0;
};
Heading heading_of(Quat rotation);

/// Writes headings and places of the channels from the root's motion.
void follow_root(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                 const RootMotion& root, BodyChannels& channels);

/// Writes the smoothed headings and places of the channels. `turned` and `placed` are the weights
/// of the headings and places in each frame.
void follow(const BodyLayout& layout, std::vector<double> headings, std::span<const double> turned,
            std::vector<Vec3> places, std::span<const double> placed, double frame_rate_hz,
            double floor, BodyChannels& channels);

/// Returns the height of the floor in upright axes, the level to which the feet keep returning.
double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const RootMotion& root);

/// Returns the degrees of one file unit on an arc whose radius is a quarter of the body height.
double degrees_per_unit(const BodyMatch& match);

/// Copies headings, places and scale from the channels of another version of the take. Throws
/// `ErrorKind::usage` for a guide with another layout or length.
void take_frame(const BodyChannels& guide, const BodyLayout& layout, std::size_t frames,
                BodyChannels& channels);

/// Writes three measured channels of a frame.
void put_channels(BodyChannels& channels, std::size_t frame, std::size_t channel, Vec3 v);
Vec3 channels_at(const BodyChannels& channels, std::size_t frame, std::size_t channel);

/// Throws `ErrorKind::usage` if the channels belong to another layout or number of frames.
void check_fit(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
               std::size_t frames, std::span<const std::uint8_t> chosen);

/// Replaces unobserved samples of channels by the last seen value; before the first seen one by
/// that one; by 0 if none is seen.
void hold_last_seen(PoseMatrix& poses, std::span<const std::uint8_t> observed);

}  // namespace kinemend::representation
