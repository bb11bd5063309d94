// Decodes and encodes base64 and percent signs.
#include "io/gltf/gltf_uri.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace kinemend {

namespace {

constexpr std::string_view base64_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
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

std::string base64_of(std::string_view bytes) {
  std::string out((bytes.size() + 2) / 3 * 4, '=');
  char* written = out.data();
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k <= count; ++k) written[k] = base64_digits[bits >> (18 - 6 * k) & 63];
    written += 4;
  }
  return out;
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
