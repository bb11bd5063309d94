// Follows the root of a body of joints, smooths its heading and place, and finds the floor.
#include "body/body_frame.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "body/body_trend.hpp"
#include "kinemend/error.hpp"
#include "motion/take.hpp"

namespace kinemend::representation {

namespace {

// A joint and its ancestors from the top, with the point that holds each one's offset.
class Chain {
 public:
  Chain(const Take& clip, std::int32_t joint) : clip_(clip) {
    for (; joint >= 0; joint = clip.skeleton.parents[static_cast<std::size_t>(joint)]) {
      const auto j = static_cast<std::size_t>(joint);
      links_.push_back({j, point_of_joint(clip, j)});
    }
    std::reverse(links_.begin(), links_.end());
  }

  std::size_t length() const { return links_.size(); }

  struct Point {
    Quat rotation;
    Vec3 position;
  };
  // Returns the global point after the first `count` joints of the chain.
  Point at(std::size_t frame, std::size_t count) const {
    Point point;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t joint = links_[i].joint;
      point.position += rotate(point.rotation, offset(frame, links_[i]));
      point.rotation =
          point.rotation * clip_.skeleton.rest_rotations[joint] * clip_.rotation(frame, joint);
    }
    return point;
  }
  Quat rotation_at_rest(std::size_t count) const {
    Quat rotation;
    for (std::size_t i = 0; i < count; ++i)
      rotation = rotation * clip_.skeleton.rest_rotations[links_[i].joint];
    return rotation;
  }

 private:
  struct Link {
    std::size_t joint;
    std::optional<std::size_t> point;
  };

  Vec3 offset(std::size_t frame, const Link& link) const {
    return link.point ? clip_.position(frame, *link.point) : clip_.skeleton.offsets[link.joint];
  }

  const Take& clip_;
  std::vector<Link> links_;
};

std::size_t root_joint(const BodyMatch& match) { return static_cast<std::size_t>(match.tracks[0]); }

}  // namespace

RootMotion root_motion(const Take& clip, const BodyMatch& match) {
  const std::size_t frames = clip.frame_count();
  const Chain chain(clip, match.tracks[0]);
  const std::size_t above = chain.length() - 1;
  const Quat unturned = conjugate(match.upright * chain.rotation_at_rest(above));
  RootMotion root;
  for (std::size_t f = 0; f < frames; ++f) {
    const Chain::Point parent = chain.at(f, above);
    const Chain::Point point =
        above == 0 ? Chain::Point{{}, clip.root_position(f)} : chain.at(f, above + 1);
    root.ancestors.push_back(above == 0 ? Quat{} : match.upright * parent.rotation * unturned);
    root.rotations.push_back(root.ancestors.back() * match.before[0] *
                             clip.rotation(f, root_joint(match)) * match.after[0]);
    root.positions.push_back(rotate(match.upright, point.position));
  }
  return root;
}

Heading heading_of(Quat q) {
  // Chosen by hand, not swept.
  constexpr double least_weight = 0.1;  // within 37 degrees of upside down
  const double weight = q.w * q.w + q.y * q.y;
  return {2 * portable::atan2(q.y, q.w), weight > least_weight ? weight : 0};
}

std::size_t root_track(const Take& clip, const BodyMatch& match) {
  return point_of_joint(clip, root_joint(match)).value_or(0);
}

void place_root(Take& clip, const BodyMatch& match, std::size_t frame, Vec3 position) {
  const Vec3 global = rotate(conjugate(match.upright), position);
  const std::size_t joint = root_joint(match);
  if (joint == 0) {
    clip.root_position(frame) = global;
    return;
  }
  const Chain chain(clip, match.tracks[0]);
  if (const auto point = point_of_joint(clip, joint)) {
    const Chain::Point parent = chain.at(frame, chain.length() - 1);
    clip.position(frame, *point) = rotate(conjugate(parent.rotation), global - parent.position);
    return;
  }
  clip.root_position(frame) += global - chain.at(frame, chain.length()).position;
}

void follow_root(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                 const RootMotion& root, BodyChannels& channels) {
  const std::size_t frames = clip.frame_count();
  const std::size_t joint = root_joint(match), track = root_track(clip, match);
  std::vector<double> headings(frames), turned(frames), placed(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const Heading heading = heading_of(root.rotations[f]);
    headings[f] = heading.angle;
    turned[f] = clip.is_observed(f, joint) ? heading.weight : 0;
    placed[f] = clip.is_position_observed(f, track) ? 1 : 0;
  }
  follow(layout, std::move(headings), turned, root.positions, placed, clip.frame_rate_hz,
         floor_height(clip, layout, match, root), channels);
}

