// Each command's file defines its entry in the table of commands; `command.cpp` lists them.
#pragma once

#include "command.hpp"

namespace kinemend::cli {

Command clean_command();
Command batch_command();
Command fill_command();
Command stream_command();
Command info_command();
Command check_command();
Command contacts_command();
Command compare_command();
Command plot_command();
Command view_command();
Command methods_command();
Command train_command();
Command models_command();
Command convert_command();
Command corrupt_command();
Command synth_command();
Command completion_command();
Command man_command();
/// The command `help`, which needs the other commands by name.
Command help_command(const std::vector<Command>& others);

/// Returns the page of `compare`, as --report FILE.html writes it, for a checked command line.
/// Throws the errors of reading and comparing.
std::string comparison_page(const Arguments& arguments, bool is_served);

}  // namespace kinemend::cli
