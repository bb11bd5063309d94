// Reads and writes the chunks of binary glTF, base64 and percent signs.
#include "io/gltf/gltf_container.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/bytes.hpp"
#include "io/gltf/gltf_json.hpp"
#include "io/text/text.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

// glTF 2.0 specification, section 4.4: a header of three numbers, then chunks of length, type and
// content.
constexpr std::size_t glb_header_bytes = 12, glb_chunk_header_bytes = 8;
constexpr std::string_view glb_magic = "glTF", glb_json = "JSON", glb_bin{"BIN\0", 4};

std::uint32_t glb_number(std::string_view bytes, std::size_t at) {
  return read_word<std::uint32_t>(bytes.data() + at, false);
}

void append_glb_number(std::string& out, std::size_t value) {
  if (value > 0xFFFFFFFFu)
    throw Error(ErrorKind::usage, "the take is too long for a glb file of 4 GiB");
  append_word(out, static_cast<std::uint32_t>(value), false);
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
    note_repair(name, strict, diagnostics, "bytes_after_end",
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
  const auto chunk_bytes = [](std::string_view content) {
    return glb_chunk_header_bytes + (content.size() + 3) / 4 * 4;
  };
  const std::size_t total =
      glb_header_bytes + chunk_bytes(json) + (binary.empty() ? 0 : chunk_bytes(binary));
  std::string out(glb_magic);
  append_glb_number(out, 2);
  append_glb_number(out, total);
  out.reserve(total);
  append_glb_chunk(out, glb_json, json, ' ');
  if (!binary.empty()) append_glb_chunk(out, glb_bin, binary, '\0');
  return out;
}

namespace {

constexpr std::uint8_t no_base64_digit = 0xFF;

constexpr std::array<std::uint8_t, 256> base64_values() {
  std::array<std::uint8_t, 256> values{};
  values.fill(no_base64_digit);
  for (std::size_t i = 0; i < base64_digits.size(); ++i)
    values[static_cast<unsigned char>(base64_digits[i])] = static_cast<std::uint8_t>(i);
  values['-'] = 62;  // the URL alphabet, RFC 4648 section 5
  values['_'] = 63;
  return values;
}

bool decode_base64(std::string_view text, std::string& out) {
  constexpr auto values = base64_values();
  while (text.ends_with('=')) text.remove_suffix(1);
  if (text.size() % 4 == 1) return false;
  out.resize(text.size() * 3 / 4);
  std::size_t written = 0;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::uint32_t bits = 0, bad = 0;
    const std::size_t digits = std::min<std::size_t>(4, text.size() - i);
    for (std::size_t k = 0; k < 4; ++k) {
      const std::uint8_t value = k < digits ? values[static_cast<unsigned char>(text[i + k])] : 0;
      bad |= value & 0xC0u;
      bits = bits << 6 | value;
    }
    if (bad != 0) return false;
    for (std::size_t k = 0; k + 1 < digits; ++k)
      out[written++] = static_cast<char>(bits >> (16 - 8 * k) & 0xFF);
  }
  return true;
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::optional<std::string> percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = hex_digit(text[i + 1]), low = hex_digit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    out += static_cast<char>(16 * high + low);
    i += 2;
  }
  return out;
}

bool is_inside_folder(std::string_view path) {
  if (path.empty() || path.front() == '/') return false;
  for (const char c : path) {
    if (c == '\\' || c == ':' || static_cast<unsigned char>(c) < 0x20) return false;
  }
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    if (path.substr(begin, end - begin) == "..") return false;
    begin = end + 1;
  }
  return true;
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

std::optional<std::string> bytes_of_data_uri(std::string_view uri) {
  constexpr std::string_view mark = ";base64,";
  const std::size_t comma = uri.find(',');
  if (comma == uri.npos || !uri.substr(0, comma + 1).ends_with(mark)) return std::nullopt;
  std::string bytes;
  if (!decode_base64(uri.substr(comma + 1), bytes)) return std::nullopt;
  return bytes;
}

std::optional<std::string> relative_path_of_uri(std::string_view uri) {
  // A colon before any slash makes it a scheme; an encoded colon is refused like a drive.
  auto path = percent_decoded(uri);
  if (!path || !is_inside_folder(*path)) return std::nullopt;
  return path;
}

std::string uri_of_file_name(std::string_view name) {
  constexpr std::string_view kept = "-._~", digits = "0123456789ABCDEF";
  std::string out;
  for (const char c : name) {
    const bool is_plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                          (c >= 'A' && c <= 'Z') || kept.find(c) != kept.npos;
    const auto byte = static_cast<unsigned char>(c);
    if (is_plain) {
      out += c;
    } else {
      out += {'%', digits[byte >> 4], digits[byte & 15]};
    }
  }
  return out;
}

}  // namespace kinemend
