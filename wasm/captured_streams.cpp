// Standard streams of the module, as texts that JavaScript fetches.
#include "captured_streams.hpp"

#include "platform/console.hpp"

namespace kinemend::cli::platform {

Captured captured;

std::vector<std::string> program_words(int /*argc*/, char** /*argv*/) { return {}; }
bool open_standard_streams() { return true; }
void ignore_closed_pipes() {}
void keep_freed_memory() {}
bool is_terminal(int /*stream*/) { return false; }
bool understands_colours(int /*stream*/) { return false; }

int write_all(int stream, std::string_view text) {
  (stream == standard_output ? captured.out : captured.err) += text;
  return 0;
}

SystemNames system_names() { return {"WebAssembly", "wasm32"}; }

}  // namespace kinemend::cli::platform
