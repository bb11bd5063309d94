// Chooses output names by the format of the input, writes takes without overwriting, and makes
// warnings, limits and shared flags.
#include "takes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "kinemend/extend/body.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"
#include "run_files.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

std::string input_name(const std::string& input) { return input == "-" ? "standard input" : input; }

bool is_stream(const std::string& input) {
  if (input == "-") return true;
  const std::string name = std::filesystem::path(input).lexically_normal().string();
  return name.starts_with("/dev/") || name.starts_with("/proc/");
}

namespace {

namespace fs = std::filesystem;

const Format* format_named(std::string_view name) {
  for (const Format& format : formats()) {
    if (format.name == name) return &format;
  }
  return nullptr;
}

// The format of a file's content; nullptr if unknown.
const Format* format_of_file(const std::string& path, std::string_view from) {
  if (!from.empty()) return format_named(from);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return nullptr;
  constexpr std::size_t most = 4096;
  std::string head(most, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return format_of_content(head);
}

bool is_written(const Format& format) {
  return format.write != nullptr || format.write_markers != nullptr;
}

// Returns the extension with its dot; empty if the name has no extension or ends in a dot.
std::string ending_of(const std::string& output) {
  if (is_stream(output)) return "";
  const std::string ending = fs::path(output).extension().string();
  return ending == "." ? "" : ending;
}

// The right extension for a result of `input` named `name`.
std::string right_ending(const std::string& name, const std::string& input, std::string_view from) {
  const Format* const held = format_of_file(input, from);
  if (held == nullptr || !is_written(*held) || held == format_of_path(name)) return ending_of(name);
  return std::string(held->extensions.front());
}

}  // namespace

std::string output_beside(const std::string& input, std::string_view word, std::string_view from) {
  if (is_stream(input)) return "-";
  fs::path output(input);
  output.replace_filename(
      fmt::format("{}.{}{}", output.stem().string(), word, right_ending(input, input, from)));
  return output.string();
}

std::string with_right_ending(const std::string& name, const std::string& input,
                              std::string_view from) {
  if (ending_of(name).empty()) return name;
  return fs::path(name).replace_extension(right_ending(name, input, from)).string();
}

void check_take_ending(const std::string& output) {
  const std::string ending = ending_of(output);
  if (ending.empty()) return;
  const Format* const format = format_of_path(output);
  if (format != nullptr && is_written(*format)) return;
  std::vector<std::string_view> written;
  for (const Format& known : formats()) {
    if (is_written(known))
      written.insert(written.end(), known.extensions.begin(), known.extensions.end());
  }
  throw Error(ErrorKind::usage,
              fmt::format("{}: {} files are not written; the endings that are written: {}. A name "
                          "without an ending keeps the format of the input",
                          printable(output), printable(ending), fmt::join(written, ", ")));
}

void check_only_ending(const std::string& output, std::string_view ending) {
  const std::string found = ending_of(output);
  if (found.empty() || same_but_for_case(found, ending)) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} files are not written here; only {} is",
                                            printable(output), printable(found), ending));
}

void check_can_hold(const std::string& name, const Take& take, std::string_view format) {
  const Format* const known = format_named(format);
  const bool joints = take.has_joints();
  if (known == nullptr || (joints ? known->write != nullptr : known->write_markers != nullptr))
    return;
  throw Error(ErrorKind::usage,
              joints
                  ? fmt::format("{}: holds joints; {} files hold markers (kinemend convert makes "
                                "them)",
                                name, format)
                  : fmt::format("{}: holds markers; {} files hold joints, which markers alone "
                                "do not give",
                                name, format));
}

std::vector<std::string> written_formats() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (is_written(format)) names.emplace_back(format.name);
  }
  return names;
}

const Format& known_format(std::string_view name) {
  if (const Format* const format = format_named(name)) return *format;
  throw Error(ErrorKind::usage, fmt::format("unknown format {}", name));
}

void check_not_there(const std::string& output, bool force) {
  if (output == "-") check_out_is_open();
  std::error_code ignored;
  if (output == "-" || force || !std::filesystem::is_regular_file(output, ignored)) return;
  throw Error(ErrorKind::cannot_write,
              fmt::format("{}: exists already (--force overwrites it)", output));
}

