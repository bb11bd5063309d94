// Checks host, origin, token and content type of a request, and generates tokens.
#include "view_access.hpp"

#include <fmt/format.h>

#include <random>

namespace kinemend::cli {

namespace {

// Takes the same time wherever the texts differ, so that it reveals nothing of the token.
bool are_equal(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  return difference == 0;
}

}  // namespace

int ViewAccess::refusal(const ViewRequest& request) const {
  constexpr int forbidden = 403, wrong_type = 415;
  // Another page may use a host name that resolves to this machine, so only the number is accepted.
  if (request.host != fmt::format("127.0.0.1:{}", port_)) return forbidden;
  if (!request.origin.empty() && request.origin != fmt::format("http://127.0.0.1:{}", port_))
    return forbidden;
  if (!request.site.empty() && request.site != "same-origin" && request.site != "none")
    return forbidden;
  if (action(request.path).data() == nullptr) return forbidden;
  // A form of another page cannot send this type unless the browser asks first.
  if (request.method == "POST" && request.type != "application/json") return wrong_type;
  return 0;
}

std::string_view ViewAccess::action(std::string_view path) const {
  if (path.size() < token_.size() + 2 || path.front() != '/') return {};
  if (!are_equal(path.substr(1, token_.size()), token_) || path[token_.size() + 1] != '/')
    return {};
  return path.substr(token_.size() + 2);
}

std::string ViewAccess::address() const {
  return fmt::format("http://127.0.0.1:{}/{}/", port_, token_);
}

std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device() & 0xFFFFFFFFU);
  return token;
}

}  // namespace kinemend::cli
