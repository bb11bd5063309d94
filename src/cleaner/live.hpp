// Methods that process a take from its first frame to its last: causal ones, track by track, and
// the offline run of any live filter.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "cleaner/pieces.hpp"

namespace kinemend {

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
      out.rotations[j] = rotations_[j].step(in.rotations[j], is_seen(in, j));
    for (std::size_t i = 0; i < positions_.size(); ++i) {
      Positions& own = positions_[i];
      if (!own.selected) continue;
      const bool seen = !cuts_gaps_ || is_seen(in, i);
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

  static bool is_seen(const Frame& frame, std::size_t owner) {
    return frame.observed.empty() || frame.observed[owner] != 0;
  }

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
