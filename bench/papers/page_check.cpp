// Figures of docs/check.md: labels of markers exchanged at random, and found.

#include "check/marker_support.hpp"
#include "experiment.hpp"
#include "kinemend/check.hpp"

namespace kinemend::papers {
namespace {

void experiment(const Arguments& arguments) {
  Table table(arguments, "page_swaps.csv", "take,pairs,to_the_frame,others,as_it_is");
  for (const char* file : {"85_02.c3d", "85_12.c3d", "05_13.c3d", "S02-Trial-Walk-1-vicon.c3d"}) {
    const auto path = find_take(arguments.data, file);
    const Take clean = path ? read_take(*path).take : test::synthetic_markers("walk");
    test::Tally tally;
    // Two centimetres apart: the files are in millimetres, the synthetic markers in centimetres.
    for (std::uint64_t seed = 1; seed <= (arguments.quick ? 2 : 10); ++seed) {
      const auto trial = test::with_random_swaps(clean, 8, path ? 20 : 2, seed);
      tally.add(trial.swaps, find_swaps(trial.clip));
    }
    table.add({std::filesystem::path(file).stem().string(), fmt::format("{}", tally.put_in),
               fmt::format("{}", tally.right), fmt::format("{}", tally.found - tally.right),
               fmt::format("{}", find_swaps(clean).size())});
    if (arguments.quick) break;
  }
  table.close();
}

const Registration registration("page_check", experiment);

}  // namespace
}  // namespace kinemend::papers
