#include "kinemend/fill.hpp"

#include <algorithm>

namespace kinemend {

std::size_t FillReport::filled() const {
  return static_cast<std::size_t>(
      std::count_if(gaps.begin(), gaps.end(), [](const GapOutcome& gap) { return gap.filled; }));
}

std::size_t FillReport::refused() const { return gaps.size() - filled(); }

}  // namespace kinemend
