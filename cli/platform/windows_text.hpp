// Converts texts to and from the encoding of Windows functions.
#pragma once

#include <string>

namespace kinemend::cli::platform {

std::string utf8_of(const wchar_t* text);
std::wstring wide_of(const std::string& text);

}  // namespace kinemend::cli::platform
