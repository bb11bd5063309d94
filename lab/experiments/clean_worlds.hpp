// Clean takes of other worlds; the model of `learned` was trained on a few of these worlds.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "experiment.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend::papers {

/// The takes of each world and unit.
using Worlds = std::map<std::pair<std::string, std::string>, std::vector<Take>>;

/// Returns whether `tools/train_learned` trains the network on this world.
inline bool is_learned_from(const std::string& world) {
  static const std::set<std::string> learned{
      "animated-drawings", "biomechzoo-hockey",   "kaykit",
      "khronos-fox",       "mesh2motion-animals", "opensim-core"};
  return learned.count(world) > 0;
}

inline void add(Worlds& worlds, const std::string& world, Take take) {
  const std::string unit = take.has_joints() ? "deg" : "mm";
  worlds[{world, unit}].push_back(std::move(take));
}

inline Worlds recorded_worlds(const std::filesystem::path& folder) {
  Worlds worlds;
  std::vector<std::filesystem::path> files;
  if (!std::filesystem::is_directory(folder)) return worlds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const std::filesystem::path& file : files) {
    try {
      add(worlds, file.parent_path().filename().string(), read_take(file).take);
    } catch (const Error& error) {
      fmt::print("left out: {}\n", error.what());
    }
  }
  return worlds;
}

inline Worlds made_worlds() {
  Worlds worlds;
  for (const std::string motion : {"walk", "run", "punch"}) {
    for (const double frame_rate_hz : {30.0, 120.0}) {
      const Take take =
          synthesize({.motion = motion, .duration_s = 3, .frame_rate_hz = frame_rate_hz});
      add(worlds, "made", joint_markers(take));
      add(worlds, "made", take);
    }
  }
  return worlds;
}

/// Recorded takes; synthetic takes in the quick form and without data.
inline Worlds clean_worlds(const Arguments& arguments) {
  Worlds worlds;
  if (!arguments.quick && !arguments.data.empty())
    worlds = recorded_worlds(arguments.data / "worlds");
  if (worlds.empty()) worlds = made_worlds();
  return worlds;
}

}  // namespace kinemend::papers
