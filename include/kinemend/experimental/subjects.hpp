// The people of a take of markers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "kinemend/take.hpp"

namespace kinemend {

struct Subject {
  std::string name;                  ///< "Ann"; empty for markers that bear no subject's
  std::vector<std::size_t> markers;  ///< those that are positions, ascending
};

/// Whose markers a take holds, by what stands before the last colon of their names (`Ann:LASI`), in
/// the order of their first markers; those of nobody come last. All markers in one without a name
/// where no two subjects are told apart; none of a take without positions.
std::vector<Subject> subjects_of(const Take& clip);

}  // namespace kinemend
