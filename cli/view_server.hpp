// The server of `view`: it checks access and decides when to end; the caller answers.
#pragma once

#include <functional>
#include <string>

#include "http_server.hpp"
#include "view_access.hpp"

namespace kinemend::cli {

/// Answers requests that `ViewAccess` accepts. Called from several threads.
using Answer = std::function<HttpReply(const std::string& method, std::string_view action,
                                       const std::string& body)>;

/// Serves until the process is told to end (SIGINT, SIGTERM). `port` 0 takes any free port. Calls
/// `started` with the address once it can be opened, and `ending` at the end, so that runs can be
/// cancelled. Errors: `ErrorKind::cannot_write` for a port that cannot be used.
void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending);

}  // namespace kinemend::cli
