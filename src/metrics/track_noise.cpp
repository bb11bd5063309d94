// Takes the median of second differences, spread over the track.
#include "metrics/track_noise.hpp"

#include <algorithm>
#include <vector>

#include "base/quantiles.hpp"

namespace kinemend {

namespace {

template <class Sample>
double noise_of(std::span<const Sample> track, std::size_t most_samples) {
  if (track.size() < 3) return 0;
  const std::size_t count = track.size() - 2;
  const std::size_t step = std::max<std::size_t>(1, (count + most_samples - 1) / most_samples);
  std::vector<double> lengths;
  lengths.reserve(count / step + 1);
  for (std::size_t t = 0; t < count; t += step) {
    lengths.push_back(second_difference(track[t], track[t + 1], track[t + 2]));
  }
  return upper_median_of(lengths) * noise_per_second_difference;
}

}  // namespace

double second_difference(Quat a, Quat b, Quat c) {
  a = align_hemisphere(a, b);
  c = align_hemisphere(c, b);
  // A quaternion moves by half the angle.
  return 2 * norm(Quat{a.w - 2 * b.w + c.w, a.x - 2 * b.x + c.x, a.y - 2 * b.y + c.y,
                       a.z - 2 * b.z + c.z});
}

double second_difference(Vec3 a, Vec3 b, Vec3 c) { return norm(a - 2.0 * b + c); }

double track_noise(std::span<const Quat> track, std::size_t most_samples) {
  return noise_of(track, most_samples);
}
double track_noise(std::span<const Vec3> track, std::size_t most_samples) {
  return noise_of(track, most_samples);
}

}  // namespace kinemend
