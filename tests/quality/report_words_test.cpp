// Tests that a report describes the result.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "quality/quality.hpp"

namespace kinemend::quality {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

Take take_at_60_hz(const char* motion, double duration_s) {
  return synthesize({.motion = motion, .duration_s = duration_s, .frame_rate_hz = 60});
}

TEST(ReportWords, NoiseAloneLosesNoPeakOfSpeed) {
  for (const char* motion : {"wave", "walk", "turn", "stroll"}) {
    for (const double noise_deg : {0.5, 3.0}) {
      const Take noisy = damaged(take_at_60_hz(motion, 20), noise_deg, 0, 11);
      EXPECT_THAT(clean_take(noisy, *make_cleaner("auto")).report.warnings, IsEmpty())
          << motion << " " << noise_deg;
    }
  }
}

TEST(ReportWords, NoiseIsTheMeasuredOneAtAnySensitivity) {
  const Take noisy = damaged(take_at_60_hz("walk", 3), 1.5, 0, 5);
  const CleanReport usual = clean_take(noisy, *make_cleaner("auto")).report;
  for (const double sensitivity : {0.0, 0.5, 3.0}) {
    const CleanReport other =
        clean_take(noisy, *make_cleaner("auto", {{"sensitivity", sensitivity}})).report;
    for (std::size_t j = 0; j < usual.tracks.size(); ++j)
      EXPECT_EQ(other.tracks[j].noise, usual.tracks[j].noise) << sensitivity;
  }
}

TEST(ReportWords, SmoothingThatIsFarMoreThanNoiseIsSaid) {
  Take clip = damaged(take_at_60_hz("walk", 3), 1.5, 0, 5);
  const auto elbow = static_cast<std::size_t>(clip.skeleton.find("LeftForeArm"));
  clip.rotation(90, elbow) = clip.rotation(90, elbow) * exp({1.1, 0, 0});
  for (const char* method : {"gaussian", "butterworth", "weighted-mean"}) {
    EXPECT_THAT(clean_take(clip, *make_cleaner(method)).report.warnings,
                testing::Contains(testing::ContainsRegex(" deg at 1\\.50 s, (where its )?noise ")))
        << method;
  }
  for (const char* method : {"auto", "hampel"}) {
    const CleanReport report = clean_take(clip, *make_cleaner(method)).report;
    EXPECT_THAT(report.warnings, Each(Not(HasSubstr("smoothing changes")))) << method;
    EXPECT_GE(report.tracks[elbow].frames_repaired, 1u) << method;
  }
}

class FallBacks : public testing::TestWithParam<const char*> {};

// Where the general model cannot help, the result and its report are those of `auto`, and the
// report names each such track.
TEST_P(FallBacks, AreNamedAndReportedAsWhatTheyAre) {
  std::size_t fallen_back = 0;
  for (const char* motion : {"walk", "wave"}) {
    const Take noisy = damaged(take_at_60_hz(motion, 4), 1.5, 0.004, 3);
    const CleanResult other = clean_take(noisy, *make_cleaner("auto"));
    const CleanResult result = clean_take(noisy, *make_cleaner(GetParam()));
    std::map<std::int32_t, double> shares;
    for (const FallBack& fall_back : result.report.fall_backs) {
      EXPECT_EQ(fall_back.method, "auto");
      EXPECT_NE(fall_back.reason, "");
      ASSERT_EQ(fall_back.shares.size(), fall_back.tracks.size());
      for (std::size_t i = 0; i < fall_back.tracks.size(); ++i)
        shares[fall_back.tracks[i]] += fall_back.shares[i];
    }
    for (std::size_t j = 0; j < noisy.joint_count(); ++j) {
      std::size_t equal = 0;
      for (std::size_t f = 0; f < noisy.frame_count(); ++f)
        equal += angle_between(result.take.rotation(f, j), other.take.rotation(f, j)) < 1e-6;
      const double share = shares[static_cast<std::int32_t>(j)];
      const bool is_changed = other.report.tracks[j].frames_changed > 0;
      EXPECT_LE(share, 1 + 1e-9);
      if (share > 1 - 1e-9) {
        ++fallen_back;
        EXPECT_EQ(equal, noisy.frame_count()) << noisy.skeleton.names[j];
        EXPECT_EQ(result.report.tracks[j].frames_repaired, other.report.tracks[j].frames_repaired);
      } else if (is_changed && share < 0.9) {
        EXPECT_LT(equal, noisy.frame_count()) << noisy.skeleton.names[j];
      }
    }
  }
  EXPECT_GT(fallen_back, 0u);  // finger joints, which no shipped model knows
}

#if !defined(KINEMEND_SANITIZED)
INSTANTIATE_TEST_SUITE_P(Learned, FallBacks, testing::Values("example", "wiener"));
#else
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(FallBacks);
#endif

TEST(FallBack, IsNoneOfAMethodThatDoesWhatItSays) {
  const Take noisy = damaged(take_at_60_hz("walk", 2), 1.5, 0.004, 3);
  for (const Method& method : methods()) {
    if (method.learned) continue;
    EXPECT_THAT(clean_take(noisy, *make_cleaner(method.name)).report.fall_backs, IsEmpty())
        << method.name;
  }
}

}  // namespace
}  // namespace kinemend::quality
