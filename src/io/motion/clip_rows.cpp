// Appends rows to a take, and fills values that are missing from the frames beside them.
#include "io/motion/clip_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/reading_limits.hpp"
#include "io/text/number.hpp"

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

void ClipRows::append(double* rows, std::size_t count, bool with_gaps) {
  const std::size_t first = frames();
  clip_.rotations.resize((first + count) * joints_);
  Quat* const rotations = clip_.rotations.data() + first * joints_;
  columns_.decode_rotations(rows, count, rotations);
  if (with_gaps) hold(rows, count, rotations);
  append_positions(rows, count);
}

void ClipRows::hold(double* rows, std::size_t count, Quat* rotations) {
  const std::size_t first = frames();
  clip_.observed.resize((first + count) * joints_, 1);
  const std::vector<Quat> unknown(first == 0 ? joints_ : 0, Quat{not_a_number, 0, 0, 0});
  hold_rotations(rotations, count, joints_, first == 0 ? unknown.data() : rotations - joints_,
                 clip_.observed.data() + first * joints_);
  std::vector<double> previous;
  for (const auto& position : columns_.positions()) {
    previous.push_back(first == 0 ? not_a_number : value(first - 1, position));
  }
  hold_positions(rows, count, columns_, previous);
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

// Samples before the first finite sample take its value; without a finite sample, the rest pose.
void ClipRows::fill_leading_gaps() {
  if (clip_.observed.empty()) return;
  clip_.observed.resize(frames() * joints_, 1);
  for (std::size_t j = 0; j < joints_; ++j) {
    std::size_t known = 0;
    while (known < frames() && is_gap(clip_.rotation(known, j))) ++known;
    const Quat sample = known < frames() ? clip_.rotation(known, j) : Quat{};
    for (std::size_t f = 0; f < known; ++f) clip_.rotation(f, j) = sample;
  }
  for (const auto& position : columns_.positions()) fill_leading_positions(position);
  const auto& observed = clip_.observed;
  if (std::find(observed.begin(), observed.end(), 0) == observed.end()) clip_.observed.clear();
}

void ClipRows::fill_leading_positions(const MotionColumns::Position& position) {
  std::size_t known = 0;
  while (known < frames() && std::isnan(value(known, position))) ++known;
  const double sample =
      known < frames() ? value(known, position) : component(frame_of(position).rest, position.axis);
  for (std::size_t f = 0; f < known; ++f) value(f, position) = sample;
}

void ClipRows::finish(MotionDocument& document, bool has_gaps) {
  fill_leading_gaps();
  document.has_gaps = has_gaps && frames() > 0;
  if (document.has_gaps) {
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
