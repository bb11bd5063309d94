// The exception that all functions of the library throw.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>

namespace kinemend {

/// What went wrong, as a program's exit code sees it.
enum class ErrorKind {
  quality_limit = 1,     ///< a quality limit was passed, or a repair was needed under `strict`
  usage = 2,             ///< an option, name or argument that makes no sense
  unreadable_input = 3,  ///< a file that cannot be opened or does not hold what its format demands
  cannot_write = 4,      ///< an output that cannot be made, or that exists and may not be replaced
};

/// The one exception of the library. `what()` is a whole line for the user:
/// `walk.bvh:212: expected 63 channel values, found 62`. What it quotes from files and command
/// lines is escaped and bounded (`printable`), so that it can go to a terminal, a log or a page.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message);

  ErrorKind kind() const noexcept { return kind_; }

  /// `source:line: message`, for text formats; `line` counts from 1.
  static Error at_line(std::string_view source, std::size_t line, std::string_view message);
  /// `source: byte N: message`, for binary formats.
  static Error at_byte(std::string_view source, std::size_t offset, std::string_view message);

 private:
  ErrorKind kind_;
};

}  // namespace kinemend
