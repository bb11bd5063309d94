// Appends rows to a take, and fills values that are missing from the frames beside them.
#include "io/motion/clip_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/held_samples.hpp"
#include "io/reading_limits.hpp"

namespace kinemend {

ClipRows::ClipRows(Take& clip, std::vector<PositionFrame> position_frames, std::size_t file_bytes)
    : clip_(clip),
      columns_(clip.skeleton),
      position_frames_(std::move(position_frames)),
      joints_(clip.joint_count()),
      memory_limit_(memory_limit(file_bytes)) {
  clip_.translated_joints.assign(columns_.translated_joints().begin(),
                                 columns_.translated_joints().end());
}

std::size_t ClipRows::bytes_per_frame() const {
  return joints_ * sizeof(Quat) + clip_.point_count() * sizeof(Vec3);
}

bool ClipRows::fits(std::size_t frames) const {
  return frames * bytes_per_frame() <= memory_limit_;
}

void ClipRows::reserve(std::size_t expected, std::size_t most) {
  const std::size_t count = std::min({expected, most, memory_limit_ / bytes_per_frame()});
  clip_.rotations.reserve(count * joints_);
  clip_.positions.reserve(count * clip_.point_count());
}

void ClipRows::append(const double* rows, std::size_t count) {
  const std::size_t first = frames();
  clip_.rotations.resize((first + count) * joints_);
  columns_.decode_rotations(rows, count, clip_.rotations.data() + first * joints_);
  append_positions(rows, count);
}

// Appends positions as in the file; `finish` converts them to the clip's frame.
void ClipRows::append_positions(const double* rows, std::size_t count) {
  const std::size_t first = frames();
  for (std::size_t f = 0; f < count; ++f) {
    for (const PositionFrame& frame : position_frames_) clip_.positions.push_back(frame.rest);
  }
  for (std::size_t f = 0; f < count; ++f) {
    for (const auto& position : columns_.positions()) {
      value(first + f, position) = rows[f * columns_.count() + position.column];
    }
  }
}

// A track without a finite sample gets the rest pose.
void ClipRows::hold_gaps() {
  auto& rotations = clip_.rotations;
  if (std::any_of(rotations.begin(), rotations.end(), [](Quat q) { return is_missing(q); })) {
    for (const Quat& q : rotations) clip_.observed.push_back(is_missing(q) ? 0 : 1);
    for (std::size_t j = 0; j < joints_; ++j) hold_missing(rotations, j, joints_, Quat{});
  }
  for (const auto& position : columns_.positions()) {
    double held = component(frame_of(position).rest, position.axis);
    for (std::size_t f = frames(); f-- > 0;) {
      if (!std::isnan(value(f, position))) held = value(f, position);
    }
    for (std::size_t f = 0; f < frames(); ++f) {
      double& sample = value(f, position);
      if (std::isnan(sample)) sample = held;
      held = sample;
    }
  }
}

void ClipRows::finish(MotionDocument& document, bool has_gaps) {
  document.has_gaps = has_gaps && frames() > 0;
  if (document.has_gaps) {
    hold_gaps();
    document.first_rotations.assign(clip_.rotations.begin(),
                                    clip_.rotations.begin() + static_cast<std::ptrdiff_t>(joints_));
    for (const auto& position : columns_.positions()) {
      document.first_positions.push_back(value(0, position));
    }
  }
  for (std::size_t i = 0; i < position_frames_.size(); ++i) {
    const PositionFrame& frame = position_frames_[i];
    if (frame.is_direct()) continue;
    for (std::size_t f = 0; f < frames(); ++f) {
      Vec3& position = position_of(clip_, f, static_cast<std::int32_t>(i) - 1);
      position = frame.to_clip(position);
    }
  }
  document.position_frames = position_frames_;
}

}  // namespace kinemend
