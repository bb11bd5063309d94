#include "methods/core/live_cleaning.hpp"

#include <cstddef>
#include <utility>
#include <vector>

#include "base/progress.hpp"
#include "methods/core/pieces.hpp"

namespace kinemend {

CleanTrace clean_as_live(const Cleaner& cleaner, const TakeView& take, const TrackSink& sink,
                         const std::function<void(double)>& tell) {
  const auto filter = cleaner.make_delayed_filter(take);
  const std::size_t rotations = take.joints != nullptr ? take.owners : 0;
  std::vector<CleanedTrack> results(take.tracks.size());
  Frame out;
  const auto keep = [&] {
    for (std::size_t n = 0; n < results.size(); ++n) {
      if (!take.tracks[n].selected) continue;
      if (n < rotations) {
        results[n].rotations.push_back(out.rotations[n]);
      } else {
        results[n].positions.push_back(out.positions[n - rotations]);
      }
    }
  };
  ShareProgress progress(tell);
  progress.begin_part(1, take.frames);
  for (std::size_t f = 0; f < take.frames; ++f) {
    if (filter->push(frame_of(take, f), out)) keep();
    progress.step();
  }
  while (filter->flush(out)) keep();
  for (std::size_t n = 0; n < results.size(); ++n) {
    if (!take.tracks[n].selected) continue;
    if (n < rotations) {
      if (results[n].rotations == rotations_of(take.tracks[n])) continue;
      sink(n, assemble({n, 0, std::move(results[n].rotations), observed_of(take.tracks[n]), {}}));
    } else if (results[n].positions != positions_of(take.tracks[n])) {
      Piece<Vec3> piece{n, 0, std::move(results[n].positions), observed_of(take.tracks[n]), {}};
      sink(n, assemble(take, n, {&piece, 1}));
    }
  }
  return {};
}

}  // namespace kinemend
