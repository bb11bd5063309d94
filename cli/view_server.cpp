// Runs the HTTP server and turns SIGINT and SIGTERM into an orderly end.
#include "view_server.hpp"

#include <string>

#include "http_server.hpp"
#include "platform/system.hpp"

namespace kinemend::cli {

void serve_view(int port, const Answer& answer,
                const std::function<void(const std::string& address)>& started,
                const std::function<void()>& ending) {
  HttpServer server(port);
  const ViewAccess access(random_token(), server.port());
  const platform::EndSignals signals([&] {
    ending();
    server.stop();
  });
  started(access.address());
  server.serve(
      [&](const HttpHead& head) {
        return access.refusal(
            {head.method, head.path, head.host, head.origin, head.site, head.type});
      },
      [&](const HttpHead& head, const std::string& body) {
        return answer(head.method, access.action(head.path), body);
      });
}

}  // namespace kinemend::cli