double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const RootMotion& root) {
  // Height of the ankle of a standing person in body heights (Drillis and Contini 1966).
  constexpr double ankle_share = 0.039;
  const std::size_t frames = clip.frame_count();
  if (frames == 0) return 0;
  if (match.feet.empty()) {
    // Without feet, the floor follows from the root's median height.
    std::vector<double> heights;
    for (const Vec3 p : root.positions) heights.push_back(p.y);
    return median_of(heights) - layout.place.y * match.body_height;
  }
  const std::vector<double> all(frames, 1.0);
  std::vector<double> lowest;
  for (const std::int32_t foot : match.feet) {
    const Chain chain(clip, foot);
    std::vector<double> heights(frames);
    for (std::size_t f = 0; f < frames; ++f)
      heights[f] = rotate(match.upright, chain.at(f, chain.length()).position).y;
    heights = smooth_trend(std::move(heights), all, clip.frame_rate_hz, floor_mean_s);
    if (lowest.empty()) {
      lowest = std::move(heights);
      continue;
    }
    for (std::size_t f = 0; f < frames; ++f) lowest[f] = std::min(lowest[f], heights[f]);
  }
  return quantile_of(lowest, floor_quantile) - ankle_share * match.body_height;
}

void follow(const BodyLayout& layout, std::vector<double> headings, std::span<const double> turned,
            std::vector<Vec3> places, std::span<const double> placed, double frame_rate_hz,
            double floor, BodyChannels& channels) {
  continue_angles(headings, turned);
  channels.headings = smooth_trend(std::move(headings), turned, frame_rate_hz, layout.trend_s);
  channels.places = smooth_path(std::move(places), placed, frame_rate_hz, layout.trend_s);
  for (Vec3& place : channels.places) place.y = floor;
}

double degrees_per_unit(const BodyMatch& match) {
  return degrees_per_radian / (0.25 * match.body_height);
}

void take_frame(const BodyChannels& guide, const BodyLayout& layout, std::size_t frames,
                BodyChannels& channels) {
  if (guide.poses.frames != frames || guide.poses.channels != layout.channel_count() ||
      guide.headings.size() != frames || guide.places.size() != frames)
    throw Error(ErrorKind::usage, "the guide's channels are not of a copy of the take");
  channels.headings = guide.headings;
  channels.places = guide.places;
  channels.degrees_per_unit = guide.degrees_per_unit;
}

void put_channels(BodyChannels& channels, std::size_t frame, std::size_t channel, Vec3 v) {
  const std::size_t at = frame * channels.poses.channels + channel;
  channels.poses.values[at] = v.x;
  channels.poses.values[at + 1] = v.y;
  channels.poses.values[at + 2] = v.z;
  std::fill_n(channels.observed.begin() + static_cast<std::ptrdiff_t>(at), 3, std::uint8_t{1});
}

Vec3 channels_at(const BodyChannels& channels, std::size_t frame, std::size_t channel) {
  const double* row = channels.poses.row(frame).data() + channel;
  return {row[0], row[1], row[2]};
}

void check_fit(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
               std::size_t frames, std::span<const std::uint8_t> chosen) {
  const std::size_t choices =
      layout.track_count() + (layout.kind == BodyKind::joints && layout.with_place ? 1 : 0);
  if (channels.poses.frames == frames && channels.headings.size() == frames &&
      channels.places.size() == frames && channels.poses.channels == layout.channel_count() &&
      match.tracks.size() == layout.track_count() && (chosen.empty() || chosen.size() == choices))
    return;
  throw Error(ErrorKind::usage, "the body's channels do not fit the take they are written into");
}

void hold_last_seen(PoseMatrix& poses, std::span<const std::uint8_t> observed) {
  if (std::find(observed.begin(), observed.end(), 0) == observed.end()) return;
  const std::size_t width = poses.channels;
  for (std::size_t c = 0; c < width; ++c) {
    std::size_t first = 0;
    while (first < poses.frames && observed[first * width + c] == 0) ++first;
    if (poses.frames > 0) poses(0, c) = first < poses.frames ? poses(first, c) : 0;
  }
  for (std::size_t i = width; i < poses.values.size(); ++i) {
    if (observed[i] == 0) poses.values[i] = poses.values[i - width];
  }
}

}  // namespace kinemend::representation
