// `kinemend stream` without sockets: text comes in, and cleaned frames go out as text.
#include <map>
#include <memory>
#include <string>

#include "answer.hpp"
#include "command_line.hpp"
#include "commands.hpp"
#include "kinemend/methods.hpp"
#include "method_options.hpp"
#include "stream_plan.hpp"

namespace kinemend::cli {

namespace {

int refuse_stream(const Arguments& /*arguments*/) {
  throw Error(ErrorKind::usage, "stream: in JavaScript kinemend.stream() begins a live stream");
}

}  // namespace

/// The command `stream` with the flags that need no sockets.
Command stream_command() {
  Command command;
  command.name = "stream";
  command.summary = "clean frames as they arrive, with a constant delay";
  command.flags = live_flags();
  command.groups = live_groups();
  command.groups_are_flags = true;
  command.run = refuse_stream;
  return command;
}

}  // namespace kinemend::cli

namespace {

using namespace kinemend::wasm;

struct Stream {
  std::unique_ptr<kinemend::Cleaner> cleaner;
  std::unique_ptr<kinemend::LiveSession> session;
};
std::map<int, Stream> streams;
int last_stream = 0;

Stream& stream_of(int id) {
  const auto found = streams.find(id);
  if (found == streams.end())
    throw kinemend::Error(kinemend::ErrorKind::usage, "stream: it is closed");
  return found->second;
}

void open(const char* options) {
  std::vector<std::string> words = words_of(options);
  words.insert(words.begin(), "stream");
  const kinemend::cli::Arguments arguments = kinemend::cli::parse_command_line(words).arguments;
  const kinemend::Method& method = kinemend::find_method(arguments.text("method"));
  Stream stream;
  stream.cleaner = kinemend::cli::live_cleaner(
      method, kinemend::cli::parse_method_options(method, arguments.group_texts));
  stream.session = std::make_unique<kinemend::LiveSession>(
      *stream.cleaner, kinemend::cli::live_options(arguments),
      [](const kinemend::LivePiece& piece) { answer.out += piece.text; });
  streams.emplace(++last_stream, std::move(stream));
}

void tell_notes(Stream& stream) {
  for (const std::string& note : stream.session->take_notes()) answer.err += note + "\n";
}

void finish(int id) {
  Stream& stream = stream_of(id);
  stream.session->finish();
  tell_notes(stream);
  const bool has_skeleton = stream.session->has_skeleton();
  streams.erase(id);
  if (!has_skeleton)
    throw kinemend::Error(kinemend::ErrorKind::unreadable_input,
                          "stream: no header found; a stream begins with the hierarchy of a BVH "
                          "file, or with MARKERS, the rate and the names");
}

}  // namespace

extern "C" {

/// Opens a stream with options of the command line (a JSON object). Returns its number, or 0 with
/// the reason in the message.
int kinemend_stream_open(const char* options) {
  return answered([&] { open(options); }) == 0 ? last_stream : 0;
}

/// Feeds bytes as they arrive. The report holds the frames cleaned by them, the message the notes.
/// Returns 0 or an error code.
int kinemend_stream_push(int id, const char* bytes, std::size_t size) {
  return answered([&] {
    Stream& stream = stream_of(id);
    stream.session->feed({bytes, size});
    tell_notes(stream);
  });
}

/// Ends the stream; the report holds the remaining frames.
int kinemend_stream_finish(int id) {
  return answered([&] { finish(id); });
}

/// Ends the stream without the remaining frames.
void kinemend_stream_close(int id) { streams.erase(id); }

/// The delay of the output in frames; 0 before a header.
std::size_t kinemend_stream_delay(int id) {
  const auto found = streams.find(id);
  return found == streams.end() ? 0 : found->second.session->latency_frames();
}

}  // extern "C"
