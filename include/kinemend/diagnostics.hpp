// The repairs that a reader makes to odd but usable input.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend {

/// One kind of repair made to odd but usable input. Repeated ones are counted, not listed.
struct Diagnostic {
  std::string name;     ///< stable, for programs: `frame_count_mismatch`
  std::string message;  ///< for people, of the first occurrence
  std::size_t first_line =
      0;  ///< line (from 1) or byte offset of the first occurrence; 0 is unknown
  std::size_t count = 0;
};

/// What a reader repaired, in order of first occurrence.
class Diagnostics {
 public:
  /// The message is escaped and bounded as that of an `Error` is.
  void add(std::string_view name, std::string_view message, std::size_t line = 0);

  const std::vector<Diagnostic>& entries() const noexcept { return entries_; }
  bool empty() const noexcept { return entries_.empty(); }
  /// Occurrences of the repair called `name`; 0 when there was none.
  std::size_t count(std::string_view name) const noexcept;

 private:
  std::vector<Diagnostic> entries_;
};

}  // namespace kinemend
