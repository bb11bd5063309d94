// Finds real takes of the CMU database by name.
#pragma once

#include <filesystem>
#include <string>

#include "kinemend/io.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {

/// A take of CMU's by its name, without its calibration pose.
inline Take real_clip(const std::string& name) {
  for (const char* folder : {"cmu/bvh", "cmu/bvh-rotations"}) {
    const std::filesystem::path path =
        std::filesystem::path(KINEMEND_DATA_FOLDER) / folder / (name + ".bvh");
    if (std::filesystem::exists(path)) return without_calibration(read_joints(path).take);
  }
  throw Error(ErrorKind::unreadable_input, "no real take " + name);
}

}  // namespace kinemend::quality
