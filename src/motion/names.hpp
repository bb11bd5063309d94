// Selects joints and markers by names and shell patterns, finds the subject in a name and the one
// with the most markers, and recognises points that have a number from the capture system in place
// of a label.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/motion.hpp"

namespace kinemend {

/// Returns the part of a name that `without_subject` leaves out: `Ann:` for `Ann:LASI`; empty for a
/// name without a subject.
std::string_view subject_part(std::string_view name);

/// Returns N marks, 1 if a name equals the given one or matches the shell pattern, with or without
/// its subject. If no name matches, case is ignored. All are 0 without a match.
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::string& pattern);

/// Returns N marks of all matches of the patterns, or of all names if there is no pattern. Errors:
/// `ErrorKind::usage` for a pattern without a match, which states `kind` ("joint", "marker").
std::vector<std::uint8_t> names_meant(const std::vector<std::string>& names,
                                      const std::vector<std::string>& patterns,
                                      std::string_view kind);

/// Whether the name of a marker is only a number given by the capture system, with or without a
/// subject: `*52`, `U_12`, `uname*3`, `Unlabeled 1234`, or no name at all. Such a point changes
/// from one marker to another within a take.
bool is_unlabelled(std::string_view name);

/// Returns the subject with the most markers, the first of several such. A take without subjects
/// gives a subject without markers.
Subject largest_subject(const Take& clip);

}  // namespace kinemend
