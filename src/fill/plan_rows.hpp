// The gaps of a take, and what rows of a plan ask for them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "fill/driver.hpp"
#include "kinemend/experimental/gap_plan.hpp"
#include "kinemend/gaps.hpp"

namespace kinemend::fill {

/// What tells a gap of a take from its others.
using GapKey = std::tuple<std::size_t, bool, std::size_t, std::size_t>;
inline GapKey key_of(const Gap& gap, bool is_position) {
  return {gap.track, is_position, gap.first_frame, gap.last_frame};
}

/// The gaps of a take, and what rows of a plan ask for them.
class PlanRows {
 public:
  /// `models`: of rows with a learned method; null: they are read, not run.
  explicit PlanRows(const Take& take, const FillModels* models = nullptr);

  /// Takes a row up. Says what is wrong with it; empty: nothing.
  std::string add(const PlannedGap& row);
  /// The gap of a track of that name which no row has taken up yet, or the first of all; none
  /// where there is no such gap.
  std::optional<Gap> find(std::string_view name, bool is_position, std::size_t first_frame,
                          std::size_t last_frame) const;
  bool knows(std::string_view name) const;
  /// "12-20, 31-40", as the file counts frames; the first five.
  std::string gaps_of(std::string_view name, bool is_position) const;
  /// Of the gaps that rows named.
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
