#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "kinemend/cleaner.hpp"
#include "rotation/sample_steps.hpp"

// What windowed cleaners do live amid a take without gaps: a step a frame, of which each takes a
// sample in and gives the filtered one that is half a window behind. The results are those of
// `Cleaner::clean_frame`, for less work and without memory from the heap.
namespace kinemend {

/// The last samples of a track, one behind the other. Takes memory when it is made only.
template <class Sample>
class SlidingWindow {
 public:
  explicit SlidingWindow(std::size_t length) : length_(length), samples_(2 * length) {}

  /// Forgets the oldest.
  void push(const Sample& sample) {
    // Each stands twice, so that any `length_` in a row are there in one piece.
    samples_[place_] = samples_[place_ + length_] = sample;
    place_ = (place_ + 1) % length_;
  }
  /// `length` samples, the oldest first; those that have not come yet are as they were made.
  std::span<const Sample> samples() const {
    return std::span<const Sample>(samples_).subspan(place_, length_);
  }

 private:
  std::size_t length_;
  std::vector<Sample> samples_;
  std::size_t place_ = 0;
};

/// The state of a windowed cleaner on one stream, where nothing is missing.
class InnerFilter {
 public:
  virtual ~InnerFilter() = default;
  /// Takes the next frame. `out`, which holds the one of `half_window_frames` before as it came, is
  /// cleaned; false, and what it holds means nothing, where a gap or the start of the stream is
  /// within half a window of a sample to be cleaned.
  virtual bool filter(const Frame& in, Frame& out) = 0;
};

/// A cleaner of `LiveSupport::windowed` with such a state.
class WindowedCleaner : public Cleaner {
 public:
  /// For takes like this one, whose frames do not matter; nullptr where there is none.
  virtual std::unique_ptr<InnerFilter> make_inner_filter(const TakeView& like) const = 0;
};

/// Tracks by themselves: `step(sample)` of a track returns the filtered sample of `half` before.
template <class RotationStep, class PositionStep>
class TrackInnerFilter final : public InnerFilter {
 public:
  /// A step of each track by `rotation(track)` or `position(track)`.
  template <class MakeRotation, class MakePosition>
  TrackInnerFilter(const TakeView& like, std::size_t half, const MakeRotation& rotation,
                   const MakePosition& position)
      : whole_(2 * half + 1), missing_may_stay_(like.gaps == GapTreatment::cut) {
    for (const Track& track : like.tracks) {
      if (track.space == Space::rotation) {
        rotations_.push_back({rotation(track), {track.selected}});
      } else {
        positions_.push_back({position(track), {track.selected}});
      }
    }
  }

  bool filter(const Frame& in, Frame& out) override {
    bool is_whole = true;
    for (std::size_t j = 0; j < rotations_.size(); ++j)
      is_whole &= step(rotations_[j], in, j, in.rotations[j], out, out.rotations[j]);
    for (std::size_t i = 0; i < positions_.size(); ++i)
      is_whole &= step(positions_[i], in, i, in.positions[i], out, out.positions[i]);
    return is_whole;
  }

 private:
  struct Own {
    bool is_selected = true;
    std::size_t seen = 0;  ///< samples in a row
  };
  template <class Step>
  struct TrackState {
    Step step;
    Own own;
  };

  // Positions of joints have no gaps.
  template <class Step>
  bool is_seen(const TrackState<Step>&, const Frame& frame, std::size_t owner) const {
    if (std::is_same_v<Step, PositionStep> && !rotations_.empty()) return true;
    return frame.observed.empty() || frame.observed[owner] != 0;
  }

  template <class Step, class Sample>
  bool step(TrackState<Step>& track, const Frame& in, std::size_t owner, const Sample& sample,
            const Frame& out, Sample& result) {
    if (!track.own.is_selected) return true;
    const bool seen = is_seen(track, in, owner);
    track.own.seen = seen ? track.own.seen + 1 : 0;
    const Sample filtered = track.step.step(sample);
    if (track.own.seen >= whole_) {
      result = filtered;
      return true;
    }
    // A marker that is missing stays so.
    return missing_may_stay_ && !is_seen(track, out, owner);
  }

  std::size_t whole_;
  bool missing_may_stay_;
  std::vector<TrackState<RotationStep>> rotations_;
  std::vector<TrackState<PositionStep>> positions_;
};

/// Of `Step<Quat>` and `Step<Vec3>`, each made by `make(track)` of a generic function object that
/// is told the kind of sample by a default value of it.
template <template <class> class Step, class Make>
std::unique_ptr<InnerFilter> make_track_inner_filter(const TakeView& like, std::size_t half,
                                                     const Make& make) {
  return std::make_unique<TrackInnerFilter<Step<Quat>, Step<Vec3>>>(
      like, half, [&](const Track& track) { return make(track, Quat{}); },
      [&](const Track& track) { return make(track, Vec3{}); });
}

}  // namespace kinemend
