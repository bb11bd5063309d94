// Runs methods live: `windowed_filter` those whose result depends on `half` frames on either side
// of a frame and on nothing else, `causal_filter` those that step through each track.
// `clean_as_live` runs any live filter offline.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "cleaner/pieces.hpp"

namespace kinemend {

/// The last samples of a track, one after the other. Allocates only when constructed.
template <class Sample>
class SlidingWindow {
 public:
  explicit SlidingWindow(std::size_t length) : length_(length), samples_(2 * length) {}

  /// Drops the oldest.
  void push(const Sample& sample) {
    // Each sample is stored twice, so that any `length_` consecutive ones are contiguous.
    samples_[place_] = samples_[place_ + length_] = sample;
    place_ = (place_ + 1) % length_;
  }
  /// `length` samples, the oldest first; samples not yet pushed have their initial value.
  std::span<const Sample> samples() const {
    return std::span<const Sample>(samples_).subspan(place_, length_);
  }

 private:
  std::size_t length_;
  std::vector<Sample> samples_;
  std::size_t place_ = 0;
};

/// Keeps the frames that the next result depends on; there are fewer at the ends of the stream, as
/// at the ends of a take. A gap of a joint that begins before the window keeps the last rotation
/// seen, so that gaps longer than the window are bridged, too.
class WindowedFilter : public LiveFilter {
 public:
  /// If gaps are cut, a filter also waits for the longest gap that is bridged, and for the frames
  /// after it that its bridge uses.
  WindowedFilter(const TakeView& like, std::size_t half);

  std::size_t lookahead() const final { return half_ + bridge_; }
  bool push(const Frame& in, Frame& out) final;
  bool flush(Frame& out) final;

 protected:
  /// Takes every frame of the stream, `half` frames before `clean` is called for it.
  virtual void step(const Frame& /*newest*/) {}
  /// Cleans `out`, which holds the input frame `frame` of the window. `has_stepped`: the last
  /// `step` took the frame `half` after it; false once the stream has ended.
  virtual void clean(std::size_t frame, bool has_stepped, Frame& out) = 0;

  std::size_t half() const { return half_; }
  /// The kept frames, as a take. Its samples may be read within `clean` only.
  const TakeView& window() const { return view_; }

 private:
  // A joint's last rotation seen before the window.
  struct Held {
    Quat rotation;
    std::size_t frames_before = 0;  // distance to the first kept frame; 0: none was seen
    bool is_in_window = false;      // the window's first frame has a bridge instead of its own
  };

  void append(const Frame& frame);
  void forget_first();
  void hold_first();
  void bridge_from_held();
  std::size_t first_seen(std::size_t rotation) const;
  void point_at_samples();
  void copy(std::size_t frame, Frame& result) const;
  void give(bool has_stepped, Frame& out);

  std::size_t half_, bridge_;
  TakeView view_;  // refers to the three arrays below, which hold one row per frame
  std::vector<Quat> rotations_;
  std::vector<Vec3> positions_;
  std::vector<std::uint8_t> observed_;
  std::vector<Held> held_;  // one for each rotation whose gaps are bridged
  std::size_t next_ = 0;    // the frame of the window that is output next
  Frame newest_;
};

/// A window whose tracks are filtered separately.
template <template <class> class Step, class Filter>
class WindowedTracks final : public WindowedFilter {
 public:
  template <class MakeStep>
  WindowedTracks(const TakeView& like, std::size_t half, const MakeStep& make_step, Filter filter)
      : WindowedFilter(like, half), filter_(std::move(filter)), is_ragged_(like.tracks.size()) {
    for (const Track& track : like.tracks) {
      if (track.space == Space::rotation) {
        rotations_.push_back({make_step(track, Quat{})});
      } else {
        positions_.push_back({make_step(track, Vec3{})});
      }
    }
  }

 private:
  template <class Sample>
  struct Stepped {
    Step<Sample> step;
    Sample filtered{};     // the last result of the step
    std::size_t seen = 0;  // consecutive seen samples
  };

  // Positions of joints have no gaps.
  static bool is_seen(const TakeView& take, std::size_t track, const Frame& frame) {
    return track >= take.owners || frame.is_observed(track);
  }

  void step(const Frame& newest) override {
    for (std::size_t n = 0; n < window().tracks.size(); ++n) {
      if (!window().tracks[n].selected) continue;
      const bool seen = is_seen(window(), n, newest);
      const std::size_t i = n - rotations_.size();
      if (n < rotations_.size()) {
        advance(rotations_[n], newest.rotations[n], seen);
      } else {
        advance(positions_[i], newest.positions[i], seen);
      }
    }
  }

  template <class Sample>
  static void advance(Stepped<Sample>& track, const Sample& sample, bool seen) {
    track.seen = seen ? track.seen + 1 : 0;
    track.filtered = track.step.step(sample);
  }

  void clean(std::size_t frame, bool has_stepped, Frame& out) override {
    bool any_ragged = false;
    for (std::size_t n = 0; n < window().tracks.size(); ++n) {
      is_ragged_[n] = 0;
      if (!window().tracks[n].selected) continue;
      if (has_stepped && take_stepped(n, out)) continue;
      // A missing marker stays missing.
      if (window().gaps == GapTreatment::cut && !is_seen(window(), n, out)) continue;
      is_ragged_[n] = 1;
      any_ragged = true;
    }
    if (any_ragged) clean_ragged(frame, out);
  }

