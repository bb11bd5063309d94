// The head of an HTTP/1.1 request: its first line and its headers. Only requests of the program's
// own page are accepted; others are refused before their body is read.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace kinemend::cli {

namespace http {
inline constexpr int bad_request = 400, forbidden = 403, not_found = 404, not_allowed = 405,
                     timed_out = 408, length_required = 411, too_large = 413, wrong_type = 415,
                     head_too_large = 431, wrong_version = 505;
}  // namespace http

struct HttpHead {
  std::string method;  ///< "GET"
  std::string path;    ///< "/TOKEN/run" as sent, without a query
  std::string host;    ///< header Host
  std::string origin;  ///< header Origin; empty if missing
  std::string site;    ///< header Sec-Fetch-Site; empty if missing
  std::string type;    ///< header Content-Type; empty if missing
  std::size_t body_bytes = 0;
  bool keeps_alive = true;  ///< the connection stays open for another request
  bool expects_continue = false;
};

struct ParsedHead {
  int refusal = 0;  ///< status code that refuses the head; 0 if it is accepted
  HttpHead head;
};

/// The length of a request's head including its empty line; npos if it is incomplete.
std::size_t head_bytes(std::string_view received);

/// Parses a head with its empty line. Refuses a malformed first line or header and a repeated
/// header (400), another version (505), a body of unknown length, as `Transfer-Encoding` announces
/// (411), a compressed body (415), and one of more than `most_body_bytes` (413). Never throws.
ParsedHead parse_head(std::string_view bytes, std::size_t most_body_bytes);

}  // namespace kinemend::cli
