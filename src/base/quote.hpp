// Quotes text of files and command lines for messages, and finds the ends of UTF-8 characters.
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

}  // namespace kinemend
