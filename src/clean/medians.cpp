#include "clean/medians.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace kinemend {

namespace {

constexpr std::size_t coordinate_count(Quat) { return 4; }
constexpr std::size_t coordinate_count(Vec3) { return 3; }
std::array<double, 4> coordinates_of(Quat q) { return {q.w, q.x, q.y, q.z}; }
std::array<double, 3> coordinates_of(Vec3 p) { return {p.x, p.y, p.z}; }
Quat from_coordinates(const std::array<double, 4>& c) {
  return normalized({c[0], c[1], c[2], c[3]});
}
Vec3 from_coordinates(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

// Coordinate c of sample i at [c * count + i], so that the loops over samples vectorise.
template <class Sample>
void spread_out(std::span<const Sample> samples, MedianScratch& scratch) {
  constexpr std::size_t width = coordinate_count(Sample{});
  const std::size_t count = samples.size();
  scratch.coordinates.resize(width * count);
  scratch.distances.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto values = coordinates_of(samples[i]);
    for (std::size_t c = 0; c < width; ++c) scratch.coordinates[c * count + i] = values[c];
  }
}

// Distance of every sample from `point`, into scratch.distances. Quaternions (width 4) are taken
// with the nearer of their signs: |a + b|^2 = 4 - |a - b|^2.
template <std::size_t width>
void measure(const std::array<double, width>& point, MedianScratch& scratch) {
  const std::size_t count = scratch.distances.size();
  double* distances = scratch.distances.data();
  for (std::size_t i = 0; i < count; ++i) distances[i] = 0;
  for (std::size_t c = 0; c < width; ++c) {
    const double* values = scratch.coordinates.data() + c * count;
    const double own = point[c];
    for (std::size_t i = 0; i < count; ++i) {
      const double d = values[i] - own;
      distances[i] += d * d;
    }
  }
  if constexpr (width == 4) {
    for (std::size_t i = 0; i < count; ++i) {
      const double other = std::max(0.0, 4 - distances[i]);
      distances[i] = distances[i] < other ? distances[i] : other;
    }
  }
  for (std::size_t i = 0; i < count; ++i) distances[i] = std::sqrt(distances[i]);
}

// Gives every sample the sign that is nearest to sample `middle`.
void align_samples(std::span<const Quat> samples, std::size_t middle, MedianScratch& scratch) {
  const std::size_t count = samples.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (dot(samples[i], samples[middle]) >= 0) continue;
    for (std::size_t c = 0; c < 4; ++c) scratch.coordinates[c * count + i] *= -1;
  }
}
void align_samples(std::span<const Vec3>, std::size_t, MedianScratch&) {}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

template <class Sample>
std::size_t find_medoid(std::span<const Sample> samples, MedianScratch& scratch) {
  spread_out(samples, scratch);
  std::size_t best = 0;
  double least = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    measure(coordinates_of(samples[i]), scratch);
    const double sum = sum_of(scratch.distances);
    if (i == 0 || sum < least) least = sum, best = i;
  }
  return best;
}

// One step of Weiszfeld's iteration with the correction of Vardi & Zhang. Returns how far it went.
template <std::size_t width>
double weiszfeld_step(std::array<double, width>& point, MedianScratch& scratch, double tiny) {
  measure(point, scratch);
  const std::size_t count = scratch.distances.size();
  std::array<double, width> mean{}, pull{};
  double total = 0, met = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = scratch.distances[i];
    if (distance <= tiny) {
      met += 1;
      continue;
    }
    const double weight = 1 / distance;
    total += weight;
    for (std::size_t c = 0; c < width; ++c) {
      const double value = scratch.coordinates[c * count + i];
      mean[c] += weight * value;
      pull[c] += weight * (value - point[c]);
    }
  }
  if (total == 0) return 0;
  double strength = 0;
  for (const double p : pull) strength += p * p;
  strength = std::sqrt(strength);
  const double stay = strength > 0 ? std::min(1.0, met / strength) : 1.0;
  double moved = 0;
  for (std::size_t c = 0; c < width; ++c) {
    const double next = (1 - stay) * mean[c] / total + stay * point[c];
    moved += (next - point[c]) * (next - point[c]);
    point[c] = next;
  }
  return std::sqrt(moved);
}

template <class Sample>
Sample find_l1_median(std::span<const Sample> samples, MedianScratch& scratch) {
  constexpr int most_steps = 60;
  const std::size_t start = find_medoid(samples, scratch);
  align_samples(samples, start, scratch);
  auto point = coordinates_of(samples[start]);
  measure(point, scratch);
  const double spread = sum_of(scratch.distances) / static_cast<double>(samples.size());
  if (spread == 0) return samples[start];
  for (int step = 0; step < most_steps; ++step) {
    const double moved = weiszfeld_step(point, scratch, 1e-12 * spread);
    if (moved == 0 && step == 0) return samples[start];
    if constexpr (std::is_same_v<Sample, Quat>) point = coordinates_of(from_coordinates(point));
    if (moved <= 1e-9 * spread) break;
  }
  return from_coordinates(point);
}

}  // namespace

double chord(Quat a, Quat b) {
  const Quat nearest = align_hemisphere(b, a);
  return 2 * norm(Quat{a.w - nearest.w, a.x - nearest.x, a.y - nearest.y, a.z - nearest.z});
}

std::size_t medoid(std::span<const Quat> samples, MedianScratch& scratch) {
  return find_medoid(samples, scratch);
}
std::size_t medoid(std::span<const Vec3> samples, MedianScratch& scratch) {
  return find_medoid(samples, scratch);
}
Quat l1_median(std::span<const Quat> samples, MedianScratch& scratch) {
  return find_l1_median(samples, scratch);
}
Vec3 l1_median(std::span<const Vec3> samples, MedianScratch& scratch) {
  return find_l1_median(samples, scratch);
}

}  // namespace kinemend
