// The people of a take of markers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

struct Subject {
  std::string name;                  ///< "Ann"; empty for markers without a subject
  std::vector<std::size_t> markers;  ///< the markers that are positions, ascending
};

/// Returns the subjects of a take by the part of the names before the last colon (`Ann:LASI`), in
/// the order of their first markers; markers without a subject come last. If fewer than two
/// subjects are found, all markers are one subject without a name. Empty for a take without
/// positions.
std::vector<Subject> subjects_of(const Take& clip);

}  // namespace kinemend
