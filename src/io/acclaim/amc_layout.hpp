// The head of an AMC file, and which line of a frame belongs to which bone.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/acclaim/asf.hpp"
#include "io/text/text.hpp"

namespace kinemend {

/// The part of a file before the first frame.
struct AmcHeader {
  std::string_view skeleton_file;  ///< of a line `#!OML:ASF path`; empty where there is none
  std::optional<bool> radians;
  bool three_dofs = false;     ///< every bone has rx ry rz, whatever the skeleton says
  std::size_t data_begin = 0;  ///< the number of the first frame
};

/// The line of a bone within a frame.
struct AmcBone {
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

  std::string name;  ///< as the AMC spells it
  std::size_t joint = 0;
  /// The column of `MotionColumns` that each value belongs to; `no_column` for what has no effect.
  std::vector<std::size_t> columns;
};

/// The lines of every frame, in the order of the first one.
using AmcLayout = std::vector<AmcBone>;

/// Errors: `unreadable_input` with the line.
AmcHeader read_amc_header(const SourceText& text, Diagnostics& diagnostics);
/// Finds the bones of the first frame in the skeleton, whose degrees of freedom become three a bone
/// where the take has that many. Errors: `unreadable_input`, naming the bone that does not fit.
AmcLayout read_amc_layout(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                          AsfSkeleton& asf, std::string_view asf_name);
/// The lines of joints in the given order, for those that have degrees of freedom.
AmcLayout make_amc_layout(const AsfSkeleton& asf);

}  // namespace kinemend
