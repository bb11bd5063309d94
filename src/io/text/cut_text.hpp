// Finds out whether a text file was cut off, as by a full disk or a broken transfer.
#pragma once

#include <cstddef>
#include <string_view>

#include "io/text/number.hpp"

namespace kinemend {

/// Whether the word can be the start of a number, such as `-`, `1.` or `2.5e-`.
bool may_start_number(std::string_view word);

/// Which lines the last one is compared with.
enum class LikeLines : unsigned char { all, same_first_word };

/// Whether the last number of `rows` may have lost digits: no white space follows it, and it has
/// fewer digits after the point than the last number of each of the lines before it (100 at most, 3
/// at least). Numbers end at white space and at `separator`.
bool last_number_may_be_cut(std::string_view rows, CommaStyle commas, char separator = ' ',
                            LikeLines like = LikeLines::all);

}  // namespace kinemend
