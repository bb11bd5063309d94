// Label swaps injected into real takes of markers are found to the frame.
#include <gtest/gtest.h>

#include "check/marker_support.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {
namespace {

struct RealTake {
  const char* path;
  double least_distance;  // file units
};

std::ostream& operator<<(std::ostream& out, const RealTake& take) { return out << take.path; }

Take markers_of(const RealTake& take) {
  return read_take(std::filesystem::path(KINEMEND_DATA_FOLDER) / take.path).take;
}

class SwapsInRealTakes : public testing::TestWithParam<RealTake> {};

TEST_P(SwapsInRealTakes, AreNotSeenWhereThereAreNone) {
  EXPECT_EQ(find_swaps(markers_of(GetParam())).size(), 0u);
}

TEST_P(SwapsInRealTakes, AreFoundToTheFrameAndNothingElse) {
  const Take clean = markers_of(GetParam());
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const SwapTrial trial = with_random_swaps(clean, 8, GetParam().least_distance, seed);
    tally.add(trial.swaps, find_swaps(trial.clip));
  }
  RecordProperty("put_in", static_cast<int>(tally.put_in));
  RecordProperty("found", static_cast<int>(tally.found));
  EXPECT_GE(tally.put_in, 40u);
  EXPECT_EQ(tally.precision(), 1) << tally.found - tally.right << " of " << tally.found;
  EXPECT_GE(tally.recall(), 0.95) << tally.right << " of " << tally.put_in;
}

INSTANTIATE_TEST_SUITE_P(Takes, SwapsInRealTakes,
                         testing::Values(RealTake{"cmu/c3d/85_02.c3d", 20},
                                         RealTake{"cmu/c3d/85_12.c3d", 20},
                                         RealTake{"cmu/c3d/05_13.c3d", 20},
                                         RealTake{"paired/S02-Trial-Walk-1-vicon.c3d", 20}));

}  // namespace
}  // namespace kinemend::test
