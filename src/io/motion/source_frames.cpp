// Decodes the frames of a document in blocks, and repeats the reader's repairs.
#include "io/motion/source_frames.hpp"

#include <algorithm>

namespace kinemend {

SourceFrames::SourceFrames(const MotionDocument& document)
    : document_(document),
      columns_(document.skeleton),
      last_rotations_(document.first_rotations),
      last_positions_(document.first_positions),
      text_(document.rows()) {}

bool SourceFrames::next(SourceBlock& block) {
  block.first = next_;
  block.count = std::min(columns_.block_frames(), document_.frame_count - next_);
  block.width = columns_.count();
  block.joints = document_.skeleton.joint_count();
  if (block.count == 0) return false;
  next_ += block.count;
  block.values.resize(block.count * block.width);
  block.places.resize(block.count * block.width);
  block.turns.resize(block.count * block.joints);
  text_->next(block.values.data(), block.count, block.places.data());
  columns_.decode_rotations(block.values.data(), block.count, block.turns.data());
  if (document_.has_gaps) hold(block);
  return true;
}

void SourceFrames::hold(SourceBlock& block) {
  hold_rotations(block.turns.data(), block.count, block.joints, last_rotations_.data(), nullptr);
  hold_positions(block.values.data(), block.count, columns_, last_positions_);
  const Quat* const last = block.rotations(block.count - 1);
  last_rotations_.assign(last, last + block.joints);
  for (std::size_t i = 0; i < last_positions_.size(); ++i) {
    last_positions_[i] = block.row(block.count - 1)[columns_.positions()[i].column];
  }
}

unsigned MotionDocument::written_decimals() const {
  // Chosen by hand.
  constexpr unsigned least = 4, least_of_radians = 6, most = 9;
  return std::clamp(decimals, degrees_per_value == 1 ? least : least_of_radians, most);
}

std::vector<double> MotionDocument::channel_values() const {
  std::vector<double> values;
  SourceFrames source(*this);
  SourceBlock block;
  values.reserve(frame_count * source.columns().count());
  while (source.next(block)) {
    values.insert(values.end(), block.values.begin(), block.values.end());
  }
  return values;
}

}  // namespace kinemend
