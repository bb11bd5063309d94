// The frame of the body from one frame of a take to the next: floor, heading and place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinemend/experimental/body.hpp"

namespace kinemend::representation {

/// How a floor is found (docs/bodies.md): heights are means over so long, and the floor is what the
/// lowest of them are below in this share of the frames. Chosen by hand, not swept.
inline constexpr double floor_mean_s = 0.1, floor_quantile = 0.2;

/// The joint of the first track in the take's axes turned upright, frame by frame.
struct RootMotion {
  std::vector<Quat> ancestors;  ///< F, turns of the joints above it from their rest; identity where
                                ///< it is the take's first joint
  std::vector<Quat> rotations;  ///< F, global
  std::vector<Vec3> positions;  ///< F, file units
};
RootMotion root_motion(const Take& clip, const BodyMatch& match);

/// Writes where and how the joint of the first track stands in a frame, in upright axes. The
/// position goes into the joint's own channels where it has some, else into those of joint 0.
void place_root(Take& clip, const BodyMatch& match, std::size_t frame, Vec3 position);

/// The track of the positions that carry the root: see `Take::is_position_observed`.
std::size_t root_track(const Take& clip, const BodyMatch& match);

/// The turn about y that a rotation holds, and how well it is known: 1 upright, 0 upside down,
/// where there is none; next to that, 0.
struct Heading {
  double angle = 0;  ///< radians
  double weight = 0;
};
Heading heading_of(Quat rotation);

/// Headings and places of the channels, from the root's motion.
void follow_root(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                 const RootMotion& root, BodyChannels& channels);

/// Headings and places of the channels, smoothed: angles and points frame by frame, and how well
/// each is known.
void follow(const BodyLayout& layout, std::vector<double> headings, std::span<const double> turned,
            std::vector<Vec3> places, std::span<const double> placed, double frame_rate_hz,
            double floor, BodyChannels& channels);

/// Height of the floor in upright axes: the feet return to it again and again.
double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const RootMotion& root);

/// Degrees that a length of one file unit is, on an arc of a quarter of the body height.
double degrees_per_unit(const BodyMatch& match);

/// Takes headings, places and scale over from the channels of a copy of the take. Errors:
/// `ErrorKind::usage` for a guide of another layout or length.
void take_frame(const BodyChannels& guide, const BodyLayout& layout, std::size_t frames,
                BodyChannels& channels);

/// Three channels of a frame that were measured.
void put_channels(BodyChannels& channels, std::size_t frame, std::size_t channel, Vec3 v);
Vec3 channels_at(const BodyChannels& channels, std::size_t frame, std::size_t channel);

/// Errors: `ErrorKind::usage` for channels that are not of that layout, or not of so many frames.
void check_fit(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
               std::size_t frames, std::span<const std::uint8_t> chosen);

/// Unobserved samples of channels become the last seen value; before the first seen, that one; 0
/// where none is seen.
void hold_last_seen(PoseMatrix& poses, std::span<const std::uint8_t> observed);

}  // namespace kinemend::representation
