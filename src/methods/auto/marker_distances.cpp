// Compares the change of distances between tracks with the change that independent noise would
// cause.
#include "methods/auto/marker_distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.hpp"
#include "base/quantiles.hpp"

namespace kinemend {

namespace {

// Chosen by hand, and for speed; not swept.
constexpr std::size_t most_frames = 240;   // limits the time
constexpr std::size_t fewest_frames = 12;  // for a median

// Evenly spaced frames that have a frame before them.
std::vector<std::size_t> sampled_frames(std::size_t frames) {
  const std::size_t count = std::min(most_frames, frames - 1);
  std::vector<std::size_t> sampled;
  for (std::size_t i = 0; i < count; ++i) sampled.push_back(1 + i * (frames - 1) / count);
  return sampled;
}

// The median change of a distance relative to that of noise whose differences have these variances
// along the axes. Infinite if the two tracks are seldom seen together.
double ratio_of(const VectorTracks& tracks, const SampleMarks& marked,
                const std::vector<std::size_t>& frames, std::size_t a, std::size_t b,
                Vec3 squares) {
  std::vector<double> changes, expected;
  for (const std::size_t t : frames) {
    if (marked(t, a) || marked(t - 1, a) || marked(t, b) || marked(t - 1, b)) continue;
    const Vec3 now = tracks.at(t, a) - tracks.at(t, b);
    const double distance = norm(now);
    if (distance == 0) continue;
    const Vec3 u = (1 / distance) * now;
    changes.push_back(std::fabs(distance - norm(tracks.at(t - 1, a) - tracks.at(t - 1, b))));
    expected.push_back(
        std::sqrt(u.x * u.x * squares.x + u.y * u.y * squares.y + u.z * u.z * squares.z));
  }
  if (changes.size() < fewest_frames) return std::numeric_limits<double>::infinity();
  // Median of the size of a normal number of deviation 1. By definition, to four digits.
  constexpr double median_of_normal = 0.6745;
  return median_of(changes) / (median_of_normal * median_of(expected));
}

}  // namespace

double noise_in_distances(const VectorTracks& tracks, const SampleMarks& marked,
                          const std::vector<Vec3>& deviations, double correlation) {
  if (tracks.frames() < 2) return 0;
  const std::vector<std::size_t> frames = sampled_frames(tracks.frames());
  const std::size_t count = tracks.tracks();
  // Differences from one frame to the next have this share of the noise's variance.
  const double share = 2 * (1 - correlation);
  std::vector<double> least(count, std::numeric_limits<double>::infinity());
  for_each_parallel(count, count * count * frames.size(), [&](std::size_t a) {
    const Vec3 d = deviations[a];
    if (norm(d) == 0) return;
    for (std::size_t b = 0; b < count; ++b) {
      const Vec3 e = deviations[b];
      if (a == b || norm(e) == 0) continue;
      const Vec3 squares =
          share * Vec3{d.x * d.x + e.x * e.x, d.y * d.y + e.y * e.y, d.z * d.z + e.z * e.z};
      least[a] = std::min(least[a], ratio_of(tracks, marked, frames, a, b, squares));
    }
  });
  std::erase_if(least, [](double ratio) { return !std::isfinite(ratio); });
  return least.empty() ? 0 : median_of(least);
}

}  // namespace kinemend
