// kinemend convert: reads one format and writes another, or the same anew.

#include <fmt/format.h>

#include "commands.hpp"
#include "kinemend/io.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

/// --to, else by the output's extension, else the input's own.
std::string output_format(const Arguments& arguments, const Clip& clip) {
  if (std::string format = arguments.text("to"); !format.empty()) return format;
  const std::string output = arguments.text("output");
  if (output == "-") return clip.source.format;
  if (const Format* format = format_of_path(output)) return std::string(format->name);
  throw Error(
      ErrorKind::usage,
      fmt::format("convert: {} has the extension of no format; name one with --to", output));
}

int run(const Arguments& arguments) {
  const std::string input = arguments.positionals[0];
  const std::string output = arguments.text("output");
  if (output.empty())
    throw Error(ErrorKind::usage, "convert: --output is missing (see kinemend convert -h)");
  check_free(output, arguments.flag("force"));
  ReadResult take = read_clip(std::filesystem::path(input), read_options(arguments));
  warn_of_repairs(input_name(input), take.diagnostics);
  const std::string format = output_format(arguments, take.clip);
  if (arguments.flag("plain")) take.clip.source.document.reset();
  write_output(output, write_clip(take.clip, format), arguments.flag("force"));
  return 0;
}

}  // namespace

Command convert_command() {
  Flag to =
      text_flag("to", "", "Output", "format to write, where the output's extension does not tell");
  to.spec.choices = format_names();
  Command command;
  command.name = "convert";
  command.summary = "write a take in another format, or anew in its own";
  command.description = "Formats there are: ";
  for (const Format& format : formats()) {
    if (command.description.back() != ' ') command.description += ", ";
    command.description += fmt::format("{} ({})", format.name, format.description);
  }
  command.description +=
      ". Within one format the source's layout and digits stay, unless --plain asks for the "
      "program's own.";
  command.positionals = {{"IN", "take to read; - is standard input", 1, 1, {}}};
  command.flags = {output_flag("where to write; - is standard output"),
                   to,
                   switch_flag("plain", "Output", "drop the source's layout and write anew"),
                   force_flag(),
                   from_flag(),
                   strict_flag("what needs a repair becomes an error")};
  command.examples = {{"kinemend convert odd.bvh --plain -o plain.bvh",
                       "a file that other programs cannot read, in its plainest form"}};
  command.run = run;
  return command;
}

}  // namespace kinemend::cli
