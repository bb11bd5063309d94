// Checks shared by all fuzz targets: a requirement holds, and a refusal is one line that names the
// file.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <string_view>

#include "kinemend/error.hpp"

/// Ends the program if a requirement is violated, so that libFuzzer keeps the input.
inline void check(bool holds) {
  if (!holds) std::abort();
}

inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A refusal must have one of these kinds, name the file, and be one printable line.
inline void check_refusal(const kinemend::Error& error,
                          std::initializer_list<kinemend::ErrorKind> kinds,
                          std::string_view begins = "fuzz") {
  const std::string message = error.what();
  bool is_known = false;
  for (const kinemend::ErrorKind kind : kinds) is_known = is_known || error.kind() == kind;
  check(is_known && message.starts_with(begins) && message.size() < 4096);
  for (const char c : message) check(static_cast<unsigned char>(c) >= 0x20 && c != 0x7F);
}
