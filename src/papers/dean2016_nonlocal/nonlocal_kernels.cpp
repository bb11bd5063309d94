// The loops of the non-local means, compiled once for each instruction set.
#include "papers/dean2016_nonlocal/nonlocal_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "papers/dean2016_nonlocal/nonlocal_kernels.cpp"
#include "hwy/foreach_target.h"
// Must follow foreach_target.h, which includes this file again for each target.
#include "cleaner/rotation_lanes-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinemend {
namespace HWY_NAMESPACE {

using namespace lanes;  // NOLINT(google-build-using-namespace)

HWY_INLINE bool weighs_nothing(Lanes weights) {
  return hn::AllFalse(tag, hn::Gt(weights, hn::Zero(tag)));
}

void add_squared_angles_lanes(const RotationTrack& track, std::size_t a, std::size_t b,
                              std::size_t count, double* sums) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const Lanes d2 = squared_angle(load_sample(track, a + i), load_sample(track, b + i));
    store(add(load(sums + i), d2), sums + i);
  }
}

void add_observed_angles_lanes(const RotationTrack& track, const double* observed, std::size_t a,
                               std::size_t b, std::size_t count, double* sums, double* pairs) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const Lanes d2 = squared_angle(load_sample(track, a + i), load_sample(track, b + i));
    const Lanes both = mul(load(observed + a + i), load(observed + b + i));
    store(mul_add(both, d2, load(sums + i)), sums + i);
    store(add(both, load(pairs + i)), pairs + i);
  }
}

void add_point_moves_lanes(const VectorTrack& track, const double* observed, std::size_t a,
                           std::size_t b, std::size_t count, const PointSums& sums) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const LaneVec from = load_sample(track, a + i), to = load_sample(track, b + i);
    const Lanes both = observed ? mul(load(observed + a + i), load(observed + b + i)) : all(1.0);
    const LaneVec d{mul(both, sub(to.x, from.x)), mul(both, sub(to.y, from.y)),
                    mul(both, sub(to.z, from.z))};
    const Lanes square = mul_add(d.x, d.x, mul_add(d.y, d.y, mul(d.z, d.z)));
    store(add(square, load(sums.squares + i)), sums.squares + i);
    store(add(d.x, load(sums.x + i)), sums.x + i);
    store(add(d.y, load(sums.y + i)), sums.y + i);
    store(add(d.z, load(sums.z + i)), sums.z + i);
    store(add(both, load(sums.pairs + i)), sums.pairs + i);
  }
}

void mean_point_move_lanes(const VectorTrack& track, const double* observed, std::size_t first,
                           std::size_t count, std::span<const Neighbour> neighbours,
                           std::span<const VectorTrack> travels, VectorTrack& out) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const LaneVec own = load_sample(track, first + i);
    Lanes total = all(1.0);
    LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      Lanes weight = load(neighbours[n].weights + i);
      if (weighs_nothing(weight)) continue;
      const std::size_t there = first + i + static_cast<std::size_t>(neighbours[n].offset);
      if (observed) weight = mul(weight, load(observed + there));
      const LaneVec p = load_sample(track, there), travel = load_sample(travels[n], i);
      total = add(total, weight);
      sum.x = mul_add(weight, sub(sub(p.x, own.x), travel.x), sum.x);
      sum.y = mul_add(weight, sub(sub(p.y, own.y), travel.y), sum.y);
      sum.z = mul_add(weight, sub(sub(p.z, own.z), travel.z), sum.z);
    }
    const Lanes share = hn::Div(all(1.0), total);
    store_sample({mul(share, sum.x), mul(share, sum.y), mul(share, sum.z)}, out, i);
  }
}

void decay_lanes(double scale, const double* floors, std::size_t count, double* values) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const Lanes excess = hn::Max(sub(load(values + i), load(floors + i)), hn::Zero(tag));
    store(exponential_decay(mul(all(scale), excess)), values + i);
  }
}

