// Reads the flag `--noise`.
#pragma once

#include <optional>
#include <string>

#include "kinemend/clean.hpp"

namespace kinemend::cli {

/// The noise that `--noise` states: nullopt for "auto", white noise of measured strength for
/// "white", and otherwise the noise of the first take in the report at that path. Errors:
/// `ErrorKind::usage` for a file that is not a report of `clean` or `check` with noise; those of
/// `read_file`.
std::optional<KnownNoise> known_noise(const std::string& choice);

}  // namespace kinemend::cli
