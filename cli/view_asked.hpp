// Reads from the bytes of a request what the page of `view` asks for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kinemend::cli {

struct AskedFlag {
  std::string name;  ///< as the page calls it: "cutoff_hz"
  std::variant<bool, std::string> value;
};

/// One request. Members that the page does not send are ignored.
struct ViewAsked {
  std::string tab;       ///< what the tab calls itself, cut at 64 bytes
  bool is_fill = false;  ///< `fill` instead of `clean`
  std::vector<AskedFlag> flags;
  std::optional<std::string> contacts, plan, gaps;  ///< side files as they are in the page
  bool preview = false;                             ///< try every method on every gap
  std::size_t row = 0;                              ///< of the gap plan, for curves
  std::string file;      ///< where to save: a name without a folder; empty: the default
  bool replace = false;  ///< the person has confirmed that existing files are replaced
};

/// Parses the body of a request. Needs nothing but the bytes, and never reads or writes a file.
/// Errors: `Error` of the kind `usage` for what is not JSON, is nested more than `deepest_json`
/// levels deep, or has a member of another type.
ViewAsked parse_view_asked(std::string_view body);

}  // namespace kinemend::cli
