// Points of real takes with artificial gaps.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "fill/made_gaps.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend::quality {

/// The points of a take from number `skip` on, at most `most`; later ones are angles and similar
/// data.
inline Take points_of(const std::filesystem::path& path, std::size_t skip, std::size_t most) {
  const Take all = read_take(path).take;
  std::vector<std::size_t> kept;
  std::vector<std::string> names;
  for (std::size_t m = skip; m < all.marker_count() && kept.size() < most; ++m) {
    kept.push_back(m);
    names.push_back(all.names[m]);
  }
  Take clip = make_marker_take(names, all.frame_count(), all.frame_rate_hz);
  for (std::size_t f = 0; f < all.frame_count(); ++f) {
    for (std::size_t k = 0; k < kept.size(); ++k) {
      clip.position(f, k) = all.position(f, kept[k]);
      clip.observed[f * kept.size() + k] = all.is_observed(f, kept[k]) ? 1 : 0;
    }
  }
  return clip;
}

/// Adds three gaps to each of five markers, at random places.
inline Take with_gaps(const Take& truth, std::size_t length, std::uint64_t seed) {
  constexpr std::size_t damaged_markers = 5, apart = 10;
  Take clip = truth;
  Random random(seed);
  std::vector<std::size_t> order(clip.marker_count());
  for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
  for (std::size_t i = 0; i < damaged_markers; ++i) {
    std::swap(order[i], order[i + random.below(order.size() - i)]);
    for (const std::size_t start : fill::three_starts(random, clip.frame_count(), length, apart)) {
      const NamedGap gap{clip.names[order[i]], start, start + length - 1};
      mark_gaps(clip, {&gap, 1});
    }
  }
  return clip;
}

}  // namespace kinemend::quality
