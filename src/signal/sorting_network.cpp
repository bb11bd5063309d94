// Builds Batcher's network and keeps the exchanges on which the median depends.
#include "signal/sorting_network.hpp"

#include <algorithm>

namespace kinemend::signal {

SortingNetwork sorting_network(std::size_t width) {
  // The network of the next power of two, without the exchanges that touch the missing (largest)
  // values.
  SortingNetwork network;
  for (std::size_t run = 1; run < width; run *= 2) {
    for (std::size_t gap = run; gap >= 1; gap /= 2) {
      for (std::size_t start = gap % run; start + gap < width; start += 2 * gap) {
        for (std::size_t i = start; i < start + gap && i + gap < width; ++i) {
          if (i / (2 * run) == (i + gap) / (2 * run)) {
            network.emplace_back(static_cast<std::uint32_t>(i),
                                 static_cast<std::uint32_t>(i + gap));
          }
        }
      }
    }
  }
  return network;
}

SortingNetwork median_network(std::size_t width) {
  const SortingNetwork full = sorting_network(width);
  std::vector<bool> needed(width, false);
  needed[width / 2] = true;
  SortingNetwork kept;
  for (auto exchange = full.rbegin(); exchange != full.rend(); ++exchange) {
    if (!needed[exchange->first] && !needed[exchange->second]) continue;
    needed[exchange->first] = needed[exchange->second] = true;
    kept.push_back(*exchange);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

}  // namespace kinemend::signal
