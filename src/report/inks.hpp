// Colours and letters of all drawings.
#pragma once

#include <string_view>

namespace kinemend::inks {

inline constexpr std::string_view before = "#d9480f", after = "#0b7285", difference = "#5f3dc4";
inline constexpr std::string_view text = "#343a40", quiet = "#868e96", grid = "#e9ecef";
inline constexpr std::string_view font =
    "font-size=\"13\" font-family=\"system-ui,-apple-system,Segoe "
    "UI,Helvetica,Arial,sans-serif\"";

}  // namespace kinemend::inks
