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
#include "kinemend/known_names.hpp"
#include "kinemend/report.hpp"

// What the commands that read and write takes have in common.
namespace kinemend::cli {

/// "standard input" for "-".
std::string input_name(const std::string& input);
/// Standard input by any name: `-`, /dev/stdin, and what a shell passes as /dev/fd/63.
bool is_stream(const std::string& input);
/// `walk.bvh` to `walk.clean.bvh` for the word "clean"; standard input to standard output.
std::string output_beside(const std::string& input, std::string_view word);
/// Refuses an output that exists, before work is spent on it. Errors: `ErrorKind::cannot_write`.
void check_free(const std::string& output, bool force);
/// To a file, or to standard output for "-".
void write_output(const std::string& output, std::string_view bytes, bool force);
/// The take in `format`, with what must stand beside it (the skeleton of an AMC file).
void write_take_output(const std::string& output, const Take& take, const std::string& format,
                       bool force);
/// Refuses an output that is one of `inputs` under any name. Commands whose files are all known
/// before they work use `RunFiles`, which checks them together. Errors: `ErrorKind::usage`.
void check_is_no_input(std::string_view option, const std::string& output,
                       const std::vector<std::string>& inputs);
/// Calls `visit` with each input and returns the highest exit code. An input that cannot be read is
/// said, its entry in JSON goes to `add_failure`, and it stops none of the others; an output that
/// cannot be written stops all.
int for_each_input(const std::vector<std::string>& inputs,
                   const std::function<int(const std::string&)>& visit,
                   const std::function<void(std::string entry)>& add_failure);
/// A line a kind of repair, as a warning.
void warn_of_repairs(const SourceInfo& source, const Diagnostics& diagnostics);
/// What a file of this format will not hold of the take, a line each. Errors: `quality_limit` with
/// the first of them when `strict`.
std::vector<std::string> loss_lines(const std::string& name, const Take& take,
                                    std::string_view format, bool strict);

/// What a marker file without markers holds; empty for any other take.
std::string pointless_text(const Take& take);
/// What a report says of a take that was read.
TakeFacts facts_of(const Take& take, std::string input, Diagnostics diagnostics);
/// The number of the first frame, as the file counts.
std::int64_t first_frame_of(const Take& take);

/// A line for each limit that is given and passed: exit code 1, else 0.
int say_passed_limits(const Report& report, std::span<const FigureRule> figures,
                      const Arguments& arguments);

/// Flags that several commands share.
Flag force_flag();
Flag json_flag(std::string help);
Flag output_flag(std::string help);
Flag seed_flag(std::string help);
Flag from_flag();
Flag strict_flag(std::string help);
/// --unlabelled, of the commands that fill gaps.
Flag unlabelled_flag();
/// --map, for feet whose names are not known.
Flag map_flag();
/// What --map names; nothing where it is not given.
KnownNames names_of_map(const std::string& path);
/// All flags that `read_options` understands: --from, --asf, --from-fps, --strict.
std::vector<Flag> reading_flags(std::string strict_help);
/// Puts `more` behind `list`.
void append(std::vector<Flag>& list, std::vector<Flag> more);
/// Of the flags that the command has.
ReadOptions read_options(const Arguments& arguments);
/// The format to write: that of the output's extension, else the input's own.
std::string format_for(const std::string& output, const SourceInfo& source);

}  // namespace kinemend::cli
