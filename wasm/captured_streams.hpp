// The text that a command of the module writes to its standard streams.
#pragma once

#include <string>

namespace kinemend::cli::platform {

struct Captured {
  std::string out, err;
};
extern Captured captured;

}  // namespace kinemend::cli::platform
