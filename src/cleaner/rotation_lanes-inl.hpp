// Rotations in the lanes of a vector: angle, Log and Exp by polynomials, without table or branch.
// Compiled once for each target of the processor. Products are never fused with sums, so that all
// targets give the same bits.
#if defined(KINEMEND_CLEAN_ROTATION_LANES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef KINEMEND_CLEAN_ROTATION_LANES_INL_HPP
#undef KINEMEND_CLEAN_ROTATION_LANES_INL_HPP
#else
#define KINEMEND_CLEAN_ROTATION_LANES_INL_HPP
#endif

#include <cstddef>
#include <cstdint>

#include "cleaner/pieces.hpp"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace kinemend {
namespace HWY_NAMESPACE {
namespace lanes {

namespace hn = hwy::HWY_NAMESPACE;

// At most 8 lanes: the arrays have that many extra elements at the end.
using Doubles = hn::CappedTag<double, 8>;
using Lanes = hn::Vec<Doubles>;
inline constexpr Doubles tag{};

HWY_INLINE Lanes load(const double* from) { return hn::LoadU(tag, from); }
HWY_INLINE void store(Lanes value, double* to) { hn::StoreU(value, tag, to); }
HWY_INLINE Lanes all(double value) { return hn::Set(tag, value); }
HWY_INLINE Lanes mul(Lanes a, Lanes b) { return hn::Mul(a, b); }
HWY_INLINE Lanes add(Lanes a, Lanes b) { return hn::Add(a, b); }
HWY_INLINE Lanes sub(Lanes a, Lanes b) { return hn::Sub(a, b); }
HWY_INLINE Lanes mul_add(Lanes a, Lanes b, Lanes c) { return add(mul(a, b), c); }

struct LaneVec {
  Lanes x, y, z;
};
struct LaneQuat {
  Lanes w, x, y, z;
};

// Consecutive samples of a track from frame i on, one in each lane.
HWY_INLINE LaneQuat load_sample(const RotationTrack& track, std::size_t i) {
  return {load(&track.w[i]), load(&track.x[i]), load(&track.y[i]), load(&track.z[i])};
}
HWY_INLINE LaneVec load_sample(const VectorTrack& track, std::size_t i) {
  return {load(&track.x[i]), load(&track.y[i]), load(&track.z[i])};
}
HWY_INLINE void store_sample(const LaneQuat& sample, RotationTrack& track, std::size_t i) {
  store(sample.w, &track.w[i]);
  store(sample.x, &track.x[i]);
  store(sample.y, &track.y[i]);
  store(sample.z, &track.z[i]);
}
HWY_INLINE void store_sample(const LaneVec& sample, VectorTrack& track, std::size_t i) {
  store(sample.x, &track.x[i]);
  store(sample.y, &track.y[i]);
  store(sample.z, &track.z[i]);
}

// sum_i coefficients[i] x^i
template <std::size_t count>
HWY_INLINE Lanes polynomial(const double (&coefficients)[count], Lanes x) {
  Lanes value = all(coefficients[count - 1]);
  for (std::size_t i = count - 1; i-- > 0;) value = mul_add(value, x, all(coefficients[i]));
  return value;
}

// tools/reference/rotation_polynomials.py
inline constexpr double squared_angle_coefficients[] = {
    16.00000000000093,  5.3333333324972445, 2.8444445686499504, 1.8285641786263418,
    1.3005379852789574, 0.9810721824012777, 0.826846378013875,  0.2555560557755633,
    2.671773050130507,  -8.051105574980244, 24.295153255876045, -46.275621755828126,
    60.711935438346586, -46.99020524864121, 17.599355679461556};
inline constexpr double logarithm_coefficients[] = {
    1.9999999999999885,    1.3333333333483177, 1.066666663452263,   0.9142859866825855,
    0.8126862801565362,    0.7391443149692565, 0.6761542712411288,  0.7086768141057002,
    -0.044014937232531144, 4.789204043584374,  -20.142742656516162, 76.51760285050982,
    -208.24240342800962,   423.3293677289924,  -614.1977260845676,  609.2447740446501,
    -369.89881663463524,   106.32525899737351};
inline constexpr double exponential_coefficients[] = {
    1.0,        1.0,         1.0 / 2,      1.0 / 6,       1.0 / 24,       1.0 / 120,      1.0 / 720,
    1.0 / 5040, 1.0 / 40320, 1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600};
// cos(y) and sin(y) / y as series in y^2, for |y| up to pi / 2.
inline constexpr double cosine_coefficients[] = {1.0,
                                                 -1.0 / 2,
                                                 1.0 / 24,
                                                 -1.0 / 720,
                                                 1.0 / 40320,
                                                 -1.0 / 3628800,
                                                 1.0 / 479001600,
                                                 -1.0 / 87178291200,
                                                 1.0 / 20922789888000,
                                                 -1.0 / 6402373705728000,
                                                 1.0 / 2432902008176640000};
inline constexpr double sinc_coefficients[] = {1.0,
                                               -1.0 / 6,
                                               1.0 / 120,
                                               -1.0 / 5040,
                                               1.0 / 362880,
                                               -1.0 / 39916800,
                                               1.0 / 6227020800,
                                               -1.0 / 1307674368000,
                                               1.0 / 355687428096000,
                                               -1.0 / 121645100408832000,
                                               1.0 / 51090942171709440000.0};

HWY_INLINE Lanes dot(const LaneQuat& a, const LaneQuat& b) {
  return add(add(mul(a.w, b.w), mul(a.x, b.x)), add(mul(a.y, b.y), mul(a.z, b.z)));
}

// sin^2(angle / 4) of the rotation a^-1 b, from |a . b|.
HWY_INLINE Lanes quarter_sine(Lanes absolute_dot) {
  const Lanes half = all(0.5);
  return hn::Max(sub(half, mul(half, absolute_dot)), hn::Zero(tag));
}

// Log(a^-1 b)|^2: relative error below 1e-13, except for 1e-15 rad^2 of rounding at zero.
HWY_INLINE Lanes squared_angle(const LaneQuat& a, const LaneQuat& b) {
  const Lanes u = quarter_sine(hn::Abs(dot(a, b)));
  return mul(u, polynomial(squared_angle_coefficients, u));
}

// Log(a^-1 b): error below 3e-14 rad; exactly zero for a = b and a = -b.
HWY_INLINE LaneVec logarithm(const LaneQuat& a, const LaneQuat& b) {
  const Lanes cosine = dot(a, b);
  const Lanes u = quarter_sine(hn::Abs(cosine));
  const Lanes scale = polynomial(logarithm_coefficients, u);
  const Lanes signed_scale = hn::IfThenElse(hn::Lt(cosine, hn::Zero(tag)), hn::Neg(scale), scale);
  return {
      mul(signed_scale, sub(sub(mul(a.w, b.x), mul(a.x, b.w)), sub(mul(a.y, b.z), mul(a.z, b.y)))),
      mul(signed_scale, sub(sub(mul(a.w, b.y), mul(a.y, b.w)), sub(mul(a.z, b.x), mul(a.x, b.z)))),
      mul(signed_scale, sub(sub(mul(a.w, b.z), mul(a.z, b.w)), sub(mul(a.x, b.y), mul(a.y, b.x))))};
}

// exp(-x) for x >= 0, relative error below 1e-15; 0 from x = 708 on.
HWY_INLINE Lanes exponential_decay(Lanes x) {
  const Lanes limit = all(708.0);
  const Lanes power = hn::Round(mul(hn::Min(x, limit), all(-1.4426950408889634)));
  // ln 2 in two parts, the first of few enough bits for an exact product.
  Lanes rest = sub(hn::Neg(hn::Min(x, limit)), mul(power, all(0.6931471804855391)));
  rest = sub(rest, mul(power, all(7.440617110012397e-11)));
  const Lanes fraction = polynomial(exponential_coefficients, rest);
  // 2^power: the integer is moved into the exponent's bits.
  const hn::RebindToSigned<Doubles> integers;
  const auto magic =
      all(6755399441055744.0 + 1023.0);  // 1.5 * 2^52 puts an integer into the low bits
  const auto exponent = hn::ShiftLeft<52>(hn::BitCast(integers, add(power, magic)));
  const Lanes result = mul(fraction, hn::BitCast(tag, exponent));
  return hn::IfThenZeroElse(hn::Ge(x, limit), result);
}

// Exp(v), error below 1e-15 for |v| up to 1000; w >= 0, so that q Exp(v) has the sign of q.
HWY_INLINE LaneQuat exponential(const LaneVec& v) {
  const Lanes angle = hn::Sqrt(add(mul(v.x, v.x), add(mul(v.y, v.y), mul(v.z, v.z))));
  const Lanes half = mul(angle, all(0.5));
  // Subtracting half turns changes only the quaternion's sign. pi is in two parts.
  const Lanes turns = hn::Round(mul(half, all(0.31830988618379067)));
  Lanes y = sub(half, mul(turns, all(3.1415926218032837)));
  y = sub(y, mul(turns, all(3.178650954705639e-08)));
  const Lanes y2 = mul(y, y);
  const Lanes sine = mul(y, polynomial(sinc_coefficients, y2));
  const Lanes scale = hn::Div(sine, hn::Max(angle, all(1e-300)));
  return {polynomial(cosine_coefficients, y2), mul(scale, v.x), mul(scale, v.y), mul(scale, v.z)};
}

HWY_INLINE LaneQuat multiply(const LaneQuat& a, const LaneQuat& b) {
  return {sub(sub(mul(a.w, b.w), mul(a.x, b.x)), add(mul(a.y, b.y), mul(a.z, b.z))),
          add(add(mul(a.w, b.x), mul(a.x, b.w)), sub(mul(a.y, b.z), mul(a.z, b.y))),
          add(sub(mul(a.w, b.y), mul(a.x, b.z)), add(mul(a.y, b.w), mul(a.z, b.x))),
          add(add(mul(a.w, b.z), mul(a.x, b.y)), sub(mul(a.z, b.w), mul(a.y, b.x)))};
}

}  // namespace lanes
}  // namespace HWY_NAMESPACE
}  // namespace kinemend
HWY_AFTER_NAMESPACE();

#endif
