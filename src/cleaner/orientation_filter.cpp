// Computes increments of a track, weights them by a mask, and turns the track by the sums.
#include "cleaner/orientation_filter.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cleaner/orientation_filter.cpp"
#include "hwy/foreach_target.h"
// Must follow foreach_target.h, which includes this file again for each target.
#include "cleaner/rotation_lanes-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinemend {
namespace HWY_NAMESPACE {

using namespace lanes;  // NOLINT(google-build-using-namespace)

void increments_lanes(const RotationTrack& q, VectorTrack& out) {
  for (std::size_t i = 0; i + 1 < q.frames; i += hn::Lanes(tag)) {
    const LaneQuat a{load(&q.w[i]), load(&q.x[i]), load(&q.y[i]), load(&q.z[i])};
    const LaneQuat b{load(&q.w[i + 1]), load(&q.x[i + 1]), load(&q.y[i + 1]), load(&q.z[i + 1])};
    const LaneVec v = logarithm(a, b);
    store(v.x, &out.x[i]);
    store(v.y, &out.y[i]);
    store(v.z, &out.z[i]);
  }
}

void turn_lanes(RotationTrack& q, const VectorTrack& turns) {
  for (std::size_t i = 0; i < q.frames; i += hn::Lanes(tag)) {
    const LaneQuat a{load(&q.w[i]), load(&q.x[i]), load(&q.y[i]), load(&q.z[i])};
    const LaneQuat e = exponential({load(&turns.x[i]), load(&turns.y[i]), load(&turns.z[i])});
    const LaneQuat product = multiply(a, e);
    store(product.w, &q.w[i]);
    store(product.x, &q.x[i]);
    store(product.y, &q.y[i]);
    store(product.z, &q.z[i]);
  }
}

// `padded` begins k frames before the first output.
void weigh_increments_lanes(const VectorTrack& padded, std::span<const double> weights,
                            VectorTrack& out) {
  for (std::size_t i = 0; i < out.frames; i += hn::Lanes(tag)) {
    LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (std::size_t r = 0; r < weights.size(); ++r) {
      const Lanes b = all(weights[r]);
      sum.x = mul_add(b, load(&padded.x[i + r]), sum.x);
      sum.y = mul_add(b, load(&padded.y[i + r]), sum.y);
      sum.z = mul_add(b, load(&padded.z[i + r]), sum.z);
    }
    store(sum.x, &out.x[i]);
    store(sum.y, &out.y[i]);
    store(sum.z, &out.z[i]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kinemend
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>

namespace kinemend {

HWY_EXPORT(increments_lanes);
HWY_EXPORT(turn_lanes);
HWY_EXPORT(weigh_increments_lanes);

VectorTrack increments(const RotationTrack& rotations) {
  VectorTrack result(rotations.frames);
  HWY_DYNAMIC_DISPATCH(increments_lanes)(rotations, result);
  if (rotations.frames > 0) result.set(rotations.frames - 1, {});
  return result;
}

VectorTrack increments(const VectorTrack& positions) {
  VectorTrack result(positions.frames);
  for (std::size_t i = 0; i + 1 < positions.frames; ++i) {
    result.set(i, positions[i + 1] - positions[i]);
  }
  return result;
}

void turn(RotationTrack& rotations, const VectorTrack& turns) {
  HWY_DYNAMIC_DISPATCH(turn_lanes)(rotations, turns);
}

void turn(VectorTrack& positions, const VectorTrack& moves) {
  for (std::size_t i = 0; i < positions.frames; ++i) positions.set(i, positions[i] + moves[i]);
}

std::vector<double> increment_weights(std::span<const double> mask) {
  const std::size_t k = mask.size() / 2;
  std::vector<double> weights(2 * k);
  double sum = 0;
  for (std::size_t r = 0; r < k; ++r) weights[r] = -(sum += mask[r]);
  sum = 0;
  for (std::size_t r = 2 * k; r-- > k;) weights[r] = (sum += mask[r + 1]);
  return weights;
}

VectorTrack weigh_increments(const VectorTrack& increments, std::span<const double> weights) {
  const std::size_t k = weights.size() / 2;
  VectorTrack padded(increments.frames + 2 * k);
  for (std::size_t i = 0; i < increments.frames; ++i) padded.set(i + k, increments[i]);
  VectorTrack result(increments.frames);
  HWY_DYNAMIC_DISPATCH(weigh_increments_lanes)(padded, weights, result);
  return result;
}

}  // namespace kinemend
#endif
