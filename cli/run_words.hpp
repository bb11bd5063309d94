// The entry of the program, apart from its main, for whoever runs commands in memory.
#pragma once

#include <string>
#include <vector>

namespace kinemend::cli {

/// Runs the command that the words ask for, which are those behind the program's name. Errors are
/// printed as one line. Returns the exit code.
int run_words(const std::vector<std::string>& words);

}  // namespace kinemend::cli
