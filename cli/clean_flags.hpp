// The flags of `clean`, in parts that `batch` shares.
#pragma once

#include <vector>

#include "command.hpp"

namespace kinemend::cli {

/// The flags for results and reports of single takes.
std::vector<Flag> clean_output_flags();
/// The flags of cleaning, including all that a configuration file may hold.
std::vector<Flag> cleaning_flags();
/// --contacts, which applies to one take.
Flag contacts_flag();
/// --jobs
Flag jobs_flag();

}  // namespace kinemend::cli
