// Reads what the flag `--noise` says of the noise of a take.
#pragma once

#include <optional>
#include <string>

#include "kinemend/clean.hpp"

namespace kinemend::cli {

/// What `--noise` says: nothing of "auto", white noise of a measured strength of "white", else what
/// the report at that path found of the first take in it. Errors: `ErrorKind::usage` for a file
/// that is no report of `clean` or `check` with noise in it; those of `read_file`.
std::optional<KnownNoise> known_noise(const std::string& choice);

}  // namespace kinemend::cli
