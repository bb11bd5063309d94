// Builds the messages of errors, with the place in the file.
#include "kinemend/error.hpp"

#include <fmt/format.h>

#include "kinemend/experimental/text.hpp"

namespace kinemend {

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(printable(message)), kind_(kind) {}

Error Error::at_line(std::string_view source, std::size_t line, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}:{}: {}", source, line, message)};
}

Error Error::at_byte(std::string_view source, std::size_t offset, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}: byte {}: {}", source, offset, message)};
}

}  // namespace kinemend
