// Properties of every method on takes of a few frames.
#include <gtest/gtest.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

constexpr std::size_t most_frames = 8;
// A causal method lags and may be further behind a runner's foot.
constexpr double bound_ahead_mm = 10, causal_bound_mm = 25;

Take first_frames(Take take, std::size_t frames) {
  take.rotations.resize(frames * take.joint_count());
  take.positions.resize(frames * (take.has_joints() ? take.point_count() : take.marker_count()));
  if (!take.observed.empty()) take.observed.resize(frames * take.marker_count());
  return take;
}

double largest_turn_deg(const Cleaner& cleaner, const Take& take) {
  Take cleaned = take;
  clean_in_place(cleaner, cleaned);
  return max_angle_deg(cleaned, take);
}

double largest_shift(const Cleaner& cleaner, const Take& take) {
  Take cleaned = take;
  clean_in_place(cleaner, cleaned);
  double largest = 0;
  for (std::size_t i = 0; i < take.positions.size(); ++i)
    largest = std::max(largest, norm(cleaned.positions[i] - take.positions[i]));
  return largest;
}

Take running_joints() {
  SynthOptions options;
  options.motion = "run";
  options.duration_s = 0.3;
  return synthesize(options);
}

// Methods with a shipped model are included; those for joints only refuse markers.
std::vector<std::string> methods_that_need_no_file() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    if (method.name != "kalman-learned") names.push_back(method.name);
  }
  return names;
}

class EveryOnShortTakes : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Cleaner> cleaner_ = make_cleaner(GetParam());
  double bound_mm_ = runs_without_delay(*cleaner_) ? causal_bound_mm : bound_ahead_mm;
};

TEST_P(EveryOnShortTakes, LeavesSmoothMarkersNearlyAsTheyWere) {
  const Take whole = marker_take("run", 0.3);
  for (std::size_t frames = 1; frames <= most_frames; ++frames) {
    const Take take = first_frames(whole, frames);
    try {
      EXPECT_LT(largest_shift(*cleaner_, take), bound_mm_) << frames;
    } catch (const Error&) {
      EXPECT_TRUE(find_method(GetParam()).learned) << "only models refuse markers";
    }
  }
}

TEST_P(EveryOnShortTakes, LeavesSmoothJointsNearlyAsTheyWere) {
  const Take whole = running_joints();
  for (std::size_t frames = 1; frames <= most_frames; ++frames) {
    const Take take = first_frames(whole, frames);
    EXPECT_LT(largest_turn_deg(*cleaner_, take), 2.5) << frames;
    EXPECT_LT(10 * largest_shift(*cleaner_, take), bound_mm_) << frames;
  }
}

// A marker seen for a few frames between long gaps is a short take by itself.
TEST_P(EveryOnShortTakes, LeavesMarkersThatAreSeenForAFewFramesNearlyAsTheyWere) {
  if (find_method(GetParam()).learned) GTEST_SKIP() << "models clean whole markers";
  Take take = marker_take("run", 1);
  lose(take, 0, 0, 49), lose(take, 0, 54, take.frame_count() - 1);
  lose(take, 1, 0, 79), lose(take, 1, 82, take.frame_count() - 1);
  Take cleaned = take;
  clean_in_place(*cleaner_, cleaned);
  for (const std::size_t f : {50, 51, 52, 53, 80, 81}) {
    const std::size_t marker = f < 60 ? 0 : 1;
    EXPECT_LT(norm(cleaned.position(f, marker) - take.position(f, marker)), bound_mm_) << f;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryOnShortTakes, testing::ValuesIn(methods_that_need_no_file()),
                         test_name_of);

}  // namespace
}  // namespace kinemend::test
