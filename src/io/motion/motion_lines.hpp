// Finds the faulty line if the values of a file do not form whole frames.
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

/// Finds the faulty line if values do not form whole frames. Frames may be wrapped over lines. If
/// most lines hold exactly one frame, a line that starts inside a frame shows that an earlier line
/// is short or long: that line is the fault. If most lines hold another number of values, and there
/// are `declared_frames` lines, the first of them is the fault. Empty if the text can be read as
/// frames wrapped over lines.
std::optional<LineFault> find_line_fault(const char* begin, const char* end, CommaStyle commas,
                                         std::size_t channels,
                                         std::optional<std::size_t> declared_frames);

}  // namespace kinemend
