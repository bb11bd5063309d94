// The default method on real takes: the figures that the best scripts of its users reach, and the
// promise to leave clean takes alone.
#include <gtest/gtest.h>

#include <filesystem>

#include "kinemend/io.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {
namespace {

namespace fs = std::filesystem;

Clip real_clip(const std::string& name) {
  for (const char* folder : {"cmu/bvh", "cmu/bvh-rotations"}) {
    const fs::path path = fs::path(KINEMEND_DATA_FOLDER) / folder / (name + ".bvh");
    if (fs::exists(path)) return without_calibration(read_clip(path).clip);
  }
  throw Error(ErrorKind::unreadable_input, "no real take " + name);
}

struct Gate {
  const char* clip;
  double rms;
  double p99;
};

class AutoOnRealTakes : public testing::TestWithParam<Gate> {};

TEST_P(AutoOnRealTakes, ReachesTheGateOnEverySeed) {
  const Clip truth = real_clip(GetParam().clip);
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Clip noisy = damaged(truth, 1.5, 0.004, seed);
    const Figures before = figures(truth, noisy);
    const Figures after = figures(truth, cleaned(noisy, "auto"));
    EXPECT_GT(before.rms, 3.0) << "the damage is that of the gate";
    EXPECT_LT(after.rms, GetParam().rms) << "seed " << seed << ", before " << before.rms;
    EXPECT_LT(after.p99, GetParam().p99) << "seed " << seed << ", before " << before.p99;
    RecordProperty("seed" + std::to_string(seed),
                   std::to_string(after.rms) + "/" + std::to_string(after.p99));
  }
}

TEST_P(AutoOnRealTakes, BeatsEveryFilterWithFixedParameters) {
  const Clip truth = real_clip(GetParam().clip);
  for (const double noise_deg : {0.5, 1.5, 3.0}) {
    const Clip noisy = damaged(truth, noise_deg, 0.004, 11);
    const double ours = figures(truth, cleaned(noisy, "auto")).rms;
    for (const auto& filter : fixed_filters()) {
      const double theirs = figures(truth, cleaned(noisy, filter.first, filter.second)).rms;
      EXPECT_LT(ours, theirs) << describe(filter) << " at " << noise_deg << " degrees";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Gates, AutoOnRealTakes,
                         testing::Values(Gate{"35_01", 1.15, 3.3}, Gate{"02_05", 0.80, 2.0},
                                         Gate{"09_03", 1.10, 3.0}),
                         [](const auto& gate) { return "Clip" + std::string(gate.param.clip); });

class AutoOnCleanTakes : public testing::TestWithParam<const char*> {};

TEST_P(AutoOnCleanTakes, ChangesLessThanATwentiethOfADegree) {
  const Clip clip = real_clip(GetParam());
  EXPECT_LT(geodesic_rms_deg(clip, cleaned(clip, "auto")), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutoOnCleanTakes,
                         testing::Values("35_01", "35_17", "16_15", "16_35", "02_01", "02_05",
                                         "09_03", "13_11", "05_05", "49_02", "49_06", "06_05",
                                         "10_01", "01_01", "16_01", "08_01", "14_01"),
                         [](const auto& clip) { return "Clip" + std::string(clip.param); });

}  // namespace
}  // namespace kinemend::quality
