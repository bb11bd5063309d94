// The exception that all functions of the library throw, and the repairs that its readers make.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// The kind of an error; its value is the exit code of a program.
enum class ErrorKind {
  quality_limit = 1,     ///< a quality limit was exceeded, or a repair was needed under `strict`
  usage = 2,             ///< an option, name or argument that makes no sense
  unreadable_input = 3,  ///< a file that cannot be opened or violates its format
  cannot_write = 4,  ///< an output that cannot be written, or that exists and may not be replaced
};

/// The one exception of the library. `what()` is a whole line for the user:
/// `walk.bvh:212: expected 63 channel values, found 62`. Text quoted from files and command lines
/// is escaped and bounded (`printable`), so that the line can be shown on a terminal, in a log or
/// on a page.
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

/// One kind of repair made to odd but usable input. Repeated ones are counted, not listed.
struct Diagnostic {
  std::string name;     ///< stable, for programs: `frame_count_mismatch`
  std::string message;  ///< for people, of the first occurrence
  /// Line (from 1) or byte offset of the first occurrence; 0: unknown.
  std::size_t first_line = 0;
  std::size_t count = 0;
};

/// The repairs that a reader made, in order of first occurrence.
class Diagnostics {
 public:
  /// Escapes and bounds the message as `Error` does.
  void add(std::string_view name, std::string_view message, std::size_t line = 0);

  const std::vector<Diagnostic>& entries() const noexcept { return entries_; }
  bool empty() const noexcept { return entries_.empty(); }
  /// Number of occurrences of the repair called `name`.
  std::size_t count(std::string_view name) const noexcept;

 private:
  std::vector<Diagnostic> entries_;
};

}  // namespace kinemend
