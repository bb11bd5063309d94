#include "methods/core/causal.hpp"

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Positions of joints have no gaps for a frame filter: their bridges count like measurements.
std::vector<std::vector<Vec3>> bridged_positions(const TakeView& take) {
  std::vector<std::vector<Vec3>> bridged(take.tracks.size());
  if (take.gaps == GapTreatment::cut) return bridged;
  for (std::size_t n = take.owners; n < take.tracks.size(); ++n) {
    if (take.tracks[n].observed != nullptr)
      bridged[n] = std::move(position_pieces(take, n).front().samples);
  }
  return bridged;
}

}  // namespace

CleanTrace clean_causally(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                          const std::function<void(double)>& tell) {
  const auto filter = cleaner.make_frame_filter(take);
  if (!filter) throw Error(ErrorKind::usage, "this method works on joints, not on markers");
  const std::vector<std::size_t> tracks = changeable_tracks(take);
  const std::vector<std::vector<Vec3>> bridged = bridged_positions(take);
  std::vector<Piece<Quat>> rotations(take.tracks.size());
  std::vector<CleanedTrack> positions(take.tracks.size());
  for (const std::size_t n : tracks) {
    if (take.tracks[n].space == Space::rotation) {
      rotations[n] = {n, 0, std::vector<Quat>(take.frames), {}, {}};
      rotations[n].observed = observed_of(take.tracks[n]);
    } else {
      positions[n].positions.resize(take.frames);
    }
  }
  ShareProgress progress(tell);
  progress.begin_part(1, take.frames);
  for (std::size_t f = 0; f < take.frames; ++f) {
    Frame frame = frame_of(take, f);
    for (std::size_t n = 0; n < bridged.size(); ++n) {
      if (!bridged[n].empty()) position_in(take, n, frame) = bridged[n][f];
    }
    filter->filter(frame);
    for (const std::size_t n : tracks) {
      if (take.tracks[n].space == Space::rotation) {
        rotations[n].samples[f] = frame.rotations[n];
      } else {
        positions[n].positions[f] = position_in(take, n, frame);
      }
    }
    progress.step();
  }
  for (const std::size_t n : tracks) {
    const bool turns = take.tracks[n].space == Space::rotation;
    sink(n, turns ? assemble(std::move(rotations[n])) : std::move(positions[n]));
  }
  return {};
}

}  // namespace kinemend
