// The format glTF 2.0, as binary and as text: recognises, reads and writes takes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/io.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// 100 for a binary glTF file; likely for the text of one.
int sniff_glb(std::string_view head);
int sniff_gltf(std::string_view head);

/// Reads the animation `ReadOptions::animation` of a scene: its skins' joints, or what it moves
/// where there is no skin, or markers that `write_glb_markers` has written. Metres, Y up. Errors:
/// `unreadable_input` with the byte; `usage` for an animation that is not there.
TakeResult read_glb(std::string bytes, std::string_view name, const ReadOptions& options);
TakeResult read_gltf(std::string bytes, std::string_view name, const ReadOptions& options);

/// A take that was read from glTF comes back in its source, in which only the keys of changed
/// joints differ. Any other becomes an animated skeleton with a skinned mesh of its bones, in
/// metres (`metres_per_unit`, a guess by the skeleton's height, or 1), axes as they are. Errors:
/// `usage` for an invalid clip.
std::string write_glb(const Take& clip);
std::string write_gltf(const Take& clip);
/// The same for markers: a new file has small spheres that move, in metres (millimetres where the
/// clip names no known unit); a missing one shrinks to nothing.
std::string write_glb_markers(const Take& clip);
std::string write_gltf_markers(const Take& clip);

/// `files_of_take` of a take in glTF. `output`: where it will stand.
TakeFiles gltf_files_of_take(const Take& take, bool as_binary, const std::filesystem::path& output);

/// What the source of a take holds beside its motion, where a new file takes its place; empty where
/// the take is written in place, or comes from another format.
std::vector<std::string> lost_beside_gltf(const Take& take);

}  // namespace kinemend
