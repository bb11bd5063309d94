// Reads a head line by line and rejects everything that two parsers could interpret differently.
#include "http_head.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "kinemend/extend/text.hpp"

namespace kinemend::cli {

namespace {

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    return is_letter || (c >= '0' && c <= '9') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

// Control characters could end a line for one reader and not for another.
bool is_line_of_text(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return c == '\t' || (byte >= 0x20 && byte != 0x7F);
  });
}

std::string_view without_blanks(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Removes the first line from `text` and returns it without its line end.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

class HeadReader {
 public:
  explicit HeadReader(std::size_t most_body_bytes) : most_body_bytes_(most_body_bytes) {}

  ParsedHead read(std::string_view bytes) {
    read_first_line(take_line(bytes));
    while (parsed_.refusal == 0) {
      const std::string_view line = take_line(bytes);
      if (line.empty()) break;
      read_header(line);
    }
    return std::move(parsed_);
  }

 private:
  void refuse(int status) {
    if (parsed_.refusal == 0) parsed_.refusal = status;
  }

  void read_first_line(std::string_view line) {
    const std::size_t first = line.find(' '), last = line.rfind(' ');
    if (first == line.npos || first == last || !is_line_of_text(line))
      return refuse(http::bad_request);
    const std::string_view target = line.substr(first + 1, last - first - 1);
    const std::string_view version = line.substr(last + 1);
    if (!is_token(line.substr(0, first)) || !target.starts_with('/') ||
        target.find(' ') != target.npos)
      return refuse(http::bad_request);
    if (version != "HTTP/1.1" && version != "HTTP/1.0")
      return refuse(version.starts_with("HTTP/") ? http::wrong_version : http::bad_request);
    parsed_.head.method = line.substr(0, first);
    parsed_.head.path = target.substr(0, target.find('?'));
    parsed_.head.keeps_alive = version == "HTTP/1.1";
  }

  void read_header(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == line.npos || !is_token(line.substr(0, colon)) || !is_line_of_text(line))
      return refuse(http::bad_request);
    const std::string name = lower_case(line.substr(0, colon));
    const std::string_view value = without_blanks(line.substr(colon + 1));
    HttpHead& head = parsed_.head;
    if (name == "host") return put(host_, head.host, value);
    if (name == "origin") return put(origin_, head.origin, value);
    if (name == "sec-fetch-site") return put(site_, head.site, value);
    if (name == "content-type") return put(type_, head.type, value);
    if (name == "content-length") return read_length(value);
    if (name == "transfer-encoding") return refuse(http::length_required);
    if (name == "content-encoding" && lower_case(value) != "identity")
      return refuse(http::wrong_type);
    if (name == "connection") read_connection(lower_case(value));
    if (name == "expect" && lower_case(value) == "100-continue") head.expects_continue = true;
  }

  // Two headers of one name could be read differently elsewhere, so they are refused.
  void put(bool& is_given, std::string& place, std::string_view value) {
    if (is_given) return refuse(http::bad_request);
    is_given = true;
    place = value;
  }

  void read_length(std::string_view value) {
    const char* end = value.data() + value.size();
    const bool is_number = !value.empty() && value.find_first_not_of("0123456789") == value.npos;
    if (!is_number || length_) return refuse(http::bad_request);
    std::size_t length = 0;
    const auto [read, error] = std::from_chars(value.data(), end, length);
    if (error != std::errc() || read != end || length > most_body_bytes_)
      return refuse(http::too_large);
    length_ = length;
    parsed_.head.body_bytes = length;
  }

  void read_connection(std::string_view value) {
    if (value == "close") parsed_.head.keeps_alive = false;
    if (value == "keep-alive") parsed_.head.keeps_alive = true;
  }

  std::size_t most_body_bytes_;
  ParsedHead parsed_;
  std::optional<std::size_t> length_;
  bool host_ = false, origin_ = false, site_ = false, type_ = false;
};

}  // namespace

std::size_t head_bytes(std::string_view received) {
  // Lines may end with \n alone, so the first form of an empty line ends the head.
  const std::size_t full = received.find("\r\n\r\n"), bare = received.find("\n\n");
  if (full == received.npos && bare == received.npos) return received.npos;
  return full < bare ? full + 4 : bare + 2;
}

ParsedHead parse_head(std::string_view bytes, std::size_t most_body_bytes) {
  return HeadReader(most_body_bytes).read(bytes);
}

}  // namespace kinemend::cli