// The factor from the vector part of a^-1 b to Log(a^-1 b); its sign is that of a . b.
HWY_INLINE Lanes logarithm_scale(const LaneQuat& a, const LaneQuat& b) {
  const Lanes cosine = dot(a, b);
  const Lanes scale = polynomial(logarithm_coefficients, quarter_sine(hn::Abs(cosine)));
  return hn::CopySignToAbs(scale, cosine);
}

// Fills one row of scales for the neighbours at +n and at -n if they follow each other in the list:
// the scale of a pair does not depend on its direction. Returns the neighbour's own scales from
// frame `first` on.
const double* fill_scales(const RotationTrack& track, std::size_t first, std::size_t count,
                          const Neighbour& neighbour, const Neighbour* opposite, double* row) {
  const std::size_t step = opposite ? static_cast<std::size_t>(neighbour.offset) : 0;
  const std::size_t begin = first - step;
  const bool skips = !opposite;  // weights belong to one side only
  for (std::size_t i = 0; i < count + step; i += hn::Lanes(tag)) {
    if (skips && weighs_nothing(load(neighbour.weights + i))) continue;
    const std::size_t there = begin + i + static_cast<std::size_t>(neighbour.offset);
    store(logarithm_scale(load_sample(track, begin + i), load_sample(track, there)), row + i);
  }
  return row + step;
}

// (x, y, z) of a^-1 b.
HWY_INLINE LaneVec vector_part(const LaneQuat& a, const LaneQuat& b) {
  return {sub(sub(mul(a.w, b.x), mul(a.x, b.w)), sub(mul(a.y, b.z), mul(a.z, b.y))),
          sub(sub(mul(a.w, b.y), mul(a.y, b.w)), sub(mul(a.z, b.x), mul(a.x, b.z))),
          sub(sub(mul(a.w, b.z), mul(a.z, b.w)), sub(mul(a.x, b.y), mul(a.y, b.x)))};
}

// The vector part of q_i^-1 q_n is linear in q_n: the scaled quaternions are summed, as differences
// from q_i (zero without motion), and multiplied once.
void mean_turn_lanes(const RotationTrack& track, const double* observed, std::size_t first,
                     std::size_t count, std::span<const Neighbour> neighbours,
                     std::span<const double* const> scales, VectorTrack& out) {
  const Lanes sign_bit = all(-0.0);
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const LaneQuat own = load_sample(track, first + i);
    Lanes total = observed ? load(observed + first + i) : all(1.0);
    LaneQuat sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      Lanes weight = load(neighbours[n].weights + i);
      if (weighs_nothing(weight)) continue;
      const std::size_t there = first + i + static_cast<std::size_t>(neighbours[n].offset);
      if (observed) weight = mul(weight, load(observed + there));
      total = add(total, weight);
      const Lanes scale = load(scales[n] + i);
      const Lanes sign = hn::And(scale, sign_bit);
      const Lanes factor = mul(weight, hn::Abs(scale));
      const LaneQuat q = load_sample(track, there);
      sum.w = mul_add(factor, sub(hn::Xor(q.w, sign), own.w), sum.w);
      sum.x = mul_add(factor, sub(hn::Xor(q.x, sign), own.x), sum.x);
      sum.y = mul_add(factor, sub(hn::Xor(q.y, sign), own.y), sum.y);
      sum.z = mul_add(factor, sub(hn::Xor(q.z, sign), own.z), sum.z);
    }
    const Lanes share = hn::Div(all(1.0), hn::Max(total, all(1e-300)));
    const LaneVec mean = vector_part(own, sum);
    store_sample({mul(share, mean.x), mul(share, mean.y), mul(share, mean.z)}, out, i);
  }
}

