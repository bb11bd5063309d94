// Keeps a partial line until the rest arrives, and discards lines that are too long.
#include "live/line_splitter.hpp"

#include <algorithm>

#include "io/text/number.hpp"

namespace kinemend {

LineSplitter::Found LineSplitter::next(std::string_view& bytes, bool bars_end_lines,
                                       std::string_view& line) {
  if (is_given_) drop();
  const auto end = std::find_if(bytes.begin(), bytes.end(), [bars_end_lines](char c) {
    return is_line_end(c) || (bars_end_lines && c == '|');
  });
  const std::string_view piece = bytes.substr(0, static_cast<std::size_t>(end - bytes.begin()));
  if (end == bytes.end()) {
    bytes = {};
    add(piece);
    return Found::nothing;
  }
  bytes.remove_prefix(piece.size() + 1);
  if (part_.empty() && !is_too_long_ && piece.size() <= most_bytes_) {
    line = piece;
    return Found::line;
  }
  add(piece);
  return this->end(line);
}

LineSplitter::Found LineSplitter::end(std::string_view& line) {
  if (is_given_) drop();
  if (part_.empty() && !is_too_long_) return Found::nothing;
  is_given_ = true;
  line = part_;
  return is_too_long_ ? Found::too_long : Found::line;
}

void LineSplitter::drop() {
  part_.clear();
  is_too_long_ = is_given_ = false;
}

void LineSplitter::add(std::string_view piece) {
  if (is_too_long_) return;
  is_too_long_ = piece.size() > most_bytes_ - part_.size();
  if (is_too_long_) {
    part_.clear();
  } else {
    part_.append(piece);
  }
}

}  // namespace kinemend
