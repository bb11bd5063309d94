#include "io/text_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend {

void TextBuffer::append_fixed(double value, unsigned decimals, CommaStyle commas) {
  if (!std::isfinite(value))
    throw Error(ErrorKind::usage, "a channel value to write is not finite");
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_fixed(begin, value, decimals);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

void TextBuffer::append_shortest(double value, CommaStyle commas) {
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_shortest(begin, value);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

}  // namespace kinemend