  // Takes the result of the step; false if a sample of the window is missing.
  bool take_stepped(std::size_t n, Frame& out) const {
    const std::size_t i = n - rotations_.size(), whole = 2 * half() + 1;
    if (n < rotations_.size()) {
      if (rotations_[n].seen < whole) return false;
      out.rotations[n] = rotations_[n].filtered;
    } else {
      if (positions_[i].seen < whole) return false;
      out.positions[i] = positions_[i].filtered;
    }
    return true;
  }

  void clean_ragged(std::size_t frame, Frame& out) const {
    const TakeView& take = window();
    for (const std::size_t n : changeable_tracks(take)) {
      if (is_ragged_[n] == 0) continue;
      if (n < rotations_.size()) {
        out.rotations[n] = filtered_at(rotation_piece(take, n), frame);
        continue;
      }
      for (const Piece<Vec3>& piece : position_pieces(take, n)) {
        const std::size_t end = piece.first_frame + piece.samples.size();
        if (frame >= piece.first_frame && frame < end)
          out.positions[n - rotations_.size()] = filtered_at(piece, frame);
      }
    }
  }

  template <class Sample>
  Sample filtered_at(const Piece<Sample>& piece, std::size_t frame) const {
    const std::size_t i = frame - piece.first_frame;
    Piece<Sample> about =
        stretch(piece, i - std::min(i, half()), std::min(i + half() + 1, piece.samples.size()));
    filter_(about);
    return about.samples[frame - about.first_frame];
  }

  Filter filter_;
  std::vector<Stepped<Quat>> rotations_;
  std::vector<Stepped<Vec3>> positions_;
  std::vector<std::uint8_t> is_ragged_;  // per track: the step has no result for this frame
};

/// The live form of a method that filters tracks separately, with `half` frames on either side.
/// `make_step(track, sample)` makes a `Step<Quat>` or `Step<Vec3>`, matching the sample;
/// `filter(piece)` is the function that `filter_pieces` runs offline.
template <template <class> class Step, class MakeStep, class Filter>
std::unique_ptr<LiveFilter> windowed_filter(const TakeView& like, std::size_t half,
                                            const MakeStep& make_step, Filter filter) {
  return std::make_unique<WindowedTracks<Step, Filter>>(like, half, make_step, std::move(filter));
}

/// Cleans a take by the live filter of a cleaner, so that live and offline results are the same:
/// pushes every frame, and passes on the tracks that change. Errors: as of `Cleaner::live`.
CleanTrace clean_as_live(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                         const std::function<void(double)>& tell);

/// A causal filter that treats each track separately: `step(sample, seen)` returns the cleaned
/// sample. If gaps are cut, a track restarts after one longer than `longest_bridge`.
template <class RotationStep, class PositionStep>
class CausalTracks final : public LiveFilter {
 public:
  /// A copy of `rotation` or `position` for each track.
  CausalTracks(const TakeView& like, const RotationStep& rotation, PositionStep position)
      : start_(std::move(position)),
        cuts_gaps_(like.gaps == GapTreatment::cut),
        longest_(longest_bridge(like.frame_rate_hz)) {
    for (const Track& track : like.tracks) {
      if (track.space == Space::rotation) {
        rotations_.push_back(rotation);
      } else {
        positions_.push_back({start_, track.selected, 0});
      }
    }
  }

  std::size_t lookahead() const override { return 0; }

  bool push(const Frame& in, Frame& out) override {
    out = in;
    for (std::size_t j = 0; j < rotations_.size(); ++j)
      out.rotations[j] = rotations_[j].step(in.rotations[j], in.is_observed(j));
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      Positions& own = positions_[i];
      if (!own.selected) continue;
      const bool seen = !cuts_gaps_ || in.is_observed(i);
      if (seen && own.missing > longest_) own.step = start_;
      own.missing = seen ? 0 : own.missing + 1;
      const Vec3 result = own.step.step(seen ? in.positions[i] : Vec3{}, seen);
      if (seen) out.positions[i] = result;
    }
    return true;
  }

  bool flush(Frame&) override { return false; }

 private:
  struct Positions {
    PositionStep step;
    bool selected;
    std::size_t missing;  ///< frames since the track was seen
  };

  PositionStep start_;
  bool cuts_gaps_;
  std::size_t longest_;
  std::vector<RotationStep> rotations_;
  std::vector<Positions> positions_;
};

/// A filter that changes no seen sample: an unseen joint keeps the last rotation seen.
std::unique_ptr<LiveFilter> gap_holding_filter(const TakeView& like);

/// The causal filter with a `Step<Quat>` and a `Step<Vec3>` for each track.
template <template <class> class Step>
std::unique_ptr<LiveFilter> causal_filter(const TakeView& like, const Step<Quat>& rotation,
                                          const Step<Vec3>& position) {
  return std::make_unique<CausalTracks<Step<Quat>, Step<Vec3>>>(like, rotation, position);
}

}  // namespace kinemend
