// The topics of `kinemend help` that concern several commands.
#pragma once

#include <string>
#include <vector>

namespace kinemend::cli {

/// A subject that concerns several commands: `kinemend help NAME`, and a section of the manual
/// page.
struct Topic {
  std::string name;     ///< "frames"
  std::string summary;  ///< one line
  std::string text;     ///< paragraphs, separated by blank lines
};

const std::vector<Topic>& topics();

}  // namespace kinemend::cli
