// Runs the passes of the bilateral filter in vector lanes and continues a track beyond its ends.
#include "papers/courty2008_bilateral/bilateral_filter.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "cleaner/orientation_filter.hpp"
#include "motion/rotation.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "papers/courty2008_bilateral/bilateral_filter.cpp"
#include "hwy/foreach_target.h"
// Must follow foreach_target.h, which includes this file again for each target.
#include "base/portable.hpp"
#include "cleaner/rotation_lanes-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinemend {
namespace HWY_NAMESPACE {

using namespace lanes;  // NOLINT(google-build-using-namespace)

HWY_INLINE Lanes squared_distance(const LaneQuat& a, const LaneQuat& b) {
  return squared_angle(a, b);
}
HWY_INLINE Lanes squared_distance(const LaneVec& a, const LaneVec& b) {
  const LaneVec d{sub(a.x, b.x), sub(a.y, b.y), sub(a.z, b.z)};
  return add(mul(d.x, d.x), add(mul(d.y, d.y), mul(d.z, d.z)));
}

// The band of W(i, i + r), r = 1 .. k, for a block of frames: the matrix is symmetric, so only the
// later frames are stored.
struct Band {
  std::span<double> values;
  std::size_t stride = 0;  // between rows of r
  std::size_t first = 0;   // frame of the first column
  double* at(std::size_t i, std::size_t r) { return &values[(r - 1) * stride + i - first]; }
};

template <class Track>
void fill_band(const Track& track, const BilateralKernel& kernel, std::size_t end, Band& band) {
  const Lanes scale = all(kernel.distance_scale);
  for (std::size_t r = 1; r <= kernel.half_width(); ++r) {
    const Lanes temporal = all(kernel.temporal_weights[r]);
    for (std::size_t i = band.first; i < end; i += hn::Lanes(tag)) {
      const Lanes d2 = squared_distance(load_sample(track, i), load_sample(track, i + r));
      store(mul(temporal, exponential_decay(mul(scale, d2))), band.at(i, r));
    }
  }
}

// The sum over r of b_r w_{i+r} (eq. 2-3) for one frame and its lanes. It starts at the far ends of
// the window, where the partial sums of the mask are the b_r. Not yet divided by the mask's sum.
HWY_INLINE LaneVec weigh(const VectorTrack& steps, const double* sample_weights, Band& band,
                         std::size_t k, std::size_t i, Lanes& mask_sum) {
  LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
  Lanes before = hn::Zero(tag);
  Lanes behind = hn::Zero(tag);
  for (std::size_t r = k; r > 0; --r) {
    before = mul_add(load(band.at(i - r, r)), load(sample_weights + i - r), before);
    behind = mul_add(load(band.at(i, r)), load(sample_weights + i + r), behind);
    const LaneVec past = load_sample(steps, i - r);
    const LaneVec next = load_sample(steps, i + r - 1);
    sum.x = add(sum.x, sub(mul(behind, next.x), mul(before, past.x)));
    sum.y = add(sum.y, sub(mul(behind, next.y), mul(before, past.y)));
    sum.z = add(sum.z, sub(mul(behind, next.z), mul(before, past.z)));
  }
  mask_sum = add(load(sample_weights + i), add(before, behind));
  return sum;
}

// `track` and `sample_weights` begin k frames before the first of `moves`.
template <class Track>
void bilateral_moves(const Track& track, const VectorTrack& steps, const double* sample_weights,
                     const BilateralKernel& kernel, VectorTrack& moves) {
  // For speed, not swept.
  constexpr std::size_t block = 256;  // the band of a block fits the L1 cache
  const std::size_t k = kernel.half_width();
  std::vector<double> storage(k * (block + k + lane_room));
  for (std::size_t first = 0; first < moves.frames; first += block) {
    const std::size_t last = std::min(first + block, moves.frames);
    Band band{storage, block + k + lane_room, first};
    fill_band(track, kernel, last + k, band);
    for (std::size_t i = first; i < last; i += hn::Lanes(tag)) {
      Lanes mask_sum;
      const LaneVec sum = weigh(steps, sample_weights, band, k, i + k, mask_sum);
      const Lanes share = hn::Div(all(1.0), hn::Max(mask_sum, all(1e-300)));
      store_sample({mul(share, sum.x), mul(share, sum.y), mul(share, sum.z)}, moves, i);
    }
  }
}

void bilateral_rotations(const RotationTrack& track, const VectorTrack& steps,
                         const double* sample_weights, const BilateralKernel& kernel,
                         VectorTrack& moves) {
  bilateral_moves(track, steps, sample_weights, kernel, moves);
}
void bilateral_positions(const VectorTrack& track, const VectorTrack& steps,
                         const double* sample_weights, const BilateralKernel& kernel,
                         VectorTrack& moves) {
  bilateral_moves(track, steps, sample_weights, kernel, moves);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinemend
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend {

HWY_EXPORT(bilateral_rotations);
HWY_EXPORT(bilateral_positions);

namespace {

void find_moves(const RotationTrack& track, const VectorTrack& steps, const double* sample_weights,
                const BilateralKernel& kernel, VectorTrack& moves) {
  HWY_DYNAMIC_DISPATCH(bilateral_rotations)(track, steps, sample_weights, kernel, moves);
}
void find_moves(const VectorTrack& track, const VectorTrack& steps, const double* sample_weights,
                const BilateralKernel& kernel, VectorTrack& moves) {
  HWY_DYNAMIC_DISPATCH(bilateral_positions)(track, steps, sample_weights, kernel, moves);
}

Quat reflected(Quat end, Quat sample) { return end * conjugate(sample) * end; }
Vec3 reflected(Vec3 end, Vec3 sample) { return end + (end - sample); }

// Index of the sample at i of the mirrored signal, for any i.
std::size_t mirrored_index(std::ptrdiff_t i, std::size_t frames) {
  if (frames == 1) return 0;
  const auto period = static_cast<std::ptrdiff_t>(2 * (frames - 1));
  const std::ptrdiff_t phase = ((i % period) + period) % period;
  return static_cast<std::size_t>(std::min(phase, period - phase));
}

// Value at `first` of the least-squares line through the samples first, first + direction, ...,
// with the kernel's weights: an end value with less noise than its own sample.
template <class Track>
auto end_estimate(const Track& padded, const double* sample_weights, std::size_t first,
                  int direction, std::size_t frames, const BilateralKernel& kernel) {
  const auto end = padded[first];
  const std::size_t reach = std::min(kernel.half_width(), frames - 1);
  double s0 = 0, s1 = 0, s2 = 0;
  Vec3 m0, m1;
  for (std::size_t r = 0; r <= reach; ++r) {
    const std::size_t i = direction > 0 ? first + r : first - r;
    const Vec3 d = difference(end, padded[i]);
    const double weight = sample_weights[i] * kernel.temporal_weights[r] *
                          portable::exp(-kernel.distance_scale * dot(d, d));
    const double t = static_cast<double>(r);
    s0 += weight, s1 += weight * t, s2 += weight * t * t;
    m0 += weight * d, m1 += weight * t * d;
  }
  const double determinant = s0 * s2 - s1 * s1;
  // The line is not determined.
  if (!(s2 > 1e-12 && determinant > 1e-9 * s0 * s2)) return end;
  return moved(end, (1 / determinant) * (s2 * m0 - s1 * m1));
}

// Fills `pad` samples on either side of the `frames` in the middle.
template <class Track>
void continue_ends(Track& padded, const double* sample_weights, std::size_t frames,
                   const BilateralKernel& kernel, BilateralEnds ends) {
  const std::size_t pad = kernel.half_width();
  const std::size_t last = pad + frames - 1;
  const auto front = end_estimate(padded, sample_weights, pad, 1, frames, kernel);
  const auto back = end_estimate(padded, sample_weights, last, -1, frames, kernel);
  for (std::size_t i = 1; i <= pad; ++i) {
    if (ends == BilateralEnds::mirror) {
      const auto offset = static_cast<std::ptrdiff_t>(i);
      padded.set(pad - i, padded[pad + mirrored_index(-offset, frames)]);
      padded.set(
          last + i,
          padded[pad + mirrored_index(offset + static_cast<std::ptrdiff_t>(frames) - 1, frames)]);
    } else {
      // In a short signal, smaller i have filled the samples read here.
      padded.set(pad - i, reflected(front, padded[pad + i]));
      padded.set(last + i, reflected(back, padded[last - i]));
    }
  }
}

std::vector<double> padded_weights(const std::vector<double>& weights, std::size_t pad,
                                   std::size_t frames) {
  std::vector<double> padded(frames + 2 * pad + lane_room, 1.0);
  if (weights.empty()) return padded;
  for (std::size_t i = 0; i < frames + 2 * pad; ++i) {
    padded[i] = weights[mirrored_index(
        static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(pad), frames)];
  }
  return padded;
}

template <class Track>
void run_passes(Track& track, const std::vector<double>& sample_weights,
                const BilateralKernel& kernel, std::size_t passes, BilateralEnds ends) {
  if (track.frames < 2) return;
  const std::size_t k = kernel.half_width();
  const std::vector<double> weights = padded_weights(sample_weights, k, track.frames);
  Track padded(track.frames + 2 * k);
  VectorTrack moves(track.frames);
  for (std::size_t pass = 0; pass < passes; ++pass) {
    for (std::size_t i = 0; i < track.frames; ++i) padded.set(k + i, track[i]);
    continue_ends(padded, weights.data(), track.frames, kernel, ends);
    find_moves(padded, increments(padded), weights.data(), kernel, moves);
    turn(track, moves);
  }
}

}  // namespace

BilateralKernel bilateral_kernel(double sigma_t_frames, double sigma_g) {
  BilateralKernel kernel;
  const auto k =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(3 * sigma_t_frames)));
  for (std::size_t r = 0; r <= k; ++r) {
    const double steps = static_cast<double>(r) / sigma_t_frames;
    kernel.temporal_weights.push_back(portable::exp(-0.5 * steps * steps));
  }
  kernel.distance_scale = 1 / (2 * sigma_g * sigma_g);
  return kernel;
}

void bilateral_filter(RotationTrack& track, const std::vector<double>& sample_weights,
                      const BilateralKernel& kernel, std::size_t passes, BilateralEnds ends) {
  run_passes(track, sample_weights, kernel, passes, ends);
}

void bilateral_filter(VectorTrack& track, const std::vector<double>& sample_weights,
                      const BilateralKernel& kernel, std::size_t passes, BilateralEnds ends) {
  run_passes(track, sample_weights, kernel, passes, ends);
}

}  // namespace kinemend
#endif
