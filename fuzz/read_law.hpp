// The requirements on every reader of takes, for any bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "../tests/io/mended.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "laws.hpp"

/// Any bytes give a valid take that is written back byte for byte, or a one-line error that names
/// the file. A take that the reader repaired may be written with other bytes, which are then
/// written back byte for byte.
inline int check_read_law(const std::uint8_t* data, std::size_t size, std::string_view format) {
  using namespace kinemend;
  const std::string bytes = text_of(data, size);
  ReadOptions options;
  options.format = format;
  try {
    const TakeResult result = read_take(bytes, "fuzz", options);
    result.take.validate();
    const std::string written = write_take(result.take, format);
    check(written == bytes || test::was_mended(result.diagnostics));
    check(written == bytes ||
          write_take(read_take(written, "fuzz", options).take, format) == written);
  } catch (const Error& error) {
    check_refusal(error, {ErrorKind::unreadable_input}, "fuzz:");
  }
  return 0;
}
