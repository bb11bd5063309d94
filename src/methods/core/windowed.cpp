// Keeps the last frames of a stream, gives each one when its window is complete, and forgets the
// oldest.
#include "methods/core/windowed.hpp"

#include <algorithm>

namespace kinemend {

namespace {

template <class T>
void append_row(std::vector<T>& values, const std::vector<T>& row) {
  values.insert(values.end(), row.begin(), row.end());
}

template <class T>
void drop_rows(std::vector<T>& values, std::size_t rows, std::size_t width) {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rows * width));
}

template <class T>
void copy_row(const std::vector<T>& values, std::size_t row, std::size_t width,
              std::vector<T>& result) {
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(row * width);
  result.assign(first, first + static_cast<std::ptrdiff_t>(width));
}

std::size_t rotations_in(const TakeView& take) { return take.joints ? take.owners : 0; }
std::size_t positions_in(const TakeView& take) { return take.tracks.size() - rotations_in(take); }

std::size_t bridge_frames(const TakeView& like) {
  if (like.gaps == GapTreatment::bridge) return 0;
  return longest_bridge(like.frame_rate_hz) + bridge_support(like.frame_rate_hz) + 1;
}

}  // namespace

WindowedFilter::WindowedFilter(const TakeView& like, std::size_t half)
    : half_(half), bridge_(bridge_frames(like)), view_(like) {
  view_.frames = 0;
}

bool WindowedFilter::push(const Frame& in, Frame& out) {
  append(in);
  if (view_.frames > bridge_) {
    copy(view_.frames - 1 - bridge_, newest_);
    step(newest_);
  }
  if (next_ + lookahead() >= view_.frames) return false;
  give(true, out);
  return true;
}

bool WindowedFilter::flush(Frame& out) {
  if (next_ >= view_.frames) return false;
  give(false, out);
  return true;
}

void WindowedFilter::give(bool has_stepped, Frame& out) {
  copy(next_, out);
  point_at_samples();
  clean(next_, has_stepped, out);
  if (++next_ <= lookahead()) return;
  forget(next_ - lookahead());
  next_ = lookahead();
}

void WindowedFilter::append(const Frame& frame) {
  append_row(rotations_, frame.rotations);
  append_row(positions_, frame.positions);
  if (frame.observed.empty()) {
    observed_.insert(observed_.end(), view_.owners, 1);
  } else {
    append_row(observed_, frame.observed);
  }
  ++view_.frames;
}

void WindowedFilter::forget(std::size_t frames) {
  drop_rows(rotations_, frames, rotations_in(view_));
  drop_rows(positions_, frames, positions_in(view_));
  drop_rows(observed_, frames, view_.owners);
  view_.frames -= frames;
}

void WindowedFilter::point_at_samples() {
  const std::size_t rotations = rotations_in(view_);
  for (std::size_t n = 0; n < view_.tracks.size(); ++n) {
    Track& track = view_.tracks[n];
    track.frames = view_.frames;
    track.rotations = n < rotations ? rotations_.data() + n : nullptr;
    track.positions = n < rotations ? nullptr : positions_.data() + (n - rotations);
    track.stride = n < rotations ? rotations : positions_in(view_);
    track.observed = n < view_.owners ? observed_.data() + n : nullptr;
    track.observed_stride = view_.owners;
  }
}

void WindowedFilter::copy(std::size_t frame, Frame& result) const {
  copy_row(rotations_, frame, rotations_in(view_), result.rotations);
  copy_row(positions_, frame, positions_in(view_), result.positions);
  copy_row(observed_, frame, view_.owners, result.observed);
}

}  // namespace kinemend
