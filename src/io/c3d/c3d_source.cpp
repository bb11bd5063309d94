// Finds and reads the header of a C3D file and the type of its processor, and records a repair with
// its place.
#include "io/c3d/c3d_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/c3d/c3d_layout.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

void C3dSource::note(std::string_view kind, std::size_t offset, std::string_view message,
                     std::size_t count) const {
  if (strict) throw Error(ErrorKind::quality_limit, error_at(offset, message).what());
  for (std::size_t i = 0; i < count; ++i) diagnostics.add(kind, message, offset);
}

namespace {

constexpr std::uint8_t key = 0x50;

bool is_parameter_section(const C3dSource& source, std::size_t offset) {
  return source.holds(offset, 4) && source.byte(offset + 1) == key;
}

std::size_t find_header(const C3dSource& source) {
  const std::size_t begin = source.bytes.find_first_not_of('\0');
  if (source.bytes.empty()) throw source.error_at(0, "the file is empty");
  if (begin == source.bytes.npos || !source.holds(begin, c3d_block_bytes)) {
    throw source.error_at(source.bytes.size(),
                          fmt::format("expected a C3D header of 512 bytes, found the end of the "
                                      "file"));
  }
  if (source.byte(begin + 1) != key) {
    throw source.error_at(begin + 1, fmt::format("expected 80, the mark of a C3D file, found {}",
                                                 source.byte(begin + 1)));
  }
  if (begin > 0) source.note("bytes_before_header", 0, "there are zero bytes before the header");
  return begin;
}

std::size_t find_parameters(const C3dSource& source, std::size_t header_begin) {
  const auto block_begin = [&](std::size_t number) {
    return header_begin + (number - 1) * c3d_block_bytes;
  };
  const std::size_t block = source.byte(header_begin);
  if (block >= 2 && source.holds(block_begin(block), 4)) {
    const std::size_t begin = block_begin(block);
    // Some writers leave the mark out; the processor type then identifies the section.
    const std::uint8_t processor = source.byte(begin + 3);
    if (is_parameter_section(source, begin) || (processor >= 84 && processor <= 86)) return begin;
  }
  if (block != 2 && is_parameter_section(source, block_begin(2))) {
    source.note("damaged_pointer", header_begin,
                "the pointer to the parameters is wrong: they are read from block 2");
    return block_begin(2);
  }
  throw source.error_at(header_begin, fmt::format("block {} does not hold parameters", block));
}

C3dProcessor find_processor(C3dSource& source, const C3dHeader& header) {
  const std::uint8_t number = source.byte(header.parameters_begin + 3);
  if (number >= 84 && number <= 86) return static_cast<C3dProcessor>(number);
  for (const C3dProcessor processor :
       {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::mips}) {
    source.processor = processor;
    if (!is_usable_frame_rate(source.real(header.place_of(11)))) continue;
    source.note("unknown_processor", header.parameters_begin + 3,
                fmt::format("processor type {} is unknown: it is found by the frame rate", number));
    return processor;
  }
  throw source.error_at(
      header.parameters_begin + 3,
      fmt::format("expected processor type 84 (Intel), 85 (DEC) or 86 (MIPS), found {}", number));
}

}  // namespace

C3dHeader read_c3d_header(C3dSource& source) {
  C3dHeader header;
  header.begin = find_header(source);
  header.parameters_begin = find_parameters(source, header.begin);
  source.processor = find_processor(source, header);
  const auto word = [&](std::size_t number) -> std::size_t {
    return source.word(header.place_of(number));
  };
  header.point_count = word(2);
  header.analog_values = word(3);
  header.first_frame = word(4);
  header.last_frame = word(5);
  header.scale = source.real(header.place_of(7));
  header.data_block = word(9);
  header.analog_instants = word(10);
  header.rate_hz = source.real(header.place_of(11));
  return header;
}

C3dParameters read_c3d_parameters(const C3dSource& source, const C3dHeader& header) {
  // The section's block count is one byte, and wrong for larger sections, so the section ends where
  // the data begins.
  const std::size_t data = header.begin + (header.data_block - 1) * c3d_block_bytes;
  const bool data_follows = header.data_block > 1 && data > header.parameters_begin;
  const std::size_t end = std::min(data_follows ? data : source.bytes.size(), source.bytes.size());
  return read_c3d_parameters(source, header.parameters_begin + 4, end);
}

}  // namespace kinemend
