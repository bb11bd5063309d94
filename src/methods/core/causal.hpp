#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "methods/core/pieces.hpp"

// What causal cleaners share.
namespace kinemend {

/// Runs the frame filter of a causal cleaner over the take, from its first frame to its last, and
/// hands the changeable tracks over. Errors: `ErrorKind::usage` where it does not work on this kind
/// of take.
CleanTrace clean_causally(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                          const std::function<void(double)>& tell);

/// A frame filter that treats each track by itself, by a filter of its own:
/// `step(sample, seen)` returns the cleaned sample. Where gaps are cut, a track starts afresh after
/// one longer than `longest_bridge`.
template <class RotationStep, class PositionStep>
class TrackFrameFilter final : public FrameFilter {
 public:
  /// A copy of `rotation` or `position` for each track.
  TrackFrameFilter(const TakeView& like, const RotationStep& rotation, PositionStep position)
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

  void filter(Frame& frame) override {
    for (std::size_t j = 0; j < rotations_.size(); ++j)
      frame.rotations[j] = rotations_[j].step(frame.rotations[j], is_seen(frame, j));
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      Positions& own = positions_[i];
      if (!own.selected) continue;
      const bool seen = !cuts_gaps_ || is_seen(frame, i);
      if (seen && own.missing > longest_) own.step = start_;
      own.missing = seen ? 0 : own.missing + 1;
      const Vec3 result = own.step.step(seen ? frame.positions[i] : Vec3{}, seen);
      if (seen) frame.positions[i] = result;
    }
  }

 private:
  struct Positions {
    PositionStep step;
    bool selected;
    std::size_t missing;  ///< frames since it was seen
  };

  static bool is_seen(const Frame& frame, std::size_t owner) {
    return frame.observed.empty() || frame.observed[owner] != 0;
  }

  PositionStep start_;
  bool cuts_gaps_;
  std::size_t longest_;
  std::vector<RotationStep> rotations_;
  std::vector<Positions> positions_;
};

/// Where both kinds of sample are filtered by `Step<Quat>` and `Step<Vec3>`.
template <template <class> class Step>
std::unique_ptr<FrameFilter> make_track_filter(const TakeView& like, const Step<Quat>& rotation,
                                               const Step<Vec3>& position) {
  return std::make_unique<TrackFrameFilter<Step<Quat>, Step<Vec3>>>(like, rotation, position);
}

}  // namespace kinemend
