// Runs command lines in memory, without `main`.
#pragma once

#include <string>
#include <vector>

namespace kinemend::cli {

/// Runs the command given by the words after the program's name. Prints errors as one line. Returns
/// the exit code.
int run_words(const std::vector<std::string>& words);

}  // namespace kinemend::cli
