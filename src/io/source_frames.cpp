#include "io/source_frames.hpp"

#include <algorithm>

namespace kinemend {

SourceFrames::SourceFrames(const MotionDocument& document)
    : document_(document),
      columns_(document.skeleton),
      joints_(document.skeleton.joint_count()),
      rows_(columns_.block_frames() * columns_.count()),
      tokens_(rows_.size()),
      rotations_(columns_.block_frames() * joints_),
      last_rotations_(document.first_rotations),
      last_positions_(document.first_positions),
      text_(document.rows()) {}

bool SourceFrames::next() {
  first_ += count_;
  count_ = std::min(columns_.block_frames(), document_.frame_count - first_);
  if (count_ == 0) return false;
  text_->next(rows_.data(), count_, tokens_.data());
  columns_.decode_rotations(rows_.data(), count_, rotations_.data());
  if (document_.has_gaps) hold();
  return true;
}

void SourceFrames::hold() {
  hold_rotations(rotations_.data(), count_, joints_, last_rotations_.data(), nullptr);
  hold_positions(rows_.data(), count_, columns_, last_positions_);
  last_rotations_.assign(rotations(count_ - 1), rotations(count_ - 1) + joints_);
  for (std::size_t i = 0; i < last_positions_.size(); ++i) {
    last_positions_[i] = row(count_ - 1)[columns_.positions()[i].column];
  }
}

unsigned MotionDocument::written_decimals() const {
  constexpr unsigned least = 4, least_of_radians = 6, most = 9;
  return std::clamp(decimals, degrees_per_value == 1 ? least : least_of_radians, most);
}

std::vector<double> MotionDocument::channel_values() const {
  std::vector<double> values;
  SourceFrames source(*this);
  const std::size_t width = source.columns().count();
  values.reserve(frame_count * width);
  while (source.next()) {
    values.insert(values.end(), source.row(0), source.row(0) + source.count() * width);
  }
  return values;
}

}  // namespace kinemend
