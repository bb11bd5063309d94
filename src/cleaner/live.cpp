// Pushes a take through a live filter frame by frame and collects the tracks that changed.
#include "cleaner/live.hpp"

#include <optional>

namespace kinemend {

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