void check_free(const std::string& output, bool force) {
  check_not_there(output, force);
  if (output == "-" || output.empty()) return;
  std::error_code ignored;
  if (fs::is_directory(output, ignored)) {
    throw Error(ErrorKind::cannot_write,
                fmt::format("{}: this is a directory; name a file", output));
  }
  const fs::path folder = fs::path(output).parent_path();
  if (folder.empty() || fs::is_directory(folder, ignored)) return;
  throw Error(ErrorKind::cannot_write, fs::exists(folder, ignored)
                                           ? fmt::format("{}: Not a directory", folder.string())
                                           : fmt::format("{}: there is no folder {}; make it first",
                                                         output, folder.string()));
}

void write_output(const std::string& output, std::string_view bytes, bool force) {
  check_free(output, force);
  if (output == "-") return write_out(bytes);
  write_file(output, bytes, force);
}

namespace {

bool holds(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && read_file(path) == bytes;
}

// Takes written at the same time may share a skeleton, so it may exist already. Pictures of a scene
// may be in a subfolder.
void write_side_file(const SideFile& file, bool force) {
  std::error_code ignored;
  if (file.path.has_parent_path()) fs::create_directories(file.path.parent_path(), ignored);
  try {
    write_output(file.path.string(), file.bytes, force);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::cannot_write || !holds(file.path, file.bytes)) throw;
  }
}

}  // namespace

void write_take_output(const std::string& output, const Take& take, const std::string& format,
                       bool force) {
  if (output == "-") return write_output(output, write_take(take, format), force);
  const TakeFiles files = files_of_take(take, format, output);
  check_free(output, force);
  for (const SideFile& file : files.beside) write_side_file(file, force);
  write_output(output, files.bytes, force);
}

int for_each_input(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string&)>& visit,
                   const std::function<void(std::string entry)>& add_failure) {
  int code = 0;
  for (const std::string& input : inputs) {
    try {
      code = std::max(code, visit(input));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::cannot_write) throw;
      say_error(error.what());
      const int failure = static_cast<int>(error.kind());
      code = std::max(code, failure);
      add_failure(failure_json(input, error.what(), failure));
    } catch (const std::bad_alloc&) {
      throw Error(ErrorKind::unreadable_input, input_name(input) + ": out of memory");
    } catch (const std::exception& error) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{}: internal error: {}", input_name(input), error.what()));
    }
  }
  return code;
}

TakeResult read_and_warn(const std::string& input, const ReadOptions& options) {
  TakeResult read = read_take(fs::path(input), options);
  for (const Diagnostic& entry : read.diagnostics.entries())
    say_warning(diagnostic_line(read.take.source, entry));
  return read;
}

std::string pointless_text(const Take& take) {
  return take.has_joints() ? "" : contents_without_markers(take);
}

TakeFacts facts_of(const Take& take, std::string input, Diagnostics diagnostics) {
  TakeFacts facts = take_facts(take);
  facts.input = std::move(input);
  facts.diagnostics = std::move(diagnostics);
  return facts;
}

std::vector<std::string> loss_lines(const std::string& name, const Take& take,
                                    std::string_view format, bool strict) {
  std::vector<std::string> lines;
  const Diagnostics losses = lost_in_writing(take, format);
  for (const Diagnostic& loss : losses.entries()) {
    lines.push_back(name + ": " + diagnostic_text(format, loss));
    // Another number encoding is not a loss.
    if (strict && loss.name != "encoding_changed")
      throw Error(ErrorKind::quality_limit, lines.back() + " (an error under --strict)");
  }
  return lines;
}

int say_passed_limits(const Report& report, std::span<const FigureRule> figures,
                      const Arguments& arguments) {
  std::vector<FigureLimit> limits;
  for (const FigureRule& figure : figures) {
    if (arguments.given(std::string(figure.limit)))
      limits.push_back({figure.name, arguments.number(std::string(figure.limit))});
  }
  const std::vector<std::string> lines = passed_limits(report, limits);
  for (const std::string& line : lines) say_error(line);
  return lines.empty() ? 0 : static_cast<int>(ErrorKind::quality_limit);
}

Axis axis_named(std::string_view name) {
  return name == "x" ? Axis::x : name == "z" ? Axis::z : Axis::y;
}

Flag force_flag() {
  return switch_flag("force", "Output", "overwrite outputs that exist",
                     "Without it, an existing output is kept and the exit code is 4.");
}

Flag json_flag(std::string help) {
  return switch_flag("json", "Output", std::move(help),
                     "Frames have the numbers of their file; a value that is not finite is null.");
}

Flag output_flag(std::string help) {
  Flag flag = file_flag("output", "OUT", "Output", std::move(help));
  flag.letter = 'o';
  return flag;
}

