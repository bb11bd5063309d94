// Parses requests of the `view` page.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace kinemend::cli {

struct AskedFlag {
  std::string name;  ///< name in the page: "cutoff_hz"
  std::variant<bool, std::string> value;
};

/// One request. Members that the page does not send are ignored.
struct ViewAsked {
  std::string tab;       ///< the tab's own name, cut at 64 bytes
  bool is_fill = false;  ///< `fill` instead of `clean`
  std::vector<AskedFlag> flags;
  std::optional<std::string> contacts, plan, gaps;  ///< side files as edited in the page
  bool preview = false;                             ///< try every method on every gap
  std::size_t row = 0;                              ///< row of the gap plan, for curves
  std::string file;      ///< name to save under, without a folder; empty: the default
  bool replace = false;  ///< the user has confirmed that existing files are replaced
};

/// Parses the body of a request; never reads or writes a file. Errors: `Error` of the kind `usage`
/// for text that is not JSON, is nested more than `deepest_json` levels deep, or has a member of a
/// wrong type.
ViewAsked parse_view_asked(std::string_view body);

}  // namespace kinemend::cli
