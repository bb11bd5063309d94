// Quotes what files and command lines say for a message, and finds the ends of UTF-8 characters.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace kinemend {

/// The character that a text begins with. A byte that begins none has the size 1 and is not valid.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;
  bool is_valid = false;
};
/// Precondition: the text is not empty.
Character first_character(std::string_view text);

/// Whether a character commands a terminal, ends a line or turns the direction of the text around
/// it.
bool commands_terminal(std::uint32_t code);

/// What a file holds at some place, for a message: in quotes, at most 40 characters of it, with a
/// dot for what is no UTF-8 or would command a terminal; `the end of the file` when it is empty.
std::string quote(std::string_view found);

}  // namespace kinemend
