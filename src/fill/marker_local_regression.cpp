#include "fill/local_regression.hpp"
#include "fill/marker_methods.hpp"
namespace kinemend::fill {
Filling fill_by_local_regression(const Samples& samples, const MarkerGap& gap,
                                 const MarkerRequest& r) {
  return fill_by_auto(samples, gap, r);
}
}  // namespace kinemend::fill
