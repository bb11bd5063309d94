// Finds runs of flagged frames, and those that chance does not explain.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "check/checks.hpp"

namespace kinemend::check {

/// Returns the runs of frames for which `holds` is true.
template <class Holds>
std::vector<FrameSpan> runs_where(std::size_t frames, const Holds& holds) {
  std::vector<FrameSpan> runs;
  for (std::size_t t = 0; t < frames; ++t) {
    if (!holds(t)) continue;
    if (!runs.empty() && runs.back().last + 1 == t) {
      runs.back().last = t;
    } else {
      runs.push_back({t, t});
    }
  }
  return runs;
}

/// One flag for each step of each of N tracks, from the track's samples.
enum class Flag : std::uint8_t {
  no,
  yes,
  unknown,  ///< a sample is missing, or the track is excluded
};

struct FlagTable {
  std::size_t steps = 0;
  std::size_t tracks = 0;
  std::vector<Flag> flags;  ///< track by track

  FlagTable(std::size_t step_count, std::size_t track_count)
      : steps(step_count), tracks(track_count), flags(step_count * track_count, Flag::unknown) {}
  Flag& operator()(std::size_t step, std::size_t track) { return flags[track * steps + step]; }
  Flag operator()(std::size_t step, std::size_t track) const { return flags[track * steps + step]; }
};

/// Returns the runs of `yes`, at least `shortest` long, that chance does not explain: a run of r
/// for which p^r is below 1e-6, where p is the share of `yes` on the track outside the run, or
/// among the other tracks during the run if that is more. Runs that other tracks share (p of a half
/// or more) are not specific to one track. One list for each track.
std::vector<std::vector<FrameSpan>> improbable_runs(const FlagTable& table, std::size_t shortest);

}  // namespace kinemend::check
