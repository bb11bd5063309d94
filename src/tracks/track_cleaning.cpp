#include "tracks/track_cleaning.hpp"

#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "tracks/noise_shape.hpp"
#include "tracks/spikes.hpp"
#include "tracks/track_smoother.hpp"

namespace kinemend {

namespace {

constexpr double least_travel = 3;  // over the deviation about the line

// The straight line of least squares through a track: travel and steady turning are no part of what
// is smoothed, or a take that turns would be smoothed otherwise than one that does not. A track
// that gets no farther than three deviations about its line goes to and fro: its line is chance,
// and taking it off costs up to some percent.
struct Travel {
  Vec3 middle, velocity;  // of the middle frame, and per frame
  double middle_frame = 0;

  Vec3 at(std::size_t frame) const {
    return middle + (static_cast<double>(frame) - middle_frame) * velocity;
  }
};

Travel travel_of(const VectorTracks& tracks, std::size_t track) {
  const auto count = static_cast<double>(tracks.frames());
  const Vec3 origin = tracks.at(0, track);
  Travel travel{{}, {}, (count - 1) / 2};
  double squares = 0;
  for (std::size_t f = 0; f < tracks.frames(); ++f) {
    const double t = static_cast<double>(f) - travel.middle_frame;
    const Vec3 way = tracks.at(f, track) - origin;
    travel.middle += (1 / count) * way;
    travel.velocity += t * way;
    squares += t * t;
  }
  travel.middle += origin;
  travel.velocity = (1 / squares) * travel.velocity;
  double rest = 0;
  for (std::size_t f = 0; f < tracks.frames(); ++f) {
    const Vec3 off_line = tracks.at(f, track) - travel.at(f);
    rest += dot(off_line, off_line);
  }
  if (norm(travel.velocity) * count < least_travel * std::sqrt(rest / count)) travel.velocity = {};
  return travel;
}

std::vector<Travel> take_travel(VectorTracks& tracks) {
  std::vector<Travel> travels(tracks.tracks());
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    travels[n] = travel_of(tracks, n);
    for (std::size_t t = 0; t < tracks.frames(); ++t)
      tracks.set(t, n, tracks.at(t, n) - travels[n].at(t));
  });
  return travels;
}

void give_travel_back(VectorTracks& tracks, const std::vector<Travel>& travels) {
  for_each_parallel(tracks.tracks(), tracks.values.size(), [&](std::size_t n) {
    for (std::size_t t = 0; t < tracks.frames(); ++t)
      tracks.set(t, n, tracks.at(t, n) + travels[n].at(t));
  });
}

}  // namespace

CleanedTracks clean_tracks(VectorTracks& tracks, const SampleMarks& suspects,
                           const SampleMarks& always_missing,
                           const std::vector<std::vector<std::size_t>>& nearby,
                           double frame_rate_hz, const TrackCleaningSettings& settings,
                           ShareProgress* progress) {
  const std::vector<Travel> travels = take_travel(tracks);
  const std::vector<NoiseShape> shapes = noise_shapes(tracks, always_missing, frame_rate_hz);
  make_round(tracks, shapes);
  CleanedTracks verdicts{SampleMarks(tracks.frames(), tracks.tracks()), {}, {}};
  if (settings.despike) {
    SpikeVerdicts found =
        find_spikes(tracks, suspects, nearby, frame_rate_hz, &always_missing, progress);
    verdicts.marked = std::move(found.marked);
    verdicts.noise = std::move(found.noise);
  } else {
    verdicts.noise = noise_levels(tracks, always_missing);
  }
  std::vector<double> assumed = verdicts.noise;
  for (double& level : assumed) level *= settings.sensitivity;
  verdicts.shares = cleaning_shares(assumed, frame_rate_hz);
  const SampleMarks missing = either(verdicts.marked, always_missing);
  // A track that was hardly seen keeps its bridges.
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    std::size_t seen = 0;
    for (std::size_t t = 0; t < tracks.frames(); ++t) seen += missing(t, n) == 0;
    if (seen < 2 * fewest_clean_frames) verdicts.shares[n] = 0;
  }
  smooth_tracks(tracks, missing, assumed, verdicts.shares, frame_rate_hz, progress);
  undo_round(tracks, shapes);
  give_travel_back(tracks, travels);
  return verdicts;
}

}  // namespace kinemend
