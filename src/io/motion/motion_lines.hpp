// Finds the line to blame where the values of a file do not come out even.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "io/motion/motion_rows.hpp"

namespace kinemend {

/// A line with a wrong number of values.
struct LineFault {
  const char* place = nullptr;
  std::size_t expected = 0;
  std::size_t found = 0;
};

std::string to_string(const LineFault& fault);

/// Decides which line to blame when values do not come out even. Frames may be wrapped over lines;
/// but where most lines hold exactly a frame, a line that starts amid a frame shows that an earlier
/// one is short or long: that one is the fault. Where most lines hold one other number of values,
/// and there are `declared_frames` lines, the first of them is. No fault when the text can be read
/// as frames that flow over lines.
std::optional<LineFault> find_line_fault(const char* begin, const char* end, CommaStyle commas,
                                         std::size_t channels,
                                         std::optional<std::size_t> declared_frames);

}  // namespace kinemend