void mean_move_lanes(const VectorTrack& track, std::size_t first, std::size_t count,
                     std::span<const Neighbour> neighbours, VectorTrack& out) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const LaneVec own = load_sample(track, first + i);
    Lanes total = all(1.0);
    LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (const Neighbour& n : neighbours) {
      const Lanes weight = load(n.weights + i);
      if (weighs_nothing(weight)) continue;
      const LaneVec p = load_sample(track, first + i + static_cast<std::size_t>(n.offset));
      total = add(total, weight);
      sum.x = mul_add(weight, sub(p.x, own.x), sum.x);
      sum.y = mul_add(weight, sub(p.y, own.y), sum.y);
      sum.z = mul_add(weight, sub(p.z, own.z), sum.z);
    }
    const Lanes share = hn::Div(all(1.0), total);
    store_sample({mul(share, sum.x), mul(share, sum.y), mul(share, sum.z)}, out, i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace kinemend
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <algorithm>
#include <memory>
#include <vector>

namespace kinemend {

HWY_EXPORT(add_squared_angles_lanes);
HWY_EXPORT(add_observed_angles_lanes);
HWY_EXPORT(add_point_moves_lanes);
HWY_EXPORT(mean_point_move_lanes);
HWY_EXPORT(decay_lanes);
HWY_EXPORT(fill_scales);
HWY_EXPORT(mean_turn_lanes);
HWY_EXPORT(mean_move_lanes);

void add_squared_angles(const RotationTrack& track, std::size_t a, std::size_t b, std::size_t count,
                        double* sums) {
  HWY_DYNAMIC_DISPATCH(add_squared_angles_lanes)(track, a, b, count, sums);
}
void add_observed_angles(const RotationTrack& track, const double* observed, std::size_t a,
                         std::size_t b, std::size_t count, double* sums, double* pairs) {
  HWY_DYNAMIC_DISPATCH(add_observed_angles_lanes)(track, observed, a, b, count, sums, pairs);
}
void add_point_moves(const VectorTrack& track, const double* observed, std::size_t a, std::size_t b,
                     std::size_t count, const PointSums& sums) {
  HWY_DYNAMIC_DISPATCH(add_point_moves_lanes)(track, observed, a, b, count, sums);
}
void mean_point_move(const VectorTrack& track, const double* observed, std::size_t first,
                     std::size_t count, std::span<const Neighbour> neighbours,
                     std::span<const VectorTrack> travels, VectorTrack& out) {
  HWY_DYNAMIC_DISPATCH(mean_point_move_lanes)
  (track, observed, first, count, neighbours, travels, out);
}
void decay(double scale, const double* floors, std::size_t count, double* values) {
  HWY_DYNAMIC_DISPATCH(decay_lanes)(scale, floors, count, values);
}
void mean_turn(const RotationTrack& track, const double* observed, std::size_t first,
               std::size_t count, std::span<const Neighbour> neighbours, VectorTrack& out) {
  const auto opposite_of = [&](std::size_t n) {
    const bool follows = neighbours[n].offset > 0 && n + 1 < neighbours.size() &&
                         neighbours[n + 1].offset == -neighbours[n].offset;
    return follows ? &neighbours[n + 1] : nullptr;
  };
  std::size_t stride = count + lane_room;
  for (std::size_t n = 0; n < neighbours.size(); ++n) {
    if (!opposite_of(n)) continue;
    stride = std::max(stride, count + lane_room + static_cast<std::size_t>(neighbours[n].offset));
  }
  // Not initialised to zero, which would take longer than the work.
  const std::unique_ptr<double[]> rows(new double[neighbours.size() * stride]);
  std::vector<const double*> scales;
  while (scales.size() < neighbours.size()) {
    const std::size_t n = scales.size();
    double* row = &rows[n * stride];
    const Neighbour* opposite = opposite_of(n);
    scales.push_back(
        HWY_DYNAMIC_DISPATCH(fill_scales)(track, first, count, neighbours[n], opposite, row));
    if (opposite) scales.push_back(row);
  }
  HWY_DYNAMIC_DISPATCH(mean_turn_lanes)(track, observed, first, count, neighbours, scales, out);
}
void mean_move(const VectorTrack& track, std::size_t first, std::size_t count,
               std::span<const Neighbour> neighbours, VectorTrack& out) {
  HWY_DYNAMIC_DISPATCH(mean_move_lanes)(track, first, count, neighbours, out);
}

}  // namespace kinemend
#endif
