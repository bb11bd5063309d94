// Damages and cleans clips and measures the error, for tests of quality.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"

namespace kinemend::quality {

/// The motion of a clip, without a calibration pose at its start.
inline Take without_calibration(const Take& clip) {
  return slice(clip, leading_calibration_frames(clip), clip.frame_count());
}

/// White rotation noise of `noise_deg` per axis on every joint and frame, and, for `outlier_share`
/// of the samples, random rotations of 25 degrees per axis.
inline Take damaged(const Take& truth, double noise_deg, double outlier_share, std::uint64_t seed) {
  Take clip = truth;
  Random random(seed);
  apply_damage(clip, "gaussian", {{"std_deg", noise_deg}}, random);
  if (outlier_share > 0) {
    apply_damage(clip, "outliers", {{"share", outlier_share}, {"std_deg", 25.0}}, random);
  }
  return clip;
}

inline Take cleaned(const Take& clip, std::string_view method, const OptionValues& options = {}) {
  return clean_take(clip, *make_cleaner(method, options)).take;
}

/// Root mean square and 99th percentile of the angle to the truth, over all joints and frames,
/// degrees.
struct Figures {
  double rms = 0;
  double p99 = 0;
};

inline Figures figures(const Take& truth, const Take& other) {
  return {geodesic_rms_deg(truth, other), geodesic_percentile_deg(truth, other, 99)};
}

/// Every filter with fixed parameters, over the settings that a user would try.
inline std::vector<std::pair<std::string, OptionValues>> fixed_filters() {
  std::vector<std::pair<std::string, OptionValues>> list;
  for (const double width : {0.01, 0.02, 0.03, 0.04, 0.06}) {
    list.emplace_back("gaussian", OptionValues{{"width_s", width}});
  }
  for (const double cutoff : {4.0, 6.0, 8.0, 10.0, 14.0}) {
    list.emplace_back("butterworth", OptionValues{{"cutoff_hz", cutoff}});
  }
  for (const double window : {0.05, 0.1}) {
    list.emplace_back("median", OptionValues{{"window_s", window}});
    list.emplace_back("hampel", OptionValues{{"window_s", window}});
  }
  for (const std::int64_t passes : {2, 4, 8}) {
    list.emplace_back("weighted-mean", OptionValues{{"passes", passes}});
  }
  for (const char* threshold : {"universal", "sure"}) {
    list.emplace_back("wavelet", OptionValues{{"threshold", std::string(threshold)}});
  }
  for (const char* method : {"kalman", "bilateral", "nonlocal", "one-euro"})
    list.emplace_back(method, OptionValues{});
  return list;
}

inline std::string describe(const std::pair<std::string, OptionValues>& filter) {
  std::string text = filter.first;
  for (const auto& [name, value] : filter.second) text += " " + name + "=" + to_string(value);
  return text;
}

}  // namespace kinemend::quality
