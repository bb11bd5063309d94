// The request for one gap, from the settings of a run or a row of a plan.
#pragma once

#include <cstddef>
#include <optional>

#include "fill/filling.hpp"
#include "fill/marker_methods.hpp"
#include "fill/methods.hpp"

namespace kinemend::fill {

/// The request for one gap, from the settings of a run or a row of a plan.
struct GapRequest {
  const Method* method = nullptr;
  std::size_t donor = MarkerRequest::no_marker;  ///< used by `pattern`
  double longest_gap_s = 0;                      ///< 0: the limit of the method's rules
  bool fill_all = false;                         ///< also fills gaps that the rules refuse
  double max_error = 0, max_error_deg = 0;       ///< as `FillSettings`; 0: no limit
  bool unlabelled = false;                       ///< unlabelled markers are evidence
  std::optional<Filling> refusal = {};   ///< set if the gap must stay open, whatever the method
  const LearnedFill* learned = nullptr;  ///< for a learned method

  MarkerRequest of_marker() const { return {donor, longest_gap_s, fill_all}; }
};

}  // namespace kinemend::fill
