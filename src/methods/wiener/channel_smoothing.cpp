// Scales channels to the same noise, smooths them as tracks, and scales them back.
#include "methods/wiener/channel_smoothing.hpp"

#include <vector>

#include "methods/auto/track_smoother.hpp"

namespace kinemend {

// Channels are scaled to the same noise, which is then isotropic.
void smooth_channels(PoseMatrix& poses, std::span<const std::uint8_t> missing,
                     std::span<const double> noise, double frame_rate_hz) {
  // Chosen by hand, not swept.
  constexpr std::size_t fewest_smoothed_frames = 16;  // fewer do not determine a strength
  VectorTracks tracks(poses.frames, poses.channels / 3);
  SampleMarks marks(poses.frames, tracks.tracks());
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    const double* of_axes = &noise[3 * n];
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const std::size_t i = f * poses.channels + 3 * n;
      const double* v = &poses.values[i];
      tracks.set(f, n, {v[0] / of_axes[0], v[1] / of_axes[1], v[2] / of_axes[2]});
      marks(f, n) = missing[i] | missing[i + 1] | missing[i + 2];
    }
  }
  const std::vector<double> one(tracks.tracks(), 1);
  std::vector<double> shares(tracks.tracks(), 1);
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    std::size_t seen = 0;
    for (std::size_t f = 0; f < tracks.frames(); ++f) seen += marks(f, n) == 0;
    if (seen < fewest_smoothed_frames) shares[n] = 0;
  }
  smooth_tracks(tracks, marks, one, shares, frame_rate_hz);
  for (std::size_t n = 0; n < tracks.tracks(); ++n) {
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const Vec3 v = tracks.at(f, n);
      poses(f, 3 * n) = v.x * noise[3 * n];
      poses(f, 3 * n + 1) = v.y * noise[3 * n + 1];
      poses(f, 3 * n + 2) = v.z * noise[3 * n + 2];
    }
  }
}

}  // namespace kinemend
