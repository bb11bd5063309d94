#pragma once

#include <string>
#include <string_view>

namespace kinemend::cli {

/// 128 bits of XXH3 as 32 hexadecimal digits: the same on every machine.
std::string content_hash(std::string_view bytes);

}  // namespace kinemend::cli
