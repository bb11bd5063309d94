// Characters of UTF-8, one at a time, for text that may hold anything.
#pragma once

#include <cstddef>
#include <cstdint>
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

}  // namespace kinemend
