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
    store_sample(logarithm(load_sample(q, i), load_sample(q, i + 1)), out, i);
  }
}

void turn_lanes(RotationTrack& q, const VectorTrack& turns) {
  for (std::size_t i = 0; i < q.frames; i += hn::Lanes(tag)) {
    store_sample(multiply(load_sample(q, i), exponential(load_sample(turns, i))), q, i);
  }
}

// `padded` begins k frames before the first output.
void weigh_increments_lanes(const VectorTrack& padded, std::span<const double> weights,
                            VectorTrack& out) {
  for (std::size_t i = 0; i < out.frames; i += hn::Lanes(tag)) {
    LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (std::size_t r = 0; r < weights.size(); ++r) {
      const Lanes b = all(weights[r]);
      const LaneVec increment = load_sample(padded, i + r);
      sum.x = mul_add(b, increment.x, sum.x);
      sum.y = mul_add(b, increment.y, sum.y);
      sum.z = mul_add(b, increment.z, sum.z);
    }
    store_sample(sum, out, i);
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
