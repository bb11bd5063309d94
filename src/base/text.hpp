// Quotes text of files and command lines for messages, finds the ends of UTF-8 characters, and
// formats measured values with units.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinemend {

/// The character at the start of a text. A byte that starts no character has size 1 and is not
/// valid.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;
  bool is_valid = false;
};
/// Precondition: the text is not empty.
Character first_character(std::string_view text);

/// Whether a character controls a terminal, ends a line or changes the direction of the text around
/// it.
bool commands_terminal(std::uint32_t code);

/// Text of a file for a message: in quotes, at most 40 characters of it, with a dot for invalid
/// UTF-8 and control characters; `the end of the file` when it is empty.
std::string quote(std::string_view found);

/// The unit in which noise, changes and errors are shown: in metres they would begin with zeros.
struct ShownUnit {
  double factor = 1;  ///< from the unit of the measurement
  std::string name;   ///< "mm" for "m"; other units are kept, "units" for a length without one
};
ShownUnit shown_unit(std::string_view unit);

/// Returns "6.95 mm" for 0.00695 m, "1.78 m", "1.50 deg", "12.5 units".
std::string measure_text(double value, std::string_view unit);

}  // namespace kinemend
