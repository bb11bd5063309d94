#include "base/quote.hpp"

namespace kinemend {

std::string quote(std::string_view found) {
  constexpr std::size_t longest = 40;
  if (found.empty()) return "the end of the file";
  std::string text = "\"";
  for (const char c : found.substr(0, longest)) text += c >= ' ' && c <= '~' ? c : '.';
  return text + (found.size() > longest ? "...\"" : "\"");
}

}  // namespace kinemend
