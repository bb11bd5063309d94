// Compares each run with the frequency of flags on its track and on the others.
#include "check/runs.hpp"

#include <algorithm>
#include <cstdint>

#include "base/portable.hpp"

namespace kinemend::check {

namespace {

struct Counts {
  std::size_t yes = 0;
  std::size_t known = 0;

  void add(Flag flag) {
    yes += flag == Flag::yes;
    known += flag != Flag::unknown;
  }
};

// Laplace's rule of succession, which never gives a share of 0 or 1.
double share_without(const Counts& all, const Counts& subset) {
  return (static_cast<double>(all.yes - subset.yes) + 1) /
         (static_cast<double>(all.known - subset.known) + 2);
}

}  // namespace

std::vector<std::vector<FrameSpan>> improbable_runs(const FlagTable& table, std::size_t shortest) {
  // Natural logarithm of the chance in docs/check.md, 1e-6. Chosen by hand, not swept.
  constexpr double log_chance = -13.8;  // 1e-6
  std::vector<Counts> of_step(table.steps), of_track(table.tracks);
  std::vector<std::uint8_t> is_witness(table.tracks);
  for (std::size_t n = 0; n < table.tracks; ++n) {
    for (std::size_t t = 0; t < table.steps; ++t) of_track[n].add(table(t, n));
    // A track that is flagged in most frames does not localise an event.
    is_witness[n] = 2 * of_track[n].yes < of_track[n].known;
    for (std::size_t t = 0; is_witness[n] != 0 && t < table.steps; ++t) of_step[t].add(table(t, n));
  }
  const auto is_improbable = [&](std::size_t track, const FrameSpan& run) {
    const Counts inside{run.length(), run.length()};
    if (is_witness[track] == 0) return false;
    double others = 0;
    for (std::size_t t = run.first; t <= run.last; ++t) {
      if (of_step[t].known > 1)
        others +=
            static_cast<double>(of_step[t].yes - 1) / static_cast<double>(of_step[t].known - 1);
    }
    others /= static_cast<double>(run.length());
    const double share = std::max(share_without(of_track[track], inside), others);
    return share < 0.5 && static_cast<double>(run.length()) * portable::log(share) < log_chance;
  };
  std::vector<std::vector<FrameSpan>> runs(table.tracks);
  for (std::size_t n = 0; n < table.tracks; ++n) {
    const auto is_yes = [&](std::size_t t) { return table(t, n) == Flag::yes; };
    for (const FrameSpan& run : runs_where(table.steps, is_yes)) {
      if (run.length() >= shortest && is_improbable(n, run)) runs[n].push_back(run);
    }
  }
  return runs;
}

}  // namespace kinemend::check
