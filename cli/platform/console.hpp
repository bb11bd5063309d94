// The command line and standard streams of the system.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli::platform {

constexpr int standard_input = 0, standard_output = 1, standard_error = 2;

/// The arguments after the program's name, in UTF-8.
std::vector<std::string> program_words(int argc, char** argv);

/// Opens closed standard streams on the null device, so that the next opened file does not become
/// one of them, and sets them to binary mode. Returns whether standard output was open. Call it
/// first.
bool open_standard_streams();
/// Makes writing to a closed pipe an error instead of ending the program.
void ignore_closed_pipes();
/// Keeps freed memory for reuse, on systems where this must be requested.
void keep_freed_memory();

bool is_terminal(int stream);
/// Whether the stream is a terminal that understands escape sequences.
bool understands_colours(int stream);
/// Returns 0 or the error number; EPIPE means that the reader has closed the pipe.
int write_all(int stream, std::string_view text);

/// Names such as "Linux" and "x86_64"; empty if unknown.
struct SystemNames {
  std::string system, machine;
};
SystemNames system_names();

}  // namespace kinemend::cli::platform
