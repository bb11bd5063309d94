// The head of an HTTP/1.1 request: its first line and its headers. Only what a page of the program
// sends is accepted: everything else is refused before a byte of the body is read.
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
  std::string path;    ///< "/TOKEN/run", without a query, as it was sent
  std::string host;    ///< header Host
  std::string origin;  ///< header Origin; empty if missing
  std::string site;    ///< header Sec-Fetch-Site; empty if missing
  std::string type;    ///< header Content-Type; empty if missing
  std::size_t body_bytes = 0;
  bool keeps_alive = true;  ///< the connection stays open for another request
  bool expects_continue = false;
};

struct ParsedHead {
  int refusal = 0;  ///< the status that answers a head which is not accepted; else 0
  HttpHead head;
};

/// The bytes from the start of a request to the empty line that ends its head; npos: not yet there.
std::size_t head_bytes(std::string_view received);

/// `bytes`: a head with its empty line. Refused are: a first line or a header of another form, two
/// of a header that is read (400), another version (505), a body of unknown length, as
/// `Transfer-Encoding` announces (411), one that is compressed (415), and one of more than
/// `most_body_bytes` (413). Never throws.
ParsedHead parse_head(std::string_view bytes, std::size_t most_body_bytes);

}  // namespace kinemend::cli
