// The shipped model on hold-outs of every kind of motion, and on dance and acrobatics, for which it
// was trained on little besides these takes. docs/methods/wiener.md has the figures for subjects
// outside its training.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "long_tests.hpp"
#include "quality/quality.hpp"
#include "quality/real_takes.hpp"

namespace kinemend::quality {
namespace {

struct Damaging {
  const char* name;
  double noise_deg;      // white noise; 0: half of each channel's own deviation, as in Mall et al.
  double outlier_share;  // outliers of 25 degrees
};
constexpr Damaging damagings[] = {{"1 deg", 1, 0}, {"4 deg and spikes", 4, 0.004}, {"half", 0, 0}};

Take damaged_by(const Damaging& damaging, const Take& truth) {
  if (damaging.noise_deg > 0) return damaged(truth, damaging.noise_deg, damaging.outlier_share, 3);
  Take clip = truth;
  Random random(3);
  apply_damage(clip, "gaussian-channels", {{"k", 0.5}}, random);
  return clip;
}

// The error of the Gaussian whose width is best for this take and noise.
double best_gaussian(const Take& noisy, const Take& truth) {
  double best = std::numeric_limits<double>::infinity();
  for (const double width_s :
       {0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045, 0.058, 0.08, 0.11, 0.16}) {
    const Take smooth = clean_take(noisy, *make_gaussian({.width_s = width_s})).take;
    best = std::min(best, rms_deg(truth, smooth));
  }
  return best;
}

struct Group {
  const char* name;
  std::vector<const char*> clips;
  double mean_limits[3];  // error relative to the best Gaussian, for each damage
  friend void PrintTo(const Group& group, std::ostream* out) { *out << group.name; }
};

class WienerOnRealTakes : public testing::TestWithParam<Group> {};

TEST_P(WienerOnRealTakes, NeverLosesToTheBestGaussian) {
  KINEMEND_LONG_TEST();
  const auto wiener = make_wiener();
  for (std::size_t d = 0; d < std::size(damagings); ++d) {
    double sum = 0;
    std::string text;
    for (const char* name : GetParam().clips) {
      const Take truth = real_clip(name), noisy = damaged_by(damagings[d], truth);
      const double theirs = best_gaussian(noisy, truth);
      const double ratio = rms_deg(truth, clean_take(noisy, *wiener).take) / theirs;
      const double by_auto = rms_deg(truth, cleaned(noisy, "auto")) / theirs;
      EXPECT_LT(ratio, 1.0) << name << ", " << damagings[d].name;
      text += fmt::format("{} {:.3f} (auto {:.3f}); ", name, ratio, by_auto);
      sum += ratio;
    }
    const double mean = sum / static_cast<double>(GetParam().clips.size());
    EXPECT_LT(mean, GetParam().mean_limits[d]) << damagings[d].name << ": " << text;
    RecordProperty(fmt::format("damage_{}", d), fmt::format("mean {:.3f}: {}", mean, text));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, WienerOnRealTakes,
    testing::Values(Group{"HoldOuts",
                          {"02_02", "35_02", "08_02", "16_35", "09_06", "127_07", "16_05", "49_04",
                           "10_01", "10_06", "127_10"},
                          {0.79, 0.79, 0.85}},
                    Group{"DanceAndAcrobatics",
                          {"05_03", "05_10", "05_11", "05_13", "49_07", "49_12", "49_15"},
                          {0.81, 0.78, 0.85}}),
    [](const auto& group) { return std::string(group.param.name); });

// Models do not know the noise of each system yet, so takes that `auto` finds clean stay unchanged.
class LearnedOnCleanTakes : public testing::TestWithParam<const char*> {};

TEST_P(LearnedOnCleanTakes, ChangesLessThanATwentiethOfADegree) {
  const Take clip = real_clip(GetParam());
  for (const char* method : {"wiener", "example"})
    EXPECT_LT(geodesic_rms_deg(clip, cleaned(clip, method)), 0.05) << method;
}

INSTANTIATE_TEST_SUITE_P(Kinds, LearnedOnCleanTakes,
                         testing::Values("35_01", "16_15", "02_01", "09_03", "05_02", "01_04",
                                         "49_01", "131_05"),
                         [](const auto& clip) { return "Take" + std::string(clip.param); });

}  // namespace
}  // namespace kinemend::quality
