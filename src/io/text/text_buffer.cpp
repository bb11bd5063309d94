// Appends numbers to a text, and rejects numbers that are not finite.
#include "io/text/text_buffer.hpp"

#include <algorithm>
#include <cmath>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// Outputs never contain NaN or infinity.
void check_finite(double value) {
  if (!std::isfinite(value)) throw Error(ErrorKind::usage, "a value to write is not finite");
}

}  // namespace

void TextBuffer::append_fixed(double value, unsigned decimals, CommaStyle commas) {
  check_finite(value);
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_fixed(begin, value, decimals);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

void TextBuffer::append_shortest(double value, CommaStyle commas) {
  check_finite(value);
  make_room(fixed_number_room);
  char* const begin = text_.data() + used_;
  char* const end = write_shortest(begin, value);
  if (commas == CommaStyle::decimal) std::replace(begin, end, '.', ',');
  used_ += static_cast<std::size_t>(end - begin);
}

}  // namespace kinemend
