// Decides which requests `view` answers: only those of its own page at the printed address.
#pragma once

#include <string>
#include <string_view>

namespace kinemend::cli {

/// The parts of a request's head used for the decision.
struct ViewRequest {
  std::string method;  ///< "GET", "POST"
  std::string path;    ///< "/TOKEN/run", without a query
  std::string host;    ///< header Host
  std::string origin;  ///< header Origin; empty if missing
  std::string site;    ///< header Sec-Fetch-Site; empty if missing
  std::string type;    ///< header Content-Type
};

class ViewAccess {
 public:
  /// `token` must be part of the path; `port` is that of the server on 127.0.0.1.
  ViewAccess(std::string token, int port) : token_(std::move(token)), port_(port) {}

  /// 0 for an accepted request, else the status that refuses it: 403 for another host or origin and
  /// for a missing token, 415 for a body other than JSON.
  int refusal(const ViewRequest& request) const;
  /// The action of the path: "" for the page, "run"; null data for a path without the token.
  std::string_view action(std::string_view path) const;
  std::string address() const;

 private:
  std::string token_;
  int port_;
};

/// 32 hexadecimal digits from the system's generator.
std::string random_token();

}  // namespace kinemend::cli
