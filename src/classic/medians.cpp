// Finds medoids and L1 medians, the latter by Newton's and Weiszfeld's steps.
#include "classic/medians.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend {

namespace {

// Gradient and curvature of the sum of distances at a point y, without the samples at y.
struct Pull {
  double distances = 0;  // sum of |p - y|
  double weights = 0;    // sum of 1 / |p - y|
  double met = 0;        // samples at y
  Vec3 direction;        // sum of (p - y) / |p - y|
  // Sum of (I - u u^T) / |p - y|, the curvature of the sum of distances.
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
};

Pull pull_at(Vec3 y, std::span<const Vec3> points, double tiny) {
  Pull pull;
  for (const Vec3& p : points) {
    const Vec3 d = p - y;
    const double distance = norm(d);
    if (distance <= tiny) {
      pull.met += 1;
      continue;
    }
    const double weight = 1 / distance;
    const Vec3 u = weight * d;
    pull.distances += distance;
    pull.weights += weight;
    pull.direction += u;
    pull.xx += weight * (1 - u.x * u.x);
    pull.yy += weight * (1 - u.y * u.y);
    pull.zz += weight * (1 - u.z * u.z);
    pull.xy -= weight * u.x * u.y;
    pull.xz -= weight * u.x * u.z;
    pull.yz -= weight * u.y * u.z;
  }
  return pull;
}

// Newton's step, by Cramer's rule; Weiszfeld's where the curvature is degenerate.
Vec3 newton_step(const Pull& p) {
  const Vec3 g = p.direction;
  const double a = p.yy * p.zz - p.yz * p.yz, b = p.xz * p.yz - p.xy * p.zz;
  const double c = p.xy * p.yz - p.xz * p.yy;
  const double determinant = p.xx * a + p.xy * b + p.xz * c;
  if (!(determinant > 1e-9 * p.weights * p.weights * p.weights)) return (1 / p.weights) * g;
  const double d = p.xx * p.zz - p.xz * p.xz, e = p.xy * p.xz - p.xx * p.yz;
  const double f = p.xx * p.yy - p.xy * p.xy;
  return (1 / determinant) * Vec3{a * g.x + b * g.y + c * g.z, b * g.x + d * g.y + e * g.z,
                                  c * g.x + e * g.y + f * g.z};
}

Vec3 spatial_median(std::span<const Vec3> points, std::size_t start) {
  // Newton's steps, and where they end as a share of the spread: rounding. Not swept.
  constexpr int most_steps = 16;
  constexpr double near_enough = 1e-6;
  Vec3 best = points[start];
  double spread = 0;
  for (const Vec3& p : points) spread += norm(p - best) / static_cast<double>(points.size());
  if (spread == 0) return best;
  const double tiny = 1e-12 * spread;
  Pull pull = pull_at(best, points, tiny);
  const double strength = norm(pull.direction);
  if (strength <= pull.met) return best;
  // Vardi & Zhang: the first step away from a sample is Weiszfeld's, shortened.
  Vec3 next = best + ((1 - pull.met / strength) / pull.weights) * pull.direction;
  for (int step = 0; step < most_steps; ++step) {
    const Pull there = pull_at(next, points, tiny);
    if (there.met > 0) return next;
    if (step > 0 && there.distances > pull.distances) {
      // Newton's step has increased the sum; Weiszfeld's never does.
      next = best + (1 / pull.weights) * pull.direction;
      pull = pull_at(next, points, tiny);
      if (pull.met > 0) return next;
    } else {
      pull = there;
    }
    best = next;
    const Vec3 move = newton_step(pull);
    next = best + move;
    if (norm(move) <= near_enough * spread) break;
  }
  return best;
}

// Sums distances in the same order as `MovingMedoid`.
template <class Sample>
std::size_t least_sum(std::span<const Sample> samples, std::vector<double>& sums) {
  sums.assign(samples.size(), 0.0);
  for (std::size_t s = 1; s < samples.size(); ++s) {
    for (std::size_t i = 0; i < s; ++i) {
      const double d = chord(samples[s], samples[i]);
      sums[s] += d;
      sums[i] += d;
    }
  }
  return static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
}

}  // namespace

// Twice |a - b| with the nearer signs.
double chord(Quat a, Quat b) {
  const Quat d{a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z};
  const double same = dot(d, d);
  return 2 * std::sqrt(std::min(same, std::max(0.0, 4 - same)));
}

std::size_t medoid(std::span<const Quat> samples) {
  return MovingMedoid<Quat>(samples, samples.size()).find(0, samples.size() - 1);
}
std::size_t medoid(std::span<const Vec3> samples) {
  return MovingMedoid<Vec3>(samples, samples.size()).find(0, samples.size() - 1);
}

std::size_t medoid(std::span<const Quat> samples, std::vector<double>& scratch) {
  return least_sum(samples, scratch);
}
std::size_t medoid(std::span<const Vec3> samples, std::vector<double>& scratch) {
  return least_sum(samples, scratch);
}

Quat l1_median(std::span<const Quat> samples, std::size_t start, std::vector<Vec3>& scratch) {
  const Quat middle = samples[start], back = conjugate(middle);
  scratch.clear();
  for (const Quat& sample : samples) {
    const Quat d = back * sample;
    const double twice = d.w < 0 ? -2 : 2;
    scratch.push_back({twice * d.x, twice * d.y, twice * d.z});
  }
  scratch[start] = {};
  const Vec3 half = 0.5 * spatial_median(scratch, start);
  if (half == Vec3{}) return middle;
  return normalized(middle *
                    Quat{std::sqrt(std::max(0.0, 1 - dot(half, half))), half.x, half.y, half.z});
}

Vec3 l1_median(std::span<const Vec3> samples, std::size_t start, std::vector<Vec3>&) {
  return spatial_median(samples, start);
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
  const std::size_t oldest = std::max(first_, frame + 1 - std::min(frame + 1, longest_));
  for (std::size_t other = oldest; other <= frame; ++other) {
    const double d = chord(track_[frame], track_[other]);
    distances_[row * longest_ + other % longest_] = d;
    distances_[(other % longest_) * longest_ + row] = d;
  }
}

template <class Sample>
std::size_t MovingMedoid<Sample>::find(std::size_t first, std::size_t last) {
  first_ = first;
  for (next_ = std::max(next_, first); next_ <= last; ++next_) take_in(next_);
  // Summed in the order of frames, so that the sum of a window does not depend on its place in the
  // track.
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
