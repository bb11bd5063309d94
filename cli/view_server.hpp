#pragma once

#include <functional>
#include <string>

#include "view_access.hpp"

// The server of `view`: HTTP on 127.0.0.1, and nothing of what is asked of it.
namespace kinemend::cli {

struct ServedReply {
  int status = 200;
  std::string type, body;
};
/// Answers what `ViewAccess` lets through. Called from several threads.
using Answer = std::function<ServedReply(const std::string& method, std::string_view action,
                                         const std::string& body)>;

/// Whether this build has a server.
bool has_view_server();

/// Serves until the process is told to end (SIGINT, SIGTERM). `port` 0: any that is free. `started`
/// is called with the address once it can be opened, `ending` when the end has come, so that runs
/// can be given up. Errors: `ErrorKind::usage` for a build without a server,
/// `ErrorKind::cannot_write` for a port that is taken.
void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending);

}  // namespace kinemend::cli
