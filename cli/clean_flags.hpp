// The flags of `clean`, in the parts that `batch` shares.
#pragma once

#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// Where results and reports of single takes go.
std::vector<Flag> clean_output_flags();
/// How and where to clean; what a configuration file may hold is among them.
std::vector<Flag> cleaning_flags();
/// --contacts, which is of one take
Flag contacts_flag();
/// --jobs
Flag jobs_flag();

}  // namespace kinemend::cli
