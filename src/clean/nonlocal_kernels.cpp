#include "clean/nonlocal_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "clean/nonlocal_kernels.cpp"
#include "hwy/foreach_target.h"
// Behind foreach_target.h, which includes this file again for each target.
#include "clean/rotation_lanes-inl.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinemend {
namespace HWY_NAMESPACE {

using namespace lanes;  // NOLINT(google-build-using-namespace)

HWY_INLINE LaneQuat load_sample(const RotationTrack& t, std::size_t i) {
  return {load(&t.w[i]), load(&t.x[i]), load(&t.y[i]), load(&t.z[i])};
}
HWY_INLINE LaneVec load_sample(const VectorTrack& t, std::size_t i) {
  return {load(&t.x[i]), load(&t.y[i]), load(&t.z[i])};
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

void decay_lanes(double scale, const double* floors, std::size_t count, double* values) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const Lanes excess = hn::Max(sub(load(values + i), load(floors + i)), hn::Zero(tag));
    store(exponential_decay(mul(all(scale), excess)), values + i);
  }
}

// d(x_i, x_{i+n}) is Log(x_i^-1 x_{i+n}) or the difference.
template <class Track, class Difference>
HWY_INLINE void mean_difference(const Track& track, const double* observed, std::size_t first,
                                std::size_t count, std::span<const Neighbour> neighbours,
                                const Difference& difference, VectorTrack& out) {
  for (std::size_t i = 0; i < count; i += hn::Lanes(tag)) {
    const auto own = load_sample(track, first + i);
    Lanes total = observed ? load(observed + first + i) : all(1.0);
    LaneVec sum{hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
    for (const Neighbour& n : neighbours) {
      Lanes weight = load(n.weights + i);
      if (hn::AllFalse(tag, hn::Gt(weight, hn::Zero(tag)))) continue;
      const std::size_t there = first + i + static_cast<std::size_t>(n.offset);
      if (observed) weight = mul(weight, load(observed + there));
      const LaneVec d = difference(own, load_sample(track, there));
      total = add(total, weight);
      sum.x = mul_add(weight, d.x, sum.x);
      sum.y = mul_add(weight, d.y, sum.y);
      sum.z = mul_add(weight, d.z, sum.z);
    }
    const Lanes share = hn::Div(all(1.0), hn::Max(total, all(1e-300)));
    store(mul(share, sum.x), &out.x[i]);
    store(mul(share, sum.y), &out.y[i]);
    store(mul(share, sum.z), &out.z[i]);
  }
}

void mean_turn_lanes(const RotationTrack& track, const double* observed, std::size_t first,
                     std::size_t count, std::span<const Neighbour> neighbours, VectorTrack& out) {
  mean_difference(
      track, observed, first, count, neighbours,
      [](const LaneQuat& a, const LaneQuat& b) { return logarithm(a, b); }, out);
}

void mean_move_lanes(const VectorTrack& track, std::size_t first, std::size_t count,
                     std::span<const Neighbour> neighbours, VectorTrack& out) {
  mean_difference(
      track, nullptr, first, count, neighbours,
      [](const LaneVec& a, const LaneVec& b) {
        return LaneVec{sub(b.x, a.x), sub(b.y, a.y), sub(b.z, a.z)};
      },
      out);
}

}  // namespace HWY_NAMESPACE
}  // namespace kinemend
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend {

HWY_EXPORT(add_squared_angles_lanes);
HWY_EXPORT(add_observed_angles_lanes);
HWY_EXPORT(decay_lanes);
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
void decay(double scale, const double* floors, std::size_t count, double* values) {
  HWY_DYNAMIC_DISPATCH(decay_lanes)(scale, floors, count, values);
}
void mean_turn(const RotationTrack& track, const double* observed, std::size_t first,
               std::size_t count, std::span<const Neighbour> neighbours, VectorTrack& out) {
  HWY_DYNAMIC_DISPATCH(mean_turn_lanes)(track, observed, first, count, neighbours, out);
}
void mean_move(const VectorTrack& track, std::size_t first, std::size_t count,
               std::span<const Neighbour> neighbours, VectorTrack& out) {
  HWY_DYNAMIC_DISPATCH(mean_move_lanes)(track, first, count, neighbours, out);
}

}  // namespace kinemend
#endif
