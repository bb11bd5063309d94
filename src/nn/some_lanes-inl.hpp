// Loads and stores the first lanes of a vector, at any address and without accessing memory beyond
// them. Included again for each instruction set.
#if defined(KINEMEND_NN_SOME_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef KINEMEND_NN_SOME_LANES
#undef KINEMEND_NN_SOME_LANES
#else
#define KINEMEND_NN_SOME_LANES
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace kinemend::nn::HWY_NAMESPACE {

// On processors without masks, Highway's own functions for this need aligned addresses, and read
// whole vectors.
#if HWY_ARCH_X86 && HWY_TARGET <= HWY_AVX2
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_some(D d, const hwy::HWY_NAMESPACE::TFromD<D>* values,
                                                std::size_t count) {
  namespace lanes = hwy::HWY_NAMESPACE;
  return lanes::MaskedLoad(lanes::FirstN(d, count), d, values);
}
template <class D>
HWY_INLINE void store_some(hwy::HWY_NAMESPACE::Vec<D> vector, D d,
                           hwy::HWY_NAMESPACE::TFromD<D>* values, std::size_t count) {
  namespace lanes = hwy::HWY_NAMESPACE;
  lanes::BlendedStore(vector, lanes::FirstN(d, count), d, values);
}
#else
template <class D>
HWY_INLINE hwy::HWY_NAMESPACE::Vec<D> load_some(D d, const hwy::HWY_NAMESPACE::TFromD<D>* values,
                                                std::size_t count) {
  namespace lanes = hwy::HWY_NAMESPACE;
  HWY_ALIGN lanes::TFromD<D> room[lanes::MaxLanes(D())] = {};
  std::copy_n(values, count, room);
  return lanes::Load(d, room);
}
template <class D>
HWY_INLINE void store_some(hwy::HWY_NAMESPACE::Vec<D> vector, D d,
                           hwy::HWY_NAMESPACE::TFromD<D>* values, std::size_t count) {
  namespace lanes = hwy::HWY_NAMESPACE;
  HWY_ALIGN lanes::TFromD<D> room[lanes::MaxLanes(D())];
  lanes::Store(vector, d, room);
  std::copy_n(room, count, values);
}
#endif

}  // namespace kinemend::nn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
