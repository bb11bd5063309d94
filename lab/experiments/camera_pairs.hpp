// Takes of video and depth cameras beside optical markers of the same motion.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "kinemend/metrics.hpp"
#include "made_pairs.hpp"
#include "page.hpp"
#include "pair_errors.hpp"

namespace kinemend::papers {

/// Errors after fitting a gain and an offset per channel of the reference, as calibration would do;
/// channels that hardly move are left out.
inline PairErrors errors_of(const Take& reference, const Take& noisy, const Take& clip) {
  MarkerComparisonSettings settings;
  settings.fit = MarkerFit::gain_offset;
  settings.fit_to = &noisy;
  settings.least_motion = 5;  // millimetres
  const MarkerErrors all = compare_markers(reference, clip, settings).all;
  return {all.rms, all.velocity_rms, all.above_6_hz.value()};
}

/// Real pairs, or without data walks with the noise of such systems.
inline std::vector<MarkerPair> camera_pairs(const Arguments& arguments) {
  std::vector<MarkerPair> pairs;
  const std::filesystem::path folder = arguments.data / "real";
  if (arguments.data.empty() || !std::filesystem::is_directory(folder)) {
    for (const char* family : {"video", "depth"}) pairs.push_back(made_pair("walk", 30, family));
    return pairs;
  }
  const auto half_of = [&](const std::string& pair, const std::string& half) {
    return read_take(folder / (pair + "." + half + ".trc")).take;
  };
  for (const char* pair :
       {"video-regular_FULL", "video-regular_HEAVY", "video-regular_LITE", "video-60fps_01_FULL",
        "video-60fps_01_HEAVY", "video-60fps_01_LITE", "depth-CTK", "depth-RTK"})
    pairs.push_back({half_of(pair, "reference"), half_of(pair, "noisy")});
  return pairs;
}

}  // namespace kinemend::papers
