// Looks up the filters of Daubechies wavelets and symlets.
#include <fmt/format.h>

#include "kinemend/experimental/signal.hpp"
#include "signal/checks.hpp"
#include "signal/wavelet_table.hpp"

namespace kinemend {

std::vector<double> wavelet_filter(WaveletFamily family, int vanishing_moments) {
  const bool symlet = family == WaveletFamily::symlet;
  const int fewest = symlet ? 2 : 1;
  signal::require(vanishing_moments >= fewest && vanishing_moments <= signal::most_moments,
                  fmt::format("{} vanishing moments are outside {} to {}", vanishing_moments,
                              fewest, signal::most_moments));
  const double* filter = symlet ? signal::symlet_filters : signal::daubechies_filters;
  for (int moments = fewest; moments < vanishing_moments; ++moments) filter += 2 * moments;
  return {filter, filter + 2 * vanishing_moments};
}

}  // namespace kinemend
