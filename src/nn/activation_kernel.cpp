// The functions exp, tanh, sigmoid and relu and the gates of an LSTM, compiled once for each
// instruction set.
#include "nn/kernels.hpp"

#include "base/simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nn/activation_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "nn/some_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace kinemend::nn::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<float>;
using V = hn::Vec<Tag>;

// e^x = 2^n e^r, with r within half of ln 2, by the minimax polynomial of Cephes. Products and sums
// are not fused, so that every processor rounds alike.
HWY_INLINE V exp_lanes(Tag d, V x) {
  x = hn::Min(hn::Max(x, hn::Set(d, -87.0F)), hn::Set(d, 87.0F));
  const V n = hn::Round(hn::Mul(x, hn::Set(d, 1.44269504F)));
  V r = hn::Sub(x, hn::Mul(n, hn::Set(d, 0.693359375F)));
  r = hn::Sub(r, hn::Mul(n, hn::Set(d, -2.12194440e-4F)));
  V p = hn::Set(d, 1.9875691500e-4F);
  for (const float c :
       {1.3981999507e-3F, 8.3334519073e-3F, 4.1665795894e-2F, 1.6666665459e-1F, 5.0000001201e-1F})
    p = hn::Add(hn::Mul(p, r), hn::Set(d, c));
  p = hn::Add(hn::Add(hn::Mul(hn::Mul(p, r), r), r), hn::Set(d, 1.0F));
  const hn::RebindToSigned<Tag> di;
  const auto power = hn::ShiftLeft<23>(hn::Add(hn::ConvertTo(di, n), hn::Set(di, 127)));
  return hn::Mul(p, hn::BitCast(d, power));
}

HWY_INLINE V sigmoid_lanes(Tag d, V x) {
  const V one = hn::Set(d, 1.0F);
  return hn::Div(one, hn::Add(one, exp_lanes(d, hn::Neg(x))));
}

HWY_INLINE V tanh_lanes(Tag d, V x) {
  const V one = hn::Set(d, 1.0F), two = hn::Set(d, 2.0F);
  return hn::Sub(one, hn::Div(two, hn::Add(one, exp_lanes(d, hn::Mul(two, x)))));
}

// Applies `function` to whole vectors, then to the remainder, padded with zeros.
template <class Function>
HWY_INLINE void for_lanes(float* values, std::size_t count, const Function& function) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    hn::StoreU(function(d, hn::LoadU(d, values + i)), d, values + i);
  if (i == count) return;
  store_some(function(d, load_some(d, values + i, count - i)), d, values + i, count - i);
}

void exp_f32(float* values, std::size_t count) {
  for_lanes(values, count, [](Tag d, V x) HWY_ATTR { return exp_lanes(d, x); });
}
void tanh_f32(float* values, std::size_t count) {
  for_lanes(values, count, [](Tag d, V x) HWY_ATTR { return tanh_lanes(d, x); });
}
void sigmoid_f32(float* values, std::size_t count) {
  for_lanes(values, count, [](Tag d, V x) HWY_ATTR { return sigmoid_lanes(d, x); });
}
void relu_f32(float* values, std::size_t count) {
  for_lanes(values, count, [](Tag d, V x) HWY_ATTR { return hn::Max(x, hn::Zero(d)); });
}

// The first lanes of a row, or all if they are a whole vector.
struct Lanes {
  Tag d;
  std::size_t from;
  std::size_t count;

  HWY_INLINE V load(const float* values) const {
    if (count == hn::Lanes(d)) return hn::LoadU(d, values + from);
    return load_some(d, values + from, count);
  }
  HWY_INLINE void store(V value, float* values) const {
    if (count == hn::Lanes(d)) {
      hn::StoreU(value, d, values + from);
    } else {
      store_some(value, d, values + from, count);
    }
  }
};

template <class Use>
HWY_INLINE void for_parts(std::size_t count, const Use& use) {
  const Tag d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t from = 0; from < count; from += lanes)
    use(Lanes{d, from, count - from < lanes ? count - from : lanes});
}

void lstm_f32(float* gates, std::size_t units, float* cell, float* state) {
  for_parts(units, [&](const Lanes& part) HWY_ATTR {
    const Tag d = part.d;
    const V in = sigmoid_lanes(d, part.load(gates));
    const V forget = sigmoid_lanes(d, part.load(gates + units));
    const V fresh = tanh_lanes(d, part.load(gates + 2 * units));
    const V out = sigmoid_lanes(d, part.load(gates + 3 * units));
    const V c = hn::Add(hn::Mul(forget, part.load(cell)), hn::Mul(in, fresh));
    part.store(c, cell);
    part.store(hn::Mul(out, tanh_lanes(d, c)), state);
  });
}

}  // namespace kinemend::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace kinemend::nn {
HWY_EXPORT(exp_f32);
HWY_EXPORT(tanh_f32);
HWY_EXPORT(sigmoid_f32);
HWY_EXPORT(relu_f32);
HWY_EXPORT(lstm_f32);

void exp_of(float* values, std::size_t count) { HWY_DYNAMIC_DISPATCH(exp_f32)(values, count); }
void tanh_of(float* values, std::size_t count) { HWY_DYNAMIC_DISPATCH(tanh_f32)(values, count); }
void sigmoid_of(float* values, std::size_t count) {
  HWY_DYNAMIC_DISPATCH(sigmoid_f32)(values, count);
}
void relu_of(float* values, std::size_t count) { HWY_DYNAMIC_DISPATCH(relu_f32)(values, count); }
void lstm_gates(float* gates, std::size_t units, float* cell, float* state) {
  HWY_DYNAMIC_DISPATCH(lstm_f32)(gates, units, cell, state);
}
}  // namespace kinemend::nn
#endif