Flag seed_flag(std::string help) {
  return whole_flag("seed", 1, 0, std::numeric_limits<double>::infinity(), "Work", std::move(help));
}

Flag from_flag() {
  std::vector<std::string> names;
  for (const Format& format : formats()) {
    if (format.read != nullptr) names.emplace_back(format.name);
  }
  return choice_flag("from", "Input", "format of the input, if its content does not show it",
                     std::move(names));
}

Flag strict_flag(const std::string& details) {
  return switch_flag("strict", "Input", "a repair or a warning becomes an error",
                     (details.empty() ? "" : details + " ") +
                         "Without it, a damaged but usable file is read with a warning.");
}

Flag quiet_flag(std::string details) {
  Flag flag = switch_flag("quiet", "Output", "print warnings and errors only", std::move(details));
  flag.letter = 'q';
  return flag;
}

Flag verbose_flag(std::string help, std::string details) {
  Flag flag = switch_flag("verbose", "Output", std::move(help), std::move(details));
  flag.letter = 'v';
  return flag;
}

std::vector<Flag> joints_flags(const std::string& group, std::string help,
                               const std::string& older) {
  Flag joints = text_flag("joints", "A,B,...", group, std::move(help),
                          "Names or patterns in which * is any text and ? any character; quote "
                          "them.");
  joints.takes = Takes::list;
  if (!older.empty()) joints.older_names = {older};
  Flag markers = text_flag("markers", "A,B,...", group, "the same as --joints");
  markers.takes = Takes::list;
  return {std::move(joints), std::move(markers)};
}

std::vector<std::string> joints_of(const Arguments& arguments) {
  std::vector<std::string> names = arguments.list("joints");
  const std::vector<std::string> markers = arguments.list("markers");
  names.insert(names.end(), markers.begin(), markers.end());
  return names;
}

Flag unlabelled_flag() {
  Flag flag;
  flag.spec = clean_option("unlabelled");
  flag.takes = Takes::nothing;
  flag.group = "Work";
  flag.details =
      "By default they are ignored: such a point often changes from one marker to another.";
  return flag;
}

void append(std::vector<Flag>& list, std::vector<Flag> more) {
  list.insert(list.end(), std::make_move_iterator(more.begin()),
              std::make_move_iterator(more.end()));
}

Flag map_flag() {
  return file_flag("map", "FILE", "Input",
                   "names of feet in the take: lines known name,name in the take",
                   "For takes with names that the program does not know: LeftFoot,bone_17 or "
                   "LTOE,M3. Lines about other parts are ignored, so the file of a learned "
                   "model can be used.");
}

Flag list_flag() {
  return file_flag("list", "FILE", "Input", "file with more takes and folders, one per line",
                   "Blank lines and lines that start with # are ignored; - is standard input.");
}

KnownNames names_of_map(const std::string& path) {
  return path.empty() ? KnownNames() : parse_name_map(read_file(path), input_name(path));
}

Flag source_flag() {
  Flag flag;
  flag.spec = clean_option("source");
  flag.group = "Cleaning";
  flag.details =
      "video, depth and suit: slow noise is removed, too. keyframed: only gaps change. unknown: "
      "what the file says, else only noise that the take shows is removed. For auto and learned.";
  return flag;
}

std::vector<Flag> reading_flags(const std::string& strict_details) {
  Flag asf = file_flag("asf", "FILE", "Input", "skeleton of an AMC file",
                       "Without it, the ASF file that the AMC file names, or one in its folder.");
  Flag fps = without_default(number_flag(
      "from_fps", "Hz", 120, least_frame_rate_hz, most_frame_rate_hz, "Input",
      "frame rate of a file that does not state it", "Ignored for files that state their rate."));
  Flag take = text_flag("take", "NAME", "Input", "which take of a file that holds several",
                        "FBX and glTF; kinemend info lists them. Default: the active one.");
  return {from_flag(), take, asf, fps, strict_flag(strict_details)};
}

ReadOptions read_options(const Arguments& arguments) {
  ReadOptions options;
  options.format = arguments.text("from");
  options.strict = arguments.flag("strict");
  options.animation = arguments.text("take");
  if (arguments.given("asf")) options.skeleton = arguments.text("asf");
  if (arguments.given("from_fps")) options.frame_rate_hz = arguments.number("from_fps");
  return options;
}

std::string format_for(const std::string& output, const SourceInfo& source) {
  check_take_ending(output);
  const Format* const format = ending_of(output).empty() ? nullptr : format_of_path(output);
  return format != nullptr ? std::string(format->name) : source.format;
}

}  // namespace kinemend::cli
