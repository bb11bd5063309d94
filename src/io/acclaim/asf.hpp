// The format ASF: recognises, reads and writes skeletons.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// A degree of freedom as ASF names it: `tx` to `rz`, or empty for `l`, the stretch of a bone,
/// which has a column but no effect on the pose.
using AsfDof = std::optional<Channel>;

/// A skeleton as an ASF file states it, joints depth first: joint 0 is `root`, every other joint is
/// at the beginning of its bone and has the bone's name; the end of a bone without children is an
/// end site.
struct AsfSkeleton {
  Skeleton skeleton;
  std::vector<std::vector<AsfDof>> dofs;  ///< J, in the order of the AMC columns
  double metres_per_unit = 0;             ///< 0.0254 / `length`; 0 if `length` is missing or 1
  bool radians = false;
};

/// Returns the channels of a joint. ASF rotates about fixed axes in the order of their names, and a
/// `Skeleton` writes the product from left to right, so the rotations are reversed: `rx ry rz` is R
/// = Rz Ry Rx.
std::vector<Channel> channels_of(const std::vector<AsfDof>& dofs);
/// Returns for each degree of freedom its index in `channels_of(dofs)`; empty for `l`.
std::vector<std::optional<std::size_t>> channel_slots(const std::vector<AsfDof>& dofs);

/// Parses an ASF file. Errors: `unreadable_input` with the line.
AsfSkeleton parse_asf(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth);

/// Returns how likely the head of a file is ASF, 0 to 100.
int sniff_asf(std::string_view head);
/// Reads a skeleton alone as a clip of zero frames. Errors: `unreadable_input` with the line.
TakeResult read_asf(std::string bytes, std::string_view name, const ReadOptions& options);
/// Writes the skeleton of a clip: the bytes it was read from if it is unchanged, else a file that
/// fits the output of `write_amc`. Errors: `usage` if the format cannot hold the skeleton.
std::string write_asf(const Take& clip);

}  // namespace kinemend
