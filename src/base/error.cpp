// Builds the messages of errors, with the place in the file, and collects repairs, counting those
// that repeat.
#include <fmt/format.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"

namespace kinemend {

Error::Error(ErrorKind kind, const std::string& message)
    : std::runtime_error(printable(message)), kind_(kind) {}

Error Error::at_line(std::string_view source, std::size_t line, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}:{}: {}", source, line, message)};
}

Error Error::at_byte(std::string_view source, std::size_t offset, std::string_view message) {
  return {ErrorKind::unreadable_input, fmt::format("{}: byte {}: {}", source, offset, message)};
}

namespace {

auto find_entry(auto& entries, std::string_view name) {
  return std::find_if(entries.begin(), entries.end(),
                      [&](const Diagnostic& d) { return d.name == name; });
}

}  // namespace

void Diagnostics::add(std::string_view name, std::string_view message, std::size_t line) {
  const auto known = find_entry(entries_, name);
  if (known != entries_.end()) {
    ++known->count;
  } else {
    entries_.push_back({std::string(name), printable(message), line, 1});
  }
}

std::size_t Diagnostics::count(std::string_view name) const noexcept {
  const auto known = find_entry(entries_, name);
  return known == entries_.end() ? 0 : known->count;
}

}  // namespace kinemend
