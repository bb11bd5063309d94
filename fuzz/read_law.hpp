#pragma once

#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <variant>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"

/// Any bytes: a take that keeps the rules and is written back to the byte (joints of which some
/// value was no number: with numbers only, which are then written back to the byte), or an error of
/// one line that names the file.
inline int check_read_law(const std::uint8_t* data, std::size_t size, std::string_view format) {
  using namespace kinemend;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  ReadOptions options;
  options.format = format;
  try {
    const TakeResult result = read_take(bytes, "fuzz", options);
    std::visit([](const auto& clip) { clip.validate(); }, result.take);
    const std::string written = write_take(result.take, format);
    const bool may_be_mended = std::holds_alternative<Clip>(result.take) &&
                               result.diagnostics.count("value_not_finite") +
                                       result.diagnostics.count("frame_time_unusable") >
                                   0;
    if (written != bytes && !may_be_mended) std::abort();
    if (written != bytes && write_take(read_take(written, "fuzz", options).take, format) != written)
      std::abort();
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool names_file = message.rfind("fuzz:", 0) == 0;
    if (error.kind() != ErrorKind::unreadable_input || !names_file) std::abort();
    if (message.find_first_of("\r\n") != message.npos) std::abort();
  }
  return 0;
}
