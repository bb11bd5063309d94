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
  std::string_view skeleton_file;  ///< path of a line `#!OML:ASF path`; else empty
  std::optional<bool> radians;
  bool three_dofs = false;     ///< every bone has rx ry rz, whatever the skeleton says
  std::size_t data_begin = 0;  ///< offset of the number of the first frame
};

/// The line of a bone within a frame.
struct AmcBone {
  static constexpr std::size_t no_column = std::numeric_limits<std::size_t>::max();

  std::string name;  ///< as the AMC spells it
  std::size_t joint = 0;
  /// The column of `MotionColumns` for each value; `no_column` for a value without effect.
  std::vector<std::size_t> columns;
};

/// The lines of every frame, in the order of the first frame.
using AmcLayout = std::vector<AmcBone>;

/// Reads the head of an AMC file. Errors: `unreadable_input` with the line.
AmcHeader read_amc_header(const SourceText& text, Diagnostics& diagnostics);
/// Finds the bones of the first frame in the skeleton. If the take has three values per bone, the
/// skeleton gets three degrees of freedom per bone. Errors: `unreadable_input`, naming the bone
/// that does not fit.
AmcLayout read_amc_layout(const SourceText& text, Diagnostics& diagnostics, const AmcHeader& header,
                          AsfSkeleton& asf, std::string_view asf_name);
/// Returns the lines of the joints that have degrees of freedom, in the order of the skeleton.
AmcLayout make_amc_layout(const AsfSkeleton& asf);

}  // namespace kinemend
