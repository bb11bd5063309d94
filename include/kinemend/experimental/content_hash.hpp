// A hash that shows whether bytes have changed.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kinemend {

/// Returns 128 bits of XXH3 as 32 hexadecimal digits, the same on every machine. It does not
/// protect against deliberate collisions.
std::string content_hash(std::string_view bytes);

inline constexpr std::size_t content_hash_digits = 32;

}  // namespace kinemend
