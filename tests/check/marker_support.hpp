// Synthetic markers with exchanged labels, for tests of checks.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/check.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend::test {

/// The joints and end sites of a synthetic take as markers, in centimetres, with measurement noise.
inline Take synthetic_markers(const std::string& motion, double duration_s = 6,
                              double noise_cm = 0.02, std::uint64_t seed = 1) {
  SynthOptions options;
  options.motion = motion;
  options.duration_s = duration_s;
  options.seed = seed;
  const Take clip = synthesize(options);
  std::vector<std::string> names = clip.skeleton.names;
  for (const EndSite& site : clip.skeleton.end_sites)
    names.push_back(clip.skeleton.names[static_cast<std::size_t>(site.parent)] + "End");
  Take markers = make_marker_take(names, clip.frame_count(), clip.frame_rate_hz);
  markers.positions = joint_positions(clip, true);
  markers.unit = "cm";
  Random random(seed);
  for (Vec3& p : markers.positions) {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    p += noise_cm * Vec3{x, y, z};
  }
  std::fill(markers.observed.begin(), markers.observed.end(), std::uint8_t{1});
  return markers;
}

inline std::size_t pick(Random& random, std::size_t below) {
  return std::min(static_cast<std::size_t>(random.uniform(0, static_cast<double>(below))),
                  below - 1);
}

struct SwapTrial {
  Take clip;
  std::vector<MarkerSwap> swaps;
};

/// Exchanges random pairs of position markers over random spans of 3 frames to 2 s. Each marker is
/// in at most one pair. The markers of a pair are at least `least_distance` (file units) apart
/// where the swap begins and ends; an exchange of closer markers would change nothing.
inline SwapTrial with_random_swaps(Take clip, std::size_t wanted, double least_distance,
                                   std::uint64_t seed) {
  Random random(seed);
  SwapTrial trial{std::move(clip), {}};
  const std::size_t markers = trial.clip.marker_count(), frames = trial.clip.frame_count();
  std::vector<std::uint8_t> used(markers);
  for (int attempt = 0; attempt < 1000 && trial.swaps.size() < wanted; ++attempt) {
    const std::size_t a = pick(random, markers), b = pick(random, markers);
    const auto longest = static_cast<std::size_t>(2 * trial.clip.frame_rate_hz);
    const std::size_t length = 3 + pick(random, longest - 2);
    if (a >= b || used[a] != 0 || used[b] != 0 || length + 10 >= frames) continue;
    if (!trial.clip.holds_positions(a) || !trial.clip.holds_positions(b)) continue;
    const std::size_t first = 5 + pick(random, frames - length - 9);
    const MarkerSwap swap{a, b, first, first + length - 1};
    const auto apart = [&](std::size_t f) {
      return trial.clip.is_observed(f, a) && trial.clip.is_observed(f, b) &&
             norm(trial.clip.position(f, a) - trial.clip.position(f, b)) > least_distance;
    };
    if (!apart(swap.first_frame) || !apart(swap.first_frame - 1) || !apart(swap.last_frame) ||
        !apart(swap.last_frame + 1))
      continue;
    used[a] = used[b] = 1;
    undo_swaps(trial.clip, {swap});  // exchanging again restores the labels
    trial.swaps.push_back(swap);
  }
  return trial;
}

struct Tally {
  std::size_t put_in = 0, found = 0, right = 0;

  void add(const std::vector<MarkerSwap>& truth, const std::vector<MarkerSwap>& answer) {
    put_in += truth.size();
    found += answer.size();
    for (const MarkerSwap& swap : answer)
      right += std::find(truth.begin(), truth.end(), swap) != truth.end();
  }
  double precision() const {
    return found == 0 ? 1 : static_cast<double>(right) / static_cast<double>(found);
  }
  double recall() const {
    return put_in == 0 ? 1 : static_cast<double>(right) / static_cast<double>(put_in);
  }
};

}  // namespace kinemend::test
