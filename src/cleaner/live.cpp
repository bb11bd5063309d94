// Keeps the last frames of a stream and outputs each one when its window is complete. Pushes a take
// through a live filter frame by frame and collects the tracks that changed.
#include "cleaner/live.hpp"

#include <algorithm>
#include <optional>

namespace kinemend {

namespace {

template <class T>
void append_row(std::vector<T>& values, const std::vector<T>& row) {
  values.insert(values.end(), row.begin(), row.end());
}

template <class T>
void drop_first_row(std::vector<T>& values, std::size_t width) {
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(width));
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
  if (view_.gaps == GapTreatment::bridge) held_.resize(rotations_in(view_));
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
  bridge_from_held();
  point_at_samples();
  clean(next_, has_stepped, out);
  if (++next_ <= lookahead()) return;
  forget_first();
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

void WindowedFilter::forget_first() {
  hold_first();
  drop_first_row(rotations_, rotations_in(view_));
  drop_first_row(positions_, positions_in(view_));
  drop_first_row(observed_, view_.owners);
  --view_.frames;
}

void WindowedFilter::hold_first() {
  for (std::size_t n = 0; n < held_.size(); ++n) {
    Held& held = held_[n];
    if (observed_[n] != 0 && !held.is_in_window) {
      held = {rotations_[n], 1, false};
    } else {
      if (held.frames_before > 0) ++held.frames_before;
      held.is_in_window = false;
    }
  }
}

// If the window's first frame is in a gap, it gets the value of the geodesic across the whole gap
// and is marked as seen. While the gap has no end, that is the last rotation before it.
void WindowedFilter::bridge_from_held() {
  for (std::size_t n = 0; n < held_.size(); ++n) {
    Held& held = held_[n];
    if (held.frames_before == 0 || (observed_[n] != 0 && !held.is_in_window)) continue;
    const std::size_t end = first_seen(n);
    rotations_[n] = held.rotation;
    if (end < view_.frames) {
      const double share =
          static_cast<double>(held.frames_before) / static_cast<double>(held.frames_before + end);
      const Vec3 turn = log(conjugate(held.rotation) * rotations_[end * rotations_in(view_) + n]);
      rotations_[n] = normalized(held.rotation * exp(share * turn));
    }
    observed_[n] = 1;
    held.is_in_window = true;
  }
}

// The first frame of the window after frame 0 in which a rotation is seen; the frame count if none.
std::size_t WindowedFilter::first_seen(std::size_t rotation) const {
  std::size_t frame = 1;
  while (frame < view_.frames && observed_[frame * view_.owners + rotation] == 0) ++frame;
  return std::min(frame, view_.frames);
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

namespace {

// Collects the output of a live filter, track by track.
class Results {
 public:
  explicit Results(const TakeView& take) : take_(take), tracks_(take.tracks.size()) {}

  void add(Frame& out) {
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      if (!take_.tracks[n].selected) continue;
      if (take_.tracks[n].space == Space::rotation) {
        tracks_[n].rotations.push_back(out.rotations[n]);
      } else {
        tracks_[n].positions.push_back(position_in(take_, n, out));
      }
    }
  }

  // Passes on the tracks that the filter changed.
  void hand_over(const TrackSink& sink) {
    for (std::size_t n = 0; n < tracks_.size(); ++n) {
      const Track& source = take_.tracks[n];
      if (!source.selected) continue;
      if (source.space == Space::rotation) {
        if (tracks_[n].rotations == rotations_of(source)) continue;
        sink(n, assemble({n, 0, std::move(tracks_[n].rotations), observed_of(source), {}}));
      } else if (tracks_[n].positions != positions_of(source)) {
        Piece<Vec3> piece{n, 0, std::move(tracks_[n].positions), {}, {}};
        if (take_.gaps == GapTreatment::cut) piece.observed = observed_of(source);
        sink(n, assemble(take_, n, {&piece, 1}));
      }
    }
  }

 private:
  const TakeView& take_;
  std::vector<CleanedTrack> tracks_;
};

// A live filter sees no gaps in joint positions: their bridges are treated as measurements.
std::vector<std::vector<Vec3>> bridged_positions(const TakeView& take) {
  std::vector<std::vector<Vec3>> bridged(take.tracks.size());
  if (take.gaps == GapTreatment::cut) return bridged;
  for (std::size_t n = take.owners; n < take.tracks.size(); ++n) {
    if (take.tracks[n].observed != nullptr)
      bridged[n] = std::move(position_pieces(take, n).front().samples);
  }
  return bridged;
}

// Passes seen samples on and holds the last one in gaps.
template <class Sample>
class HeldSample {
 public:
  Sample step(const Sample& sample, bool seen) {
    if (seen) last_ = sample;
    return last_.value_or(sample);
  }

 private:
  std::optional<Sample> last_;
};

}  // namespace

std::unique_ptr<LiveFilter> gap_holding_filter(const TakeView& like) {
  return causal_filter(like, HeldSample<Quat>(), HeldSample<Vec3>());
}

CleanTrace clean_as_live(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                         const std::function<void(double)>& tell) {
  const auto filter = cleaner.live(take);
  const std::vector<std::vector<Vec3>> bridged = bridged_positions(take);
  Results results(take);
  ShareProgress progress(tell);
  progress.begin_part(1, take.frames);
  Frame out;
  for (std::size_t f = 0; f < take.frames; ++f) {
    Frame in = frame_of(take, f);
    for (std::size_t n = take.owners; n < bridged.size(); ++n) {
      if (!bridged[n].empty()) position_in(take, n, in) = bridged[n][f];
    }
    if (filter->push(in, out)) results.add(out);
    progress.step();
  }
  while (filter->flush(out)) results.add(out);
  results.hand_over(sink);
  return {};
}

}  // namespace kinemend
