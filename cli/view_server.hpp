// The server of `view`: it decides who may ask and when it ends, and the caller answers.
#pragma once

#include <functional>
#include <string>

#include "http_server.hpp"
#include "view_access.hpp"

namespace kinemend::cli {

/// Answers what `ViewAccess` lets through. Called from several threads.
using Answer = std::function<HttpReply(const std::string& method, std::string_view action,
                                       const std::string& body)>;

/// Serves until the process is told to end (SIGINT, SIGTERM). `port` 0: any that is free. `started`
/// is called with the address once it can be opened, `ending` when the end has come, so that runs
/// can be given up. Errors: `ErrorKind::cannot_write` for a port that cannot be used.
void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending);

}  // namespace kinemend::cli
