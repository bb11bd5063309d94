// Checks the settings of `clean` and finds which joints or markers they select.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/clean.hpp"

namespace kinemend {

/// Errors: `ErrorKind::usage` for a number or range that is out of range.
void check_settings(const CleanSettings& settings, std::size_t frames);

/// What the settings select: of joints the root position with joint 0, where it has channels; of
/// markers those that are positions. Errors: `ErrorKind::usage` for a pattern that matches nothing.
Selection selection_of(const Take& clip, const CleanSettings& settings);

/// 1 for each of `names` that `settings.joints` means and `settings.exclude` does not. `kind`
/// ("joint", "marker") stands in messages. Errors: `ErrorKind::usage` for a pattern that matches
/// nothing.
std::vector<std::uint8_t> select_names(const std::vector<std::string>& names,
                                       const CleanSettings& settings, std::string_view kind);

}  // namespace kinemend
