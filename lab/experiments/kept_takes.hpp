// Takes on which neither the shipped `learned` nor the shipped `wiener` was trained.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "experiment.hpp"

namespace kinemend::papers {

/// The hold-out takes of tools/training_clips.py.
inline std::vector<std::string> kept_takes(const Arguments& arguments) {
  if (arguments.quick || arguments.data.empty()) return {"walk"};
  return {"01_13",  "02_05",  "02_10", "05_14", "06_11", "08_08", "09_03",
          "131_07", "135_09", "16_24", "35_01", "35_14", "49_17"};
}

/// Ten seconds of one of these takes.
inline Take kept_take(const Arguments& arguments, const std::string& name) {
  const Take whole = load_take(arguments, name + ".bvh", {.motion = name}).clip;
  constexpr std::size_t most_frames = 1201;
  return slice(whole, 0, std::min(whole.frame_count(), most_frames));
}

}  // namespace kinemend::papers
