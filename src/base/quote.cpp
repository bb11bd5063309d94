// Shortens quoted text, and replaces characters that must not reach a terminal.
#include "base/quote.hpp"

namespace kinemend {

std::string quote(std::string_view found) {
  // Characters; chosen by hand.
  constexpr std::size_t longest = 40;
  if (found.empty()) return "the end of the file";
  std::string text = "\"";
  for (std::size_t count = 0; !found.empty(); ++count) {
    if (count == longest) return text + "...\"";
    const Character character = first_character(found);
    if (character.is_valid && !commands_terminal(character.code)) {
      text += found.substr(0, character.size);
    } else {
      text += '.';
    }
    found.remove_prefix(character.size);
  }
  return text + "\"";
}

}  // namespace kinemend
