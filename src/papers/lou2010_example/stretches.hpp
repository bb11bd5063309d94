// Cuts a long sequence into overlapping stretches, so that memory does not grow with its length.
#pragma once

#include <cstddef>

#include "papers/lou2010_example/window_bases.hpp"

namespace kinemend {

/// Long sequences are filtered in overlapping stretches of one length, so that memory is
/// independent of their length. Stretches begin where windows begin; the last one may reach less
/// than a hop beyond the end.
class Stretches {
 public:
  /// Cuts a sequence of `frames`, at least `bases.frames`. `margin_windows`: windows at each end of
  /// a stretch that take the neighbour's result.
  Stretches(const WindowBases& bases, std::size_t frames, std::size_t margin_windows);

  std::size_t count() const noexcept { return count_; }
  /// The length of every stretch.
  std::size_t frames() const noexcept { return length_; }
  /// The first frame of a stretch, and the end of its frames that are in the sequence.
  std::size_t begin(std::size_t stretch) const;
  std::size_t end(std::size_t stretch) const;
  /// The stretch gives the frames [first(s), first(s + 1)) of the result.
  std::size_t first(std::size_t stretch) const;

 private:
  std::size_t frames_, length_, hop_, count_ = 1;
};

}  // namespace kinemend
