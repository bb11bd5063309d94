// Damage, cleaning and number formats for the programs that measure figures of the documentation.
#pragma once

#include <cstdint>
#include <string>

#include "experiment.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::papers {

inline Take damaged(Take clip, const std::string& damage, const OptionValues& options,
                    std::uint64_t seed) {
  Random random(seed);
  apply_damage(clip, damage, options, random);
  return clip;
}

inline Take noisy(const Take& clip, double std_deg, double share_of_outliers, std::uint64_t seed) {
  Take result = clip;
  Random random(seed);
  if (std_deg > 0) apply_damage(result, "gaussian", {{"std_deg", std_deg}}, random);
  if (share_of_outliers > 0)
    apply_damage(result, "outliers", {{"share", share_of_outliers}, {"std_deg", 25.0}}, random);
  return result;
}

inline Take cleaned(const Take& clip, const std::string& method, const OptionValues& options = {}) {
  return clean_take(clip, *make_cleaner(method, options)).take;
}

inline std::string figure(double value) { return fmt::format("{:.5g}", value); }

}  // namespace kinemend::papers
