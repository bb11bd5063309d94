// The program's words and standard streams, as the system has them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kinemend::cli::platform {

constexpr int standard_input = 0, standard_output = 1, standard_error = 2;

/// The words behind the program's name, in UTF-8.
std::vector<std::string> program_words(int argc, char** argv);

/// Opens closed standard streams on the null device, so that the next opened file does not become
/// one of them, and sets them to bytes. Returns whether standard output was open. To be called
/// first.
bool open_standard_streams();
/// A closed pipe becomes an error of the write, and ends the program no longer.
void ignore_closed_pipes();
/// Keeps freed memory for the next use, where that has to be asked for.
void keep_freed_memory();

bool is_terminal(int stream);
/// Whether the stream is a terminal that understands escape sequences.
bool understands_colours(int stream);
/// Returns 0, or the number of the error; EPIPE: its reader has closed the pipe.
int write_all(int stream, std::string_view text);

/// Such as "Linux" and "x86_64"; empty where it is not known.
struct SystemNames {
  std::string system, machine;
};
SystemNames system_names();

}  // namespace kinemend::cli::platform
