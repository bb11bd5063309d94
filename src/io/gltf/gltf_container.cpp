// Reads and writes the chunks of binary glTF.
#include "io/gltf/gltf_container.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "io/gltf/gltf_json_spans.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// glTF 2.0 specification, section 4.4: a header of three numbers, then chunks of length, type and
// content.
constexpr std::size_t glb_header_bytes = 12, glb_chunk_header_bytes = 8;
constexpr std::string_view glb_magic = "glTF", glb_json = "JSON", glb_bin{"BIN\0", 4};

std::uint32_t glb_number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

void append_glb_number(std::string& out, std::size_t value) {
  if (value > 0xFFFFFFFFu)
    throw Error(ErrorKind::usage, "the take is too long for a glb file of 4 GiB");
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xFF);
}

void append_glb_chunk(std::string& out, std::string_view type, std::string_view content,
                      char filler) {
  const std::size_t padding = (4 - content.size() % 4) % 4;
  append_glb_number(out, content.size() + padding);
  out.append(type);
  out.append(content);
  out.append(padding, filler);
}

// Returns the content of the chunk at `at`.
ByteSpan glb_chunk(const GltfFile& file, std::size_t at, std::size_t end) {
  if (end - at < glb_chunk_header_bytes)
    throw Error::at_byte(file.name, at, "the file ends in the header of a chunk");
  const std::size_t size = glb_number(file.bytes, at), begin = at + glb_chunk_header_bytes;
  if (size > end - begin) {
    throw Error::at_byte(file.name, at,
                         fmt::format("a chunk of {} bytes, but {} are left", size, end - begin));
  }
  return {begin, size};
}

std::size_t stated_glb_end(const GltfFile& file) {
  if (file.bytes.size() < glb_header_bytes)
    throw Error::at_byte(file.name, file.bytes.size(), "the file ends in its header");
  if (const std::uint32_t version = glb_number(file.bytes, 4); version != 2) {
    throw Error::at_byte(file.name, 4, fmt::format("glTF of version {}: only 2 is read", version));
  }
  const std::size_t end = glb_number(file.bytes, 8);
  if (end < glb_header_bytes || end > file.bytes.size()) {
    throw Error::at_byte(
        file.name, 8,
        fmt::format("the header states {} bytes, the file has {}", end, file.bytes.size()));
  }
  return end;
}

void find_glb_chunks(GltfFile& file, std::size_t end) {
  file.json = glb_chunk(file, glb_header_bytes, end);
  if (std::string_view(file.bytes).substr(glb_header_bytes + 4, 4) != glb_json)
    throw Error::at_byte(file.name, glb_header_bytes + 4, "the first chunk is not JSON");
  const std::size_t second = file.json.begin + file.json.size;
  if (second >= end) return;
  const ByteSpan chunk = glb_chunk(file, second, end);
  if (std::string_view(file.bytes).substr(second + 4, 4) == glb_bin) file.binary = chunk;
}

}  // namespace

void note_gltf_repair(std::string_view file, bool strict, Diagnostics& diagnostics,
                      std::string_view kind, std::string_view message) {
  if (strict) throw Error(ErrorKind::quality_limit, fmt::format("{}: {}", file, message));
  diagnostics.add(kind, message);
}

GltfFile open_gltf(std::string bytes, std::string_view name, bool strict,
                   Diagnostics& diagnostics) {
  GltfFile file;
  file.name = name;
  file.bytes = std::move(bytes);
  file.is_binary = std::string_view(file.bytes).starts_with(glb_magic);
  if (!file.is_binary) {
    file.json = {0, file.bytes.size()};
    return file;
  }
  const std::size_t end = stated_glb_end(file);
  find_glb_chunks(file, end);
  if (end < file.bytes.size()) {
    note_gltf_repair(name, strict, diagnostics, "bytes_after_end",
                     fmt::format("{} bytes after the end that the header states: kept",
                                 file.bytes.size() - end));
  }
  return file;
}

Error gltf_error(const GltfFile& file, const char* section, std::size_t index,
                 std::string_view message) {
  const auto place = json_element(file.json_text(), section, index);
  return Error::at_byte(file.name, file.json.begin + (place ? place->begin : 0),
                        fmt::format("{}[{}]: {}", section, index, message));
}

std::string reassembled_gltf(const GltfFile& file, std::string json, const std::string* binary) {
  if (!file.is_binary) return json;
  const std::string_view bytes = file.bytes;
  const std::size_t end = glb_number(bytes, 8);
  const ByteSpan last = file.binary.value_or(file.json);
  const std::string_view rest = bytes.substr(last.begin + last.size);
  std::string chunks;
  chunks.reserve(bytes.size() + json.size() + (binary == nullptr ? 0 : binary->size()));
  append_glb_chunk(chunks, glb_json, json, ' ');
  if (file.binary) {
    append_glb_chunk(
        chunks, glb_bin,
        binary != nullptr ? *binary : bytes.substr(file.binary->begin, file.binary->size), '\0');
  }
  const std::size_t counted = rest.size() - (bytes.size() - end);
  std::string out(glb_magic);
  append_glb_number(out, 2);
  append_glb_number(out, glb_header_bytes + chunks.size() + counted);
  return out.append(chunks).append(rest);
}

std::string new_glb(std::string_view json, std::string_view binary) {
  std::string chunks;
  append_glb_chunk(chunks, glb_json, json, ' ');
  if (!binary.empty()) append_glb_chunk(chunks, glb_bin, binary, '\0');
  std::string out(glb_magic);
  append_glb_number(out, 2);
  append_glb_number(out, glb_header_bytes + chunks.size());
  return out.append(chunks);
}

}  // namespace kinemend
