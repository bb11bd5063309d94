#include "kinemend/error.hpp"

#include <fmt/format.h>

namespace kinemend {

Error Error::at_line(std::string_view source, std::size_t line, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}:{}: {}", source, line, message)};
}

Error Error::at_byte(std::string_view source, std::size_t offset, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}: byte {}: {}", source, offset, message)};
}

}  // namespace kinemend
