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

// How strongly the samples that are not met pull at `point`: the sum of their unit directions.
template <std::size_t width>
double pull_at(const std::array<double, width>& point, const MedianScratch& scratch, double tiny) {
  const std::size_t count = scratch.distances.size();
  std::array<double, width> pull{};
  for (std::size_t i = 0; i < count; ++i) {
    if (scratch.distances[i] <= tiny) continue;
    for (std::size_t c = 0; c < width; ++c) {
      pull[c] += (scratch.coordinates[c * count + i] - point[c]) / scratch.distances[i];
    }
  }
  double squares = 0;
  for (const double p : pull) squares += p * p;
  return std::sqrt(squares);
}

// One step of Weiszfeld's iteration with the correction of Vardi & Zhang. Returns how far it went.
template <std::size_t width>
double weiszfeld_step(std::array<double, width>& point, MedianScratch& scratch, double tiny) {
  measure(point, scratch);
  const std::size_t count = scratch.distances.size();
  std::array<double, width> mean{};
  double total = 0, met = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = scratch.distances[i];
    const double weight = distance > tiny ? 1 / distance : 0;
    met += distance > tiny ? 0 : 1;
    total += weight;
    for (std::size_t c = 0; c < width; ++c) mean[c] += weight * scratch.coordinates[c * count + i];
  }
  if (total == 0) return 0;
  double stay = 0;
  if (met > 0) {
    const double pull = pull_at(point, scratch, tiny);
    stay = pull > met ? met / pull : 1;
  }
  double moved = 0;
  for (std::size_t c = 0; c < width; ++c) {
    const double next = (1 - stay) * mean[c] / total + stay * point[c];
    moved += (next - point[c]) * (next - point[c]);
    point[c] = next;
  }
  return std::sqrt(moved);
}

template <class Sample>
Sample find_l1_median(std::span<const Sample> samples, std::size_t start, MedianScratch& scratch) {
  constexpr int most_steps = 20;
  constexpr double near_enough = 1e-4;
  spread_out(samples, scratch);
  align_samples(samples, start, scratch);
  auto point = coordinates_of(samples[start]);
  measure(point, scratch);
  const double spread = sum_of(scratch.distances) / static_cast<double>(samples.size());
  if (spread == 0) return samples[start];
  for (int step = 0; step < most_steps; ++step) {
    const double moved = weiszfeld_step(point, scratch, 1e-12 * spread);
    if (moved == 0 && step == 0) return samples[start];
    if constexpr (std::is_same_v<Sample, Quat>) point = coordinates_of(from_coordinates(point));
    if (moved <= near_enough * spread) break;
  }
  return from_coordinates(point);
}

// Twice |a - b| of the nearer signs; points: |a - b|.
double distance_of(Quat a, Quat b) {
  const Quat d{a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z};
  const double same = dot(d, d);
  return 2 * std::sqrt(std::min(same, std::max(0.0, 4 - same)));
}
double distance_of(Vec3 a, Vec3 b) { return norm(a - b); }

}  // namespace

double chord(Quat a, Quat b) { return distance_of(a, b); }

std::size_t medoid(std::span<const Quat> samples, MedianScratch&) {
  return MovingMedoid<Quat>(samples, samples.size()).find(0, samples.size() - 1);
}
std::size_t medoid(std::span<const Vec3> samples, MedianScratch&) {
  return MovingMedoid<Vec3>(samples, samples.size()).find(0, samples.size() - 1);
}
Quat l1_median(std::span<const Quat> samples, std::size_t start, MedianScratch& scratch) {
  return find_l1_median(samples, start, scratch);
}
Vec3 l1_median(std::span<const Vec3> samples, std::size_t start, MedianScratch& scratch) {
  return find_l1_median(samples, start, scratch);
}

template <class Sample>
MovingMedoid<Sample>::MovingMedoid(std::span<const Sample> track, std::size_t longest)
    : track_(track),
      longest_(std::min(longest, track.size())),
      distances_(longest_ * longest_),
      sums_(longest_) {}

template <class Sample>
void MovingMedoid<Sample>::take_in(std::size_t frame) {
  const std::size_t row = frame % longest_;
  for (std::size_t other = std::max(first_, frame + 1 - std::min(frame + 1, longest_));
       other <= frame; ++other) {
    const double d = distance_of(track_[frame], track_[other]);
    distances_[row * longest_ + other % longest_] = d;
    distances_[(other % longest_) * longest_ + row] = d;
  }
}

template <class Sample>
std::size_t MovingMedoid<Sample>::find(std::size_t first, std::size_t last) {
  first_ = first;
  for (next_ = std::max(next_, first); next_ <= last; ++next_) take_in(next_);
  // Summed in the order of frames, so that a window gives the same wherever it lies in the track.
  std::fill(sums_.begin(), sums_.end(), 0.0);
  for (std::size_t s = first; s <= last; ++s) {
    const double* row = distances_.data() + (s % longest_) * longest_;
    for (std::size_t i = 0; i < longest_; ++i) sums_[i] += row[i];
  }
  std::size_t best = first;
  for (std::size_t f = first + 1; f <= last; ++f) {
    if (sums_[f % longest_] < sums_[best % longest_]) best = f;
  }
  return best;
}

template class MovingMedoid<Quat>;
template class MovingMedoid<Vec3>;

}  // namespace kinemend
