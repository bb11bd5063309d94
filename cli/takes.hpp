// Names, checks, messages and flags shared by the commands that read and write takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "command.hpp"
#include "kinemend/io.hpp"
#include "kinemend/report.hpp"
#include "kinemend/take.hpp"

namespace kinemend::cli {

/// "standard input" for "-".
std::string input_name(const std::string& input);
/// Returns whether the input is a stream: `-`, /dev/stdin, or a shell's pipe such as /dev/fd/63.
bool is_stream(const std::string& input);
/// `walk.clean.bvh` for `walk.bvh` and the word "clean"; standard output for standard input. If the
/// extension of the input does not match its format, the result gets the right one. `from` is the
/// format of --from, or empty.
std::string output_beside(const std::string& input, std::string_view word, std::string_view from);
/// `name` for a result of `input`, with a corrected extension in the same way; a name without an
/// extension is unchanged.
std::string with_right_ending(const std::string& name, const std::string& input,
                              std::string_view from);
/// Refuses an output whose extension belongs to no writable format; a name without an extension is
/// allowed. Errors: `ErrorKind::usage` with the writable extensions.
void check_take_ending(const std::string& output);
/// Refuses any other extension than this one (with its dot); a name without one is allowed.
/// Errors: `ErrorKind::usage`.
void check_only_ending(const std::string& output, std::string_view ending);
/// The format with this name. Errors: `ErrorKind::usage`.
const Format& known_format(std::string_view name);
/// The names of the writable formats.
std::vector<std::string> written_formats();
/// Refuses a format that cannot hold the take: a format of markers cannot hold joints. Errors:
/// `ErrorKind::usage`.
void check_can_hold(const std::string& name, const Take& take, std::string_view format);
/// Refuses an output that exists as a file, unless `force`. Errors: `ErrorKind::cannot_write`.
void check_not_there(const std::string& output, bool force);
/// Refuses, before work is spent, an existing output, one whose folder is missing, and one that is
/// a folder. Errors: `ErrorKind::cannot_write`.
void check_free(const std::string& output, bool force);
/// Writes to a file, or to standard output for "-".
void write_output(const std::string& output, std::string_view bytes, bool force);
/// Writes the take in `format`, and the file that it needs (the skeleton of an AMC file).
void write_take_output(const std::string& output, const Take& take, const std::string& format,
                       bool force);
/// Calls `visit` with each input and returns the highest exit code. An unreadable input is
/// reported, its JSON entry goes to `add_failure`, and the others continue; an output that cannot
/// be written stops all.
int for_each_input(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string&)>& visit,
                   const std::function<void(std::string entry)>& add_failure);
/// Reads a take and prints a warning for each kind of repair. Errors: those of `read_take`.
TakeResult read_and_warn(const std::string& input, const ReadOptions& options);
/// One line for each part of the take that a file of this format cannot hold. Errors:
/// `quality_limit` with the first line if `strict`.
std::vector<std::string> loss_lines(const std::string& name, const Take& take,
                                    std::string_view format, bool strict);

/// Describes a marker file without markers; empty for any other take.
std::string pointless_text(const Take& take);
/// The facts of a take for its report.
TakeFacts facts_of(const Take& take, std::string input, Diagnostics diagnostics);

/// Prints a line for each exceeded limit. Returns 1 if there is one, else 0.
int say_passed_limits(const Report& report, std::span<const FigureRule> figures,
                      const Arguments& arguments);

/// The axis that is called x, y or z, as in the choices of --up; y for any other name.
Axis axis_named(std::string_view name);

/// Flags shared by several commands.
Flag force_flag();
Flag json_flag(std::string help);
Flag output_flag(std::string help);
Flag seed_flag(std::string help);
Flag from_flag();
/// --strict. `details` says what it refuses besides repairs and warnings.
Flag strict_flag(const std::string& details = {});
/// -q, --quiet: prints only warnings and errors.
Flag quiet_flag(std::string details = {});
/// -v, --verbose: lists everything.
Flag verbose_flag(std::string help, std::string details = {});
/// --joints and --markers, which fill one list. `older` is an earlier name of it, or empty.
std::vector<Flag> joints_flags(const std::string& group, std::string help,
                               const std::string& older = {});
/// The names given to both flags: first those of --joints, then those of --markers.
std::vector<std::string> joints_of(const Arguments& arguments);
/// --unlabelled, for commands that fill gaps.
Flag unlabelled_flag();
/// --map, for feet with unknown names.
Flag map_flag();
/// --list, a file with more inputs; `listed_inputs` reads it.
Flag list_flag();
/// The names in the file of --map; empty if `path` is empty.
KnownNames names_of_map(const std::string& path);
/// --source, for commands that clean or measure noise.
Flag source_flag();
/// All flags of `read_options`: --from, --asf, --from-fps, --strict.
std::vector<Flag> reading_flags(const std::string& strict_details = {});
/// Appends `more` to `list`.
void append(std::vector<Flag>& list, std::vector<Flag> more);
/// The reading options that the flags of the command set.
ReadOptions read_options(const Arguments& arguments);
/// The format to write: that of the output's extension, or that of the source for standard output
/// and for a name without an extension. Errors: those of `check_take_ending`.
std::string format_for(const std::string& output, const SourceInfo& source);

}  // namespace kinemend::cli
