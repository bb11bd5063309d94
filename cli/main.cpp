// The program: parses the command line, runs the command, turns errors into one line and a code.

#include <fmt/format.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <csignal>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "command_line.hpp"
#include "help.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace {

using namespace kinemend;
using namespace kinemend::cli;

/// An exception that is no `Error` is reported with the name of the take.
int run_command(const Command& command, const Arguments& arguments) {
  const std::string place =
      arguments.positionals.size() == 1 ? input_name(arguments.positionals[0]) + ": " : "";
  try {
    return command.run(arguments);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw Error(ErrorKind::unreadable_input, place + "out of memory");
  } catch (const std::exception& error) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}internal error: {}", place, error.what()));
  }
}

int run(const std::vector<std::string>& words) {
  Request request = parse_command_line(words);
  request.arguments.words = words;
  const Command* command = request.arguments.command;
  const bool is_long = request.kind == Request::Kind::long_help;
  switch (request.kind) {
    case Request::Kind::version:
      write_out(version_text());
      return 0;
    case Request::Kind::short_help:
    case Request::Kind::long_help:
      write_out(command ? command_help(*command, is_long) : program_help(is_long));
      return 0;
    case Request::Kind::run:
      break;
  }
  return run_command(*command, request.arguments);
}

int fail(const std::string& message, ErrorKind kind) {
  say_error(message);
  return static_cast<int>(kind);
}

// Cleaning allocates and frees tracks by the hundred. Memory that is returned to the system each
// time would have to be mapped in again, page by page.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int largest_kept = 8 << 20, most_kept = 64 << 20;  // bytes
  mallopt(M_MMAP_THRESHOLD, largest_kept);
  mallopt(M_TRIM_THRESHOLD, most_kept);
#endif
}

}  // namespace

// The locale is never set, so that numbers look the same everywhere.
int main(int argc, char** argv) {
  open_standard_streams();
  keep_freed_memory();
  // A closed pipe is then an error of the write, not a signal.
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run({argv + 1, argv + argc});
  } catch (const ClosedPipe&) {
    return 0;
  } catch (const Error& error) {
    return fail(error.what(), error.kind());
  } catch (const std::bad_alloc&) {
    return fail("out of memory", ErrorKind::unreadable_input);
  } catch (const std::exception& error) {
    return fail(fmt::format("internal error: {}", error.what()), ErrorKind::unreadable_input);
  }
}
