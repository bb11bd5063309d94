// The page of `view` without a server: a session on a take in memory answers the same requests.
#include <emscripten.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>

#include "answer.hpp"
#include "kinemend/io.hpp"
#include "view_session.hpp"

// Reports the progress of a run to the page if it listens.
EM_JS(void, kinemend_tell, (const char* stage, double done), {
  if (Module["tell"]) Module["tell"](UTF8ToString(stage), done);
});

namespace {

using namespace kinemend::wasm;

std::unique_ptr<kinemend::cli::ViewSession> session;

constexpr std::size_t sniffed_bytes = 4096;  // as in kinemend/io.hpp

bool is_of_joints(const std::string& name) {
  std::string head(sniffed_bytes, '\0');
  std::ifstream file(name, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  const kinemend::Format* format = kinemend::format_of_content(head);
  // If the format implies the kind of take, the take is read only by the first run.
  if (format != nullptr && format->read != nullptr &&
      (format->write == nullptr) != (format->write_markers == nullptr))
    return format->write != nullptr;
  return kinemend::read_take(std::filesystem::path(name), {}).take.has_joints();
}

void open(const std::string& name) {
  kinemend::cli::ViewFiles files = kinemend::cli::view_files_beside(name);
  files.of_joints = is_of_joints(name);
  const auto told = [](std::string_view stage, double done) {
    kinemend_tell(std::string(stage).c_str(), done);
  };
  session = std::make_unique<kinemend::cli::ViewSession>(std::move(files), told);
  answer.out = session->session();
}

}  // namespace

extern "C" {

/// Opens a session on a take kept by `kinemend_put_file`, and ends the previous one. The skeleton
/// of an AMC file is the ASF file beside it. The report is the session (web/src/served.ts). Returns
/// the program's exit code.
int kinemend_view_open(const char* name) {
  session.reset();
  return answered([&] { open(plain_name(name)); });
}

/// Answers a request of the page as the server of `view` does; the report is the body. Returns the
/// HTTP status.
int kinemend_view_ask(const char* action, const char* body) {
  constexpr int gone = 410;
  answered([&] {
    if (!session) {
      answer.code = gone;
      return;
    }
    kinemend::cli::ViewReply reply = session->answer("POST", action, body);
    answer.out = std::move(reply.body);
    answer.code = reply.status;
  });
  return answer.code;
}

}  // extern "C"
