// What is asked for one gap, by the settings of a run or by a row of a plan.
#pragma once

#include <cstddef>
#include <optional>

#include "fill/filling.hpp"
#include "fill/marker_methods.hpp"
#include "fill/methods.hpp"

namespace kinemend::fill {

/// What is asked for one gap, by the settings of a run or by a row of a plan.
struct GapRequest {
  const Method* method = nullptr;
  std::size_t donor = MarkerRequest::no_marker;  ///< of `pattern`
  double longest_gap_s = 0;                      ///< 0: what the method's rules say
  bool fill_all = false;                         ///< also what the rules refuse
  double max_error = 0, max_error_deg = 0;       ///< as `FillSettings`; 0: no limit
  bool unlabelled = false;                       ///< such markers are evidence
  std::optional<Filling> refusal = {};           ///< where the gap is to stay, whatever fills it
  const LearnedFill* learned = nullptr;          ///< of a learned method

  MarkerRequest of_marker() const { return {donor, longest_gap_s, fill_all}; }
};

}  // namespace kinemend::fill
