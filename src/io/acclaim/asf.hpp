// The format ASF: recognises, reads and writes skeletons.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend {

/// A degree of freedom as ASF names it: `tx` to `rz`, or none for `l`, the stretch of a bone, which
/// has a column but no effect on the pose.
using AsfDof = std::optional<Channel>;

/// A skeleton as an ASF file states it, joints depth first: joint 0 is `root`, every other one
/// stands where its bone begins and carries the bone's name; the end of a bone without children is
/// an end site.
struct AsfSkeleton {
  Skeleton skeleton;
  std::vector<std::vector<AsfDof>> dofs;  ///< J, in the order of the AMC columns
  double metres_per_unit = 0;             ///< 0.0254 / `length`; 0 where that is missing or 1
  bool radians = false;
};

/// The channels of a joint. ASF turns about fixed axes, first named first, and a `Skeleton` writes
/// the product from left to right, so the rotations stand in reverse: `rx ry rz` is R = Rz Ry Rx.
std::vector<Channel> channels_of(const std::vector<AsfDof>& dofs);
/// Which of `channels_of(dofs)` each degree of freedom is; none for `l`.
std::vector<std::optional<std::size_t>> channel_slots(const std::vector<AsfDof>& dofs);

/// Errors: `unreadable_input` with the line.
AsfSkeleton parse_asf(const SourceText& text, Diagnostics& diagnostics, std::size_t max_depth);

/// How likely the head of a file is ASF, 0 to 100.
int sniff_asf(std::string_view head);
/// A skeleton alone: a clip of zero frames. Errors: `unreadable_input` with the line.
TakeResult read_asf(std::string bytes, std::string_view name, const ReadOptions& options);
/// The skeleton of a clip: the bytes it was read from where it still is that one, else a file that
/// fits what `write_amc` writes. Errors: `usage` when the format cannot hold the skeleton.
std::string write_asf(const Take& clip);

}  // namespace kinemend
