// Names, checks, messages and flags that the commands which read and write takes share.
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
#include "kinemend/skeleton.hpp"

namespace kinemend::cli {

/// "standard input" for "-".
std::string input_name(const std::string& input);
/// Whether the input is a stream: `-`, /dev/stdin, or a pipe that a shell passes as /dev/fd/63.
bool is_stream(const std::string& input);
/// `walk.clean.bvh` for `walk.bvh` and the word "clean"; standard output for standard input. Where
/// the ending of the input is not one of the format that it holds, the result gets the right one.
/// `from`: the format that --from names, or empty.
std::string output_beside(const std::string& input, std::string_view word, std::string_view from);
/// `name` for a result of `input`, with the right ending in the same way; a name without an ending
/// stays as it is.
std::string with_right_ending(const std::string& name, const std::string& input,
                              std::string_view from);
/// Refuses an output whose ending belongs to no format that is written, such as .fbx; a name
/// without an ending is allowed. Errors: `ErrorKind::usage` with the endings that are written.
void check_take_ending(const std::string& output);
/// Refuses any ending but this one (with its dot) and none. Errors: `ErrorKind::usage`.
void check_only_ending(const std::string& output, std::string_view ending);
/// The format called so. Errors: `ErrorKind::usage`.
const Format& known_format(std::string_view name);
/// The names of the formats that are written.
std::vector<std::string> written_formats();
/// Refuses a format that cannot hold the take, as a format of markers cannot hold joints. Errors:
/// `ErrorKind::usage`.
void check_can_hold(const std::string& name, const Take& take, std::string_view format);
/// Refuses an output that exists as a file, unless `force`. Errors: `ErrorKind::cannot_write`.
void check_not_there(const std::string& output, bool force);
/// The same, and refuses an output whose folder does not exist or that is a folder, before work is
/// spent on it. Errors: `ErrorKind::cannot_write`.
void check_free(const std::string& output, bool force);
/// To a file, or to standard output for "-".
void write_output(const std::string& output, std::string_view bytes, bool force);
/// Writes the take in `format`, and the file that it needs beside it (the skeleton of an AMC file).
void write_take_output(const std::string& output, const Take& take, const std::string& format,
                       bool force);
/// Calls `visit` with each input and returns the highest exit code. An input that cannot be read is
/// said, its entry in JSON goes to `add_failure`, and it stops none of the others; an output that
/// cannot be written stops all.
int for_each_input(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string&)>& visit,
                   const std::function<void(std::string entry)>& add_failure);
/// Prints a warning for each kind of repair.
void warn_of_repairs(const SourceInfo& source, const Diagnostics& diagnostics);
/// A line for each part of the take that a file of this format cannot hold. Errors: `quality_limit`
/// with the first line when `strict`.
std::vector<std::string> loss_lines(const std::string& name, const Take& take,
                                    std::string_view format, bool strict);

/// The content of a marker file without markers, in words; empty for any other take.
std::string pointless_text(const Take& take);
/// What a report says about a take that was read.
TakeFacts facts_of(const Take& take, std::string input, Diagnostics diagnostics);
/// The number that the file gives its first frame.
std::int64_t first_frame_of(const Take& take);

/// Prints a line for each limit that is given and exceeded. Returns 1 if there is one, else 0.
int say_passed_limits(const Report& report, std::span<const FigureRule> figures,
                      const Arguments& arguments);

/// Flags that several commands share.
Flag force_flag();
Flag json_flag(std::string help);
Flag output_flag(std::string help);
Flag seed_flag(std::string help);
Flag from_flag();
/// --strict. `details`: what counts besides repairs and warnings.
Flag strict_flag(const std::string& details = {});
/// -q, --quiet: warnings and errors are all that is printed.
Flag quiet_flag(std::string details = {});
/// -v, --verbose: everything is listed.
Flag verbose_flag(std::string help, std::string details = {});
/// --joints and --markers, which are one list. `older`: an earlier name of it, or empty.
std::vector<Flag> joints_flags(const std::string& group, std::string help,
                               const std::string& older = {});
/// The names of both, in the order of --joints, then --markers.
std::vector<std::string> joints_of(const Arguments& arguments);
/// --unlabelled, of the commands that fill gaps.
Flag unlabelled_flag();
/// --map, for feet whose names are not known.
Flag map_flag();
/// The names that the file of --map gives; empty where `path` is.
KnownNames names_of_map(const std::string& path);
/// --source, of the commands that clean or look for noise.
Flag source_flag();
/// All flags that `read_options` understands: --from, --asf, --from-fps, --strict.
std::vector<Flag> reading_flags(const std::string& strict_details = {});
/// Appends `more` to `list`.
void append(std::vector<Flag>& list, std::vector<Flag> more);
/// The reading options that the flags of the command set.
ReadOptions read_options(const Arguments& arguments);
/// The format to write: that of the output's ending; that of the source for standard output and for
/// a name without an ending. Errors: as `check_take_ending`.
std::string format_for(const std::string& output, const SourceInfo& source);

}  // namespace kinemend::cli
