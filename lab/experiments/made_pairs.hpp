// Pairs of one motion from two systems, for the quick forms of experiments on real pairs.
#pragma once

#include <cstdint>
#include <string>

#include "kinemend/lab/corrupt.hpp"
#include "registry/marker_takes.hpp"

namespace kinemend::papers {

struct MarkerPair {
  Take reference, noisy;  ///< millimetres
};

/// Five seconds of a synthetic motion, paired with the same motion with the noise of a family of
/// systems (`corrupt::system_families`).
inline MarkerPair made_pair(const std::string& motion, double frame_rate_hz,
                            const std::string& family, std::uint64_t seed = 1) {
  MarkerPair pair;
  pair.reference = test::marker_take(motion, 5, frame_rate_hz);
  pair.noisy = pair.reference;
  Random random(seed);
  apply_damage(pair.noisy, "system", {{"kind", family}}, random);
  return pair;
}

}  // namespace kinemend::papers
