// The default method on real takes: it reaches the figures of its users' best scripts and leaves
// clean takes alone.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "kinemend/extend/method_options.hpp"
#include "kinemend/lab/train.hpp"
#include "quality/quality.hpp"
#include "quality/real_takes.hpp"

namespace kinemend::quality {
namespace {

struct Gate {
  const char* clip;
  double rms;
  double p99;
};

// A method's result at its defaults. `kalman-learned`, which ships without a model, uses one of
// other takes, mostly of the same motions.
Take cleaned_by_default(const Take& clip, const Method& method) {
  if (method.name != "kalman-learned") return cleaned(clip, method.name);
  static const auto model = std::make_shared<const Model>(train_model(
      method.name, {7, [](std::size_t i) {
                      constexpr const char* names[] = {"35_02", "02_02", "09_01", "16_35",
                                                       "02_06", "02_07", "02_08"};
                      return Take(real_clip(names[i]));
                    }}));
  return clean_take(clip, *make_kalman_learned({}, model)).take;
}

class AutoOnRealTakes : public testing::TestWithParam<Gate> {};

TEST_P(AutoOnRealTakes, ReachesTheGateOnEverySeed) {
  const Take truth = real_clip(GetParam().clip);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Take noisy = damaged(truth, 1.5, 0.004, seed);
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
  const Take truth = real_clip(GetParam().clip);
  for (const double noise_deg : {0.5, 1.5, 3.0}) {
    const Take noisy = damaged(truth, noise_deg, 0.004, 11);
    const double ours = figures(truth, cleaned(noisy, "auto")).rms;
    for (const auto& filter : fixed_filters()) {
      const double theirs = figures(truth, cleaned(noisy, filter.first, filter.second)).rms;
      EXPECT_LT(ours, theirs) << describe(filter) << " at " << noise_deg << " degrees";
    }
  }
}

TEST_P(AutoOnRealTakes, AndEveryOtherMethodBeatsTheDamageByItsMargin) {
  const Take truth = real_clip(GetParam().clip);
  const Take noisy = damaged(truth, 1.5, 0, 21), spiked = damaged(truth, 0, 0.01, 21);
  // Share of the damage that may remain: white noise, or spikes for methods that detect them. The
  // network of `recurrent` is trained on noise in proportion to each channel's motion.
  const std::map<std::string, double, std::less<>> of_noise{
      {"auto", 0.45},       {"bilateral", 0.85}, {"nonlocal", 0.75},      {"gaussian", 0.75},
      {"butterworth", 0.8}, {"wavelet", 0.7},    {"weighted-mean", 0.75}, {"kalman", 0.8},
      {"one-euro", 0.95},   {"example", 0.5},    {"wiener", 0.45},        {"kalman-learned", 0.6},
      {"sparse", 0.55},     {"recurrent", 0.9},  {"learned", 0.5}};
  const std::map<std::string, double, std::less<>> of_spikes{
      {"median", 0.5},  {"hampel", 0.5},     {"auto", 0.35},   {"example", 0.35},
      {"wiener", 0.35}, {"recurrent", 0.35}, {"learned", 0.35}};
  for (const Method& method : methods()) {
    const auto noise_left = of_noise.find(method.name), spikes_left = of_spikes.find(method.name);
    EXPECT_TRUE(noise_left != of_noise.end() || spikes_left != of_spikes.end()) << method.name;
    if (noise_left != of_noise.end()) {
      EXPECT_LT(figures(truth, cleaned_by_default(noisy, method)).rms,
                noise_left->second * figures(truth, noisy).rms)
          << method.name;
    }
    if (spikes_left != of_spikes.end()) {
      EXPECT_LT(figures(truth, cleaned_by_default(spiked, method)).rms,
                spikes_left->second * figures(truth, spiked).rms)
          << method.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Gates, AutoOnRealTakes,
                         testing::Values(Gate{"35_01", 1.15, 3.3}, Gate{"02_05", 0.80, 2.0},
                                         Gate{"09_03", 1.10, 3.0}),
                         [](const auto& gate) { return "Take" + std::string(gate.param.clip); });

// Impulses of one size on otherwise clean takes: real motion is not taken for an impulse.
TEST(AutoOnImpulses, ReachesSixtyFiveDecibels) {
  for (const char* name : {"09_03", "02_05", "01_01"}) {
    const Take truth = real_clip(name);
    Take clip = truth;
    Random random(2016);
    apply_damage(clip, "impulse", {}, random);
    EXPECT_GT(psnr_db(truth, cleaned(clip, "auto")), 65) << name;
  }
}

class AutoOnCleanTakes : public testing::TestWithParam<const char*> {};

TEST_P(AutoOnCleanTakes, ChangesLessThanATwentiethOfADegree) {
  const Take clip = real_clip(GetParam());
  EXPECT_LT(geodesic_rms_deg(clip, cleaned(clip, "auto")), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutoOnCleanTakes,
                         testing::Values("35_01", "35_17", "16_15", "16_35", "02_01", "02_05",
                                         "09_03", "13_11", "05_02", "05_05", "05_06", "01_04",
                                         "16_02", "16_33", "08_10", "49_01", "82_04", "131_05"),
                         [](const auto& clip) { return "Take" + std::string(clip.param); });

// Captures in which a thumb flips by half a turn for a frame or two. The flipped samples are not
// motion, and no other sample changes.
class AutoOnTakesWithFlips : public testing::TestWithParam<const char*> {};

TEST_P(AutoOnTakesWithFlips, RepairsTheFlipsAndNothingElse) {
  const Take clip = real_clip(GetParam());
  const Take result = cleaned(clip, "auto");
  std::size_t repaired = 0;
  for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
    const double change =
        degrees_per_radian * angle_between(clip.rotations[i], result.rotations[i]);
    if (change == 0) continue;
    EXPECT_GT(change, 60) << "joint " << clip.skeleton.names[i % clip.joint_count()] << ", frame "
                          << i / clip.joint_count();
    ++repaired;
  }
  EXPECT_GE(repaired, 1U);
  EXPECT_LE(repaired, 4U);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AutoOnTakesWithFlips, testing::Values("06_13", "60_03", "91_49"),
                         [](const auto& clip) { return "Take" + std::string(clip.param); });

}  // namespace
}  // namespace kinemend::quality
