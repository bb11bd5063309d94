// The format glTF 2.0, as binary and as text: recognises, reads and writes takes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Returns how likely the head of a file is glTF, 0 to 100; 100 for a binary file.
int sniff_glb(std::string_view head);
int sniff_gltf(std::string_view head);

/// Reads the animation `ReadOptions::animation` of a scene: its skins' joints, or without a skin
/// the nodes that it moves, or markers from `write_glb`. Metres, Y up. Errors:
/// `unreadable_input` with the byte; `usage` for an animation that does not exist.
TakeResult read_glb(std::string bytes, std::string_view name, const ReadOptions& options);
TakeResult read_gltf(std::string bytes, std::string_view name, const ReadOptions& options);

/// Writes a take. A take that was read from glTF is written as its source, in which only the keys
/// of changed joints differ. Any other take becomes an animated skeleton with a skinned mesh of its
/// bones, in metres (`metres_per_unit`, a guess by the skeleton's height, or 1), with unchanged
/// axes; markers become small moving spheres, in metres (the unit is a millimetre if the take names
/// no known unit), and a missing marker has scale 0. Errors: `usage` for an invalid take.
std::string write_glb(const Take& take);
std::string write_gltf(const Take& take);

/// Returns a new binary file, as described at `write_glb`, with these curves in the extras of its
/// animation. The take must be valid.
std::string new_glb_of(const Take& take, std::span<const NamedCurve> curves = {});

/// Returns `files_of_take` of a take in glTF. `output`: the path of the result.
TakeFiles glb_files_of_take(const Take& take, const std::filesystem::path& output);
TakeFiles gltf_files_of_take(const Take& take, const std::filesystem::path& output);

/// Lists the data besides the motion that is lost if the take needs a new file; empty if its source
/// is rewritten or is of another format.
std::vector<std::string> lost_beside_gltf(const Take& take);

}  // namespace kinemend
