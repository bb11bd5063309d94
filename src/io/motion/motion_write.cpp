// Checks that the channels can hold the motion, and writes their values frame by frame.
#include "io/motion/motion_write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/text/text.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "motion/rotation.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

Vec3 joint_position(const Take& clip, std::size_t frame, std::size_t joint) {
  const auto point = point_of_joint(clip, joint);
  return point ? clip.position(frame, *point) : clip.skeleton.offsets[joint];
}

Quat written_rotation(const Take& clip, std::size_t frame, std::size_t joint, RestRotations rest) {
  const Quat rotation = clip.rotation(frame, joint);
  return rest == RestRotations::apart ? rotation : clip.skeleton.rest_rotations[joint] * rotation;
}

bool same_end_sites(const std::vector<EndSite>& a, const std::vector<EndSite>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const EndSite& x, const EndSite& y) {
    return x.parent == y.parent && x.offset == y.offset && x.name == y.name;
  });
}

}  // namespace

bool same_skeleton(const Skeleton& a, const Skeleton& b) {
  return a.names == b.names && a.parents == b.parents && a.offsets == b.offsets &&
         a.rest_rotations == b.rest_rotations && a.channels == b.channels &&
         same_end_sites(a.end_sites, b.end_sites);
}

void check_lengths(const Take& clip) {
  clip.skeleton.validate();
  const std::size_t frames = clip.frame_count();
  if (clip.rotations.size() != frames * clip.joint_count() ||
      clip.positions.size() != frames * clip.point_count()) {
    throw Error(ErrorKind::usage, "the arrays of the clip have different numbers of frames");
  }
  check_frame_rate(clip.frame_rate_hz);
}

// Rejects motion that no channel can express, so that it is not lost silently.
void check_channels(const Take& clip, RestRotations rest) {
  // Tolerance for rounding; chosen by hand, not swept.
  constexpr double tolerance_rad = 1e-6;
  const Skeleton& skeleton = clip.skeleton;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const bool turns = skeleton.rotation_order(j).count > 0;
    const bool moves = skeleton.has_position_channels(j);
    for (std::size_t f = 0; f < clip.frame_count() && !(turns && moves); ++f) {
      const Quat rotation = written_rotation(clip, f, j, rest);
      if (!turns && angle_between(rotation, Quat{}) > tolerance_rad) {
        throw Error(ErrorKind::usage, fmt::format("joint {} turns but has no rotation channels",
                                                  quote(skeleton.names[j])));
      }
      if (!moves && !(joint_position(clip, f, j) == skeleton.offsets[j])) {
        throw Error(ErrorKind::usage, fmt::format("joint {} moves but has no position channels",
                                                  quote(skeleton.names[j])));
      }
    }
  }
}

namespace {

// A value to write, with the data from its joint and channel.
struct Source {
  std::string_view lead;
  std::size_t joint = 0;
  enum { nothing, angle, position } kind = nothing;
  std::size_t turn = 0;  // index of the joint's angle
  Axis axis = Axis::x;
  std::size_t frame = 0;  // index of the position frame
};

Source source_of(const WrittenValue& value, const Take& clip) {
  Source source{value.lead, value.joint};
  if (value.channel == WrittenValue::no_channel) return source;
  const auto& channels = clip.skeleton.channels[value.joint];
  const Channel channel = channels[value.channel];
  source.kind = is_rotation(channel) ? Source::angle : Source::position;
  source.axis = axis_of(channel);
  const auto here = channels.begin() + static_cast<std::ptrdiff_t>(value.channel);
  source.turn = static_cast<std::size_t>(std::count_if(channels.begin(), here, is_rotation));
  source.frame = point_of_joint(clip, value.joint).value_or(0);
  return source;
}

class RowWriter {
 public:
  RowWriter(TextBuffer& out, const Take& clip, const std::vector<WrittenValue>& values,
            const std::vector<PositionFrame>& position_frames, const RowStyle& style)
      : out_(out),
        clip_(clip),
        position_frames_(position_frames),
        style_(style),
        angles_(clip.joint_count()) {
    for (const WrittenValue& value : values) values_.push_back(source_of(value, clip));
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      orders_.push_back(clip.skeleton.rotation_order(j));
    }
  }

  void write() {
    for (std::size_t f = 0; f < clip_.frame_count(); ++f) {
      turn_joints(f);
      if (style_.numbered) {
        out_.append(std::to_string(f + 1));
        out_.append(style_.line_end);
      }
      for (const Source& source : values_) {
        out_.append(source.lead);
        out_.append_fixed(value_of(source, f), style_.decimals);
      }
      out_.append(style_.line_end);
    }
  }

 private:
  void turn_joints(std::size_t frame) {
    for (std::size_t j = 0; j < orders_.size(); ++j) {
      if (orders_[j].count == 0) continue;
      angles_[j] =
          to_euler_near(written_rotation(clip_, frame, j, style_.rest), orders_[j], angles_[j]);
    }
  }

  double value_of(const Source& source, std::size_t frame) const {
    if (source.kind == Source::nothing) return 0;
    if (source.kind == Source::angle) {
      return angles_[source.joint][source.turn] * degrees_per_radian / style_.degrees_per_value;
    }
    const auto translated = static_cast<std::int32_t>(source.frame) - 1;
    return component(position_frames_[source.frame].to_file(position_of(clip_, frame, translated)),
                     source.axis);
  }

  TextBuffer& out_;
  const Take& clip_;
  const std::vector<PositionFrame>& position_frames_;
  const RowStyle& style_;
  std::vector<Source> values_;
  std::vector<RotationOrder> orders_;
  std::vector<std::array<double, 3>> angles_;
};

}  // namespace

void append_rows(TextBuffer& out, const Take& clip, const std::vector<WrittenValue>& values,
                 const std::vector<PositionFrame>& position_frames, const RowStyle& style) {
  RowWriter(out, clip, values, position_frames, style).write();
}

}  // namespace kinemend
