// Parses the command line, runs the command, and converts errors to one line and an exit code.
#include "run_words.hpp"

#include <fmt/format.h>

#include <exception>
#include <new>

#include "command_line.hpp"
#include "help.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

/// Runs a command; an exception other than `Error` is reported with the name of the take.
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

}  // namespace

int run_words(const std::vector<std::string>& words) {
  try {
    return run(words);
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

}  // namespace kinemend::cli
