// Matches the rows of a plan with the gaps of a take.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "fill/driver.hpp"
#include "kinemend/extend/gap_plan.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

/// Identifies a gap within its take.
using GapKey = std::tuple<std::size_t, bool, std::size_t, std::size_t>;
inline GapKey key_of(const Gap& gap, bool is_position) {
  return {gap.track, is_position, gap.first_frame, gap.last_frame};
}

/// Matches the rows of a plan with the gaps of a take.
class PlanRows {
 public:
  /// `models`: for rows with a learned method. With null, rows are read but cannot be run.
  explicit PlanRows(const Take& take, const FillModels* models = nullptr);

  /// Adds a row. Returns what is wrong with it; empty: nothing.
  std::string add(const PlannedGap& row);
  /// Returns the gap of a track of that name that no row has claimed yet, else the first claimed
  /// one, else nothing.
  std::optional<Gap> find(std::string_view name, bool is_position, std::size_t first_frame,
                          std::size_t last_frame) const;
  bool knows(std::string_view name) const;
  /// Returns the first five gaps, as the file counts frames: "12-20, 31-40".
  std::string gaps_of(std::string_view name, bool is_position) const;
  /// Returns the requests of the gaps that rows named.
  RequestOf request_of() const;
  std::string frames_text(const Gap& gap) const;

 private:
  const Take& take_;
  const FillModels* models_;
  const std::vector<std::string>& names_;
  std::int64_t first_number_;
  std::map<GapKey, std::optional<GapRequest>> requests_;
};

}  // namespace kinemend::fill
