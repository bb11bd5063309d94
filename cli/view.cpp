// kinemend view: serves the page of a take with controls to a browser on this machine.

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "commands.hpp"
#include "http_server.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/io.hpp"
#include "platform/system.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"
#include "view_access.hpp"
#include "view_session.hpp"

namespace kinemend::cli {

namespace {

/// The page runs other commands whose words begin with the file name, so a name that begins with a
/// dash must not look like an option.
std::string named_as_file(const std::string& input) {
  if (is_stream(input))
    throw Error(ErrorKind::usage, "view: the take is read several times, so it must be a file");
  return input.starts_with('-') ? "./" + input : input;
}

ViewFiles files_of(const Arguments& arguments) {
  const std::string from = arguments.text("from");
  ViewFiles files = view_files_beside(named_as_file(arguments.positionals[0]), from);
  if (arguments.positionals.size() > 1) files.other = named_as_file(arguments.positionals[1]);
  check_take_ending(arguments.text("output"));
  const auto given = [&](const char* flag, const std::string& otherwise) {
    const std::string text = arguments.text(flag);
    return text.empty() ? otherwise : text;
  };
  files.cleaned = given("output", files.cleaned);
  files.filled = given("output", files.filled);
  files.contacts = given("contacts", files.contacts);
  files.gaps = given("gaps", files.gaps);
  files.with_gaps = arguments.given("gaps");
  files.plan = given("plan", files.plan);
  // With --output, both names are equal.
  for (const std::string& output : std::set<std::string>{files.cleaned, files.filled}) {
    RunFiles()
        .reads("TAKE", files.input)
        .writes("--gaps", files.gaps)
        .writes("--contacts", files.contacts)
        .writes("--plan", files.plan)
        .writes("--output", output)
        .check();
  }
  for (const char* flag : {"from", "asf"}) {
    if (arguments.given(flag))
      files.reading.push_back(fmt::format("--{}={}", flag, arguments.text(flag)));
  }
  if (arguments.given("from_fps"))
    files.reading.push_back(fmt::format("--from-fps={}", arguments.number("from_fps")));
  if (arguments.flag("strict")) files.reading.emplace_back("--strict");
  files.source = arguments.text("source");
  files.force = arguments.flag("force");
  return files;
}

/// Answers requests that `ViewAccess` accepts. Called from several threads.
using Answer = std::function<HttpReply(const std::string& method, std::string_view action,
                                       const std::string& body)>;

/// Serves until the process is told to end (SIGINT, SIGTERM). `port` 0 takes any free port. Calls
/// `started` with the address once it can be opened, and `ending` at the end, so that runs can be
/// cancelled. Errors: `ErrorKind::cannot_write` for a port that cannot be used.
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

int run_view(const Arguments& arguments) {
  ViewFiles files = files_of(arguments);
  if (!has_report_page())
    throw Error(ErrorKind::usage, "view: this kinemend was built without its page");
  for (const std::string& input : {files.input, files.other}) {
    if (input.empty()) continue;
    const TakeResult read = read_and_warn(input, read_options(arguments));
    if (input == files.input) files.of_joints = read.take.has_joints();
  }
  // A missing file of gaps is an error at once, not only after the page is open.
  if (files.with_gaps) read_file(files.gaps);
  ViewSession session(files);
  serve_view(
      static_cast<int>(arguments.whole("port")),
      [&](const std::string& method, std::string_view action, const std::string& body) {
        return session.answer(method, action, body);
      },
      [&](const std::string& address) {
        write_out(fmt::format("{}\nPress Ctrl-C to end.\n", address));
        if (arguments.flag("open") && !platform::open_in_browser(address)) {
          say_warning(fmt::format("{} was not found: open the address above in a browser",
                                  platform::browser_opener()));
        }
      },
      [&] { session.stop(); });
  return 0;
}

Flag view_source_flag() {
  Flag flag = source_flag();
  flag.group = "Input";
  flag.details = "The page can choose another one.";
  return flag;
}

Flag view_gaps_flag() {
  return file_flag("gaps", "FILE", "Input",
                   "samples to treat as missing: lines name,first,last (default: none; "
                   "samples marked on the page are saved as walk.gaps.csv)");
}

}  // namespace

Command view_command() {
  Command command;
  command.name = "view";
  command.summary = "view and clean a take in a browser";
  command.description =
      "Serves the page of --report FILE.html on this machine (127.0.0.1) and opens it in the "
      "browser. The page has controls for preset, method, options, joints, range and feet. Each "
      "change runs the cleaning again and shows the result; a new change stops the run before it. "
      "Contacts and gaps can be edited. Save as asks for a file name and writes the take as "
      "kinemend clean or fill would; the page shows that command line.\n\n"
      "With OTHER the page compares the two takes, as kinemend compare does. Press Ctrl-C to "
      "end.\n\n"
      "The address holds a random token. Requests from other pages, hosts and machines are "
      "refused. Takes are saved only in the folder of --output; apart from the files named here, "
      "no other file is read or written.";
  command.positionals = {{"TAKE", "take to look at", 1, 1, {}},
                         {"OTHER", "take to compare it with", 0, 1, {}}};
  Flag port = whole_flag("port", 0, 0, 65535, "Page", "port of 127.0.0.1; 0: a free one");
  port.value_name = "PORT";
  Flag open = switch_flag("open", "Page", "open the address in the browser");
  open.spec.default_value = true;
  command.flags = {
      output_flag("file that Save as proposes (default walk.clean.bvh or walk.filled.bvh)"),
      view_gaps_flag(),
      view_source_flag(),
      file_flag("contacts", "FILE", "Output",
                "where to save contacts (default walk.contacts); read if it exists"),
      file_flag("plan", "FILE", "Output", "where to save the gap plan (default walk.plan.csv)"),
      force_flag(),
      port,
      open};
  append(command.flags, reading_flags());
  command.examples = {
      {"kinemend view walk.bvh", "opens the browser"},
      {"kinemend view walk.bvh walk.clean.bvh", "compare two takes at the same time"},
      {"kinemend view trial.c3d --no-open --port 8080 -o trial.filled.c3d",
       "prints the address only"}};
  command.run = run_view;
  return command;
}

}  // namespace kinemend::cli
