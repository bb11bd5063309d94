// Finds the length and the margins of stretches.
#include "papers/lou2010_example/stretches.hpp"

#include <algorithm>

namespace kinemend {

namespace {

// A vector of a stretch is about 2 MB. Limits memory; not swept.
constexpr std::size_t values_at_once = std::size_t{1} << 18;
// Length in margins, which limits the repeated work. For speed, not swept.
constexpr std::size_t least_lengths = 4;

}  // namespace

Stretches::Stretches(const WindowBases& bases, std::size_t frames, std::size_t margin_windows)
    : frames_(frames), length_(frames), hop_(bases.hop) {
  const std::size_t margin = margin_windows * bases.frames;
  const std::size_t most =
      std::max({values_at_once / bases.channels, 2 * least_lengths * margin, bases.frames});
  if (frames <= most) return;
  length_ = bases.frames + (most - bases.frames) / hop_ * hop_;
  const std::size_t fresh = length_ - 2 * margin;
  count_ = 1 + (frames - length_ + fresh - 1) / fresh;
}

std::size_t Stretches::begin(std::size_t stretch) const {
  if (count_ == 1) return 0;
  const std::size_t hops = (frames_ - length_ + hop_ - 1) / hop_;
  return stretch * hops / (count_ - 1) * hop_;
}

std::size_t Stretches::end(std::size_t stretch) const {
  return std::min(frames_, begin(stretch) + length_);
}

std::size_t Stretches::first(std::size_t stretch) const {
  if (stretch == 0) return 0;
  if (stretch == count_) return frames_;
  return (begin(stretch) + end(stretch - 1)) / 2;
}

}  // namespace kinemend
