// Tests of gaps of markers: each method on a take that it fills exactly, and the choice of `auto`.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "fill/marker_takes.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/fill.hpp"

namespace kinemend::fill {
namespace {

using testing::HasSubstr;

double largest_error(const Take& truth, const Take& filled) {
  double largest = 0;
  for (std::size_t i = 0; i < truth.positions.size(); ++i) {
    if (filled.observed[i]) {
      largest = std::max(largest, norm(filled.positions[i] - truth.positions[i]));
    }
  }
  return largest;
}

TEST(RigidBodyFill, IsExactOnARigidCluster) {
  // The thigh's three markers, and one of the hips' that is also fixed to the thigh.
  const Take walk = marker_take();
  Take truth = walk;
  const auto a = static_cast<std::size_t>(walk.find("LeftUpLeg_a"));
  const auto fourth = static_cast<std::size_t>(walk.find("Hips_a"));
  for (std::size_t f = 0; f < walk.frame_count(); ++f) {
    const Vec3 p = walk.position(f, a), q = walk.position(f, a + 1), r = walk.position(f, a + 2);
    truth.position(f, fourth) = p + 0.7 * (q - p) - 0.4 * (r - p) + 0.05 * cross(q - p, r - p);
  }
  Take clip = truth;
  hide(clip, "Hips_a", 150, 400);
  const FillReport report = fill_with(clip, "rigid-body");
  EXPECT_EQ(report.filled(), 1U);
  EXPECT_LT(largest_error(truth, clip), 1e-4);
}

TEST(PatternFill, IsExactForADonorAtAConstantOffset) {
  Take truth = marker_take();
  const auto donor = static_cast<std::size_t>(truth.find("Head_a"));
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    truth.position(f, donor + 1) = truth.position(f, donor) + Vec3{3, -7, 2};
  }
  Take clip = truth;
  hide(clip, "Head_b", 100, 300);
  FillSettings settings;
  settings.method = "pattern";
  settings.donor = "Head_a";
  EXPECT_EQ(fill_gaps(clip, settings).filled(), 1U);
  EXPECT_LT(largest_error(truth, clip), 1e-9);
}

TEST(PcaFill, IsExactWhereTheMovementHasFewComponents) {
  // Twelve markers whose coordinates are mixtures of four waves.
  const std::size_t frames = 600;
  std::vector<std::string> names;
  for (int m = 0; m < 12; ++m) names.push_back(fmt::format("m{}", m));
  Take truth = make_marker_take(names, frames, 100);
  truth.observed.assign(truth.positions.size(), 1);
  Random random(3);
  for (std::size_t m = 0; m < 12; ++m) {
    const Vec3 home{100 * random.normal(), 100 * random.normal(), 100 * random.normal()};
    Vec3 mixture[4];
    for (Vec3& part : mixture) part = {random.normal(), random.normal(), random.normal()};
    for (std::size_t f = 0; f < frames; ++f) {
      Vec3 p = home;
      for (int k = 0; k < 4; ++k) {
        p += 20 * std::sin(0.017 * (1 + 0.37 * k) * static_cast<double>(f) + k) * mixture[k];
      }
      truth.position(f, m) = p;
    }
  }
  Take clip = truth;
  hide(clip, "m4", 250, 400);
  EXPECT_EQ(fill_with(clip, "pca").filled(), 1U);
  EXPECT_LT(largest_error(truth, clip), 1e-5);
}

TEST(CyclicFill, FindsTheSamePhaseOfOtherSteps) {
  const Take truth = marker_take("walk", 8);
  Take clip = truth;
  hide(clip, "LeftFoot_a", 400, 460);
  const FillReport report = fill_with(clip, "cyclic");
  ASSERT_EQ(report.filled(), 1U) << report.gaps[0].reason;
  EXPECT_LT(mean_error(truth, clip, report), 2.0);
}

TEST(LocalRegressionFill, FollowsALimbWhoseOwnMarkersBend) {
  const Take truth = marker_take("walk", 8);
  Take clip = truth;
  hide(clip, "LeftLeg_a", 300, 420);
  hide(clip, "LeftLeg_b", 300, 420);
  const FillReport report = fill_with(clip, "local-regression");
  EXPECT_EQ(report.filled(), 2U);
  EXPECT_LT(mean_error(truth, clip, report), 0.8);
}

TEST(AutoFill, ExpectsAboutTheErrorThatItMakes) {
  const Take truth = marker_take("stroll", 12);
  Take clip = truth;
  for (const char* name : {"LeftFoot_b", "RightForeArm_a", "Head_c", "Spine1_a", "RightLeg_b"}) {
    hide(clip, name, 500, 620);
    hide(clip, name, 900, 930);
  }
  const FillReport report = fill_with(clip, "auto");
  ASSERT_EQ(report.filled(), 10U);
  double expected = 0;
  for (const GapOutcome& outcome : report.gaps) {
    EXPECT_GT(outcome.expected_error, 0);
    expected += outcome.expected_error / 10;
  }
  const double error = mean_error(truth, clip, report);
  EXPECT_LT(error, 1.0);
  EXPECT_LT(error, 3 * expected + 0.01);
  EXPECT_GT(error, expected / 20);
}

TEST(AutoFill, PrefersACurveWhereNoOtherMarkerIsSeen) {
  Take clip = marker_take();
  hide(clip, "*", 300, 306);
  const FillReport report = fill_with(clip, "auto");
  EXPECT_EQ(report.refused(), 0U);
  for (const GapOutcome& outcome : report.gaps) EXPECT_EQ(outcome.method, "spline");
}

// The companions do not predict the marker, and the gaps are longer than those in which a spline is
// tried first.
TEST(AutoFill, TriesASplineAlsoInGapsOfAFifthOfASecond) {
  Take truth = marker_take("walk", 6);
  const auto marker = static_cast<std::size_t>(truth.find("Head_b"));
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    const double turn = 2 * pi * 0.9 * static_cast<double>(f) / truth.frame_rate_hz;
    truth.position(f, marker) += Vec3{12 * std::sin(turn), 9 * std::cos(1.3 * turn), 0};
  }
  Take clip = truth, splined;
  for (const std::size_t first : {150U, 330U, 520U}) hide(clip, "Head_b", first, first + 23);
  splined = clip;
  const FillReport report = fill_with(clip, "auto");
  ASSERT_EQ(report.filled(), 3U);
  const FillReport by_spline = fill_with(splined, "spline", true);
  for (const GapOutcome& outcome : report.gaps) EXPECT_EQ(outcome.method, "spline");
  EXPECT_LT(mean_error(truth, clip, report), 2 * mean_error(truth, splined, by_spline) + 0.01);
}

TEST(AutoFill, RefusesALongSpanWithoutAnyMarkerAndSaysSo) {
  Take clip = marker_take("punch");
  const Take before = [&] {
    hide(clip, "*", 200, 350);
    return clip;
  }();
  const FillReport report = fill_with(clip, "auto");
  EXPECT_EQ(report.filled() + report.refused(), clip.marker_count());
  EXPECT_GT(report.refused(), clip.marker_count() / 2);
  for (const GapOutcome& outcome : report.gaps) {
    if (outcome.filled) continue;
    EXPECT_THAT(outcome.reason, HasSubstr("fewer than three other markers"));
    EXPECT_FALSE(clip.is_observed(250, outcome.gap.track));
    EXPECT_EQ(clip.position(250, outcome.gap.track), Vec3{});
  }
  Take forced = before;
  EXPECT_EQ(fill_with(forced, "auto", true).refused(), 0U);
}

TEST(AutoFill, FillsWhatAnEarlierRoundMadePossible) {
  // Only two other markers are observed throughout the long gap; the others are missing one at a
  // time.
  Take clip = marker_take();
  const Take truth = clip;
  for (std::size_t m = 0; m + 2 < clip.marker_count(); ++m) {
    hide(clip, clip.names[m], 200 + 5 * m, 205 + 5 * m);
  }
  hide(clip, "RightForeArm_b", 195, 420);
  const FillReport report = fill_with(clip, "auto");
  EXPECT_EQ(report.refused(), 0U);
  EXPECT_LT(mean_error(truth, clip, report), 1.0);
}

TEST(AutoFill, FillsToTheEndOfTheTakeWhereOthersAreSeen) {
  const Take truth = marker_take();
  Take clip = truth;
  hide(clip, "LeftFoot_a", 0, 60);
  hide(clip, "LeftFoot_b", 520, truth.frame_count() - 1);
  const FillReport report = fill_with(clip, "auto");
  EXPECT_EQ(report.refused(), 0U);
  EXPECT_LT(mean_error(truth, clip, report), 0.5);
}

TEST(SplineFill, RefusesWhatIsLongOrOpenAndSaysWhy) {
  Take clip = marker_take();
  hide(clip, "Head_a", 100, 140);
  hide(clip, "Head_b", 0, 5);
  hide(clip, "Head_c", 100, 110);
  FillReport report = fill_with(clip, "spline");
  ASSERT_EQ(report.gaps.size(), 3U);
  EXPECT_THAT(report.gaps[0].reason, HasSubstr("longer than 0.25 s"));
  EXPECT_THAT(report.gaps[1].reason, HasSubstr("end of the take"));
  EXPECT_TRUE(report.gaps[2].filled);
  FillSettings settings;
  settings.method = "spline";
  settings.longest_gap_s = 0.5;
  report = fill_gaps(clip, settings);
  EXPECT_EQ(report.filled(), 1U);
}

TEST(MarkerFill, RefusesGapsLongerThanAsked) {
  Take clip = marker_take("walk", 2);
  hide(clip, "Head_a", 100, 171);
  FillSettings settings;
  settings.longest_gap_s = 0.5;
  EXPECT_EQ(fill_gaps(clip, settings).gaps[0].reason, "the gap of 0.60 s is longer than 0.50 s");
}

TEST(MarkerFill, TakesTheBestGuessWhereAllIsAskedForAndTheMethodHasNone) {
  Take clip = marker_take("punch", 3);
  hide(clip, "Head_a", 100, 180);
  Take other = clip;
  EXPECT_EQ(fill_with(clip, "cyclic").refused(), 1U);
  const FillReport report = fill_with(other, "cyclic", true);
  ASSERT_EQ(report.filled(), 1U);
}

TEST(MarkerFill, LeavesWhatIsNoPositionAlone) {
  Take clip = marker_take();
  const auto angle = static_cast<std::size_t>(clip.find("Head_a"));
  clip.is_position[angle] = 0;
  hide(clip, "Head_a", 100, 110);
  hide(clip, "Head_b", 100, 110);
  const FillReport report = fill_with(clip, "auto");
  ASSERT_EQ(report.gaps.size(), 1U);
  EXPECT_FALSE(clip.is_observed(105, angle));
}

// Takes with little evidence for a filling.
class MeagreTakes : public testing::TestWithParam<std::string> {
 protected:
  static FillSettings settings() {
    FillSettings settings;
    settings.method = GetParam();
    if (GetParam() == "pattern") settings.donor = "m0";
    return settings;
  }
  static Take take(std::size_t markers, std::size_t frames) {
    std::vector<std::string> names;
    for (std::size_t m = 0; m < markers; ++m) names.push_back(fmt::format("m{}", m));
    Take clip = make_marker_take(names, frames, 100);
    clip.observed.assign(clip.positions.size(), 1);
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
      const auto x = static_cast<double>(i);
      clip.positions[i] = {std::sin(0.1 * x), x, std::cos(0.37 * x)};
    }
    return clip;
  }
  // Fills with and without rules; every result is finite, and unfilled samples stay missing.
  static void check(const Take& damaged) {
    for (const bool fill_all : {false, true}) {
      Take clip = damaged;
      FillSettings chosen = settings();
      chosen.fill_all = fill_all;
      const FillReport report = fill_gaps(clip, chosen);
      clip.validate();
      for (const GapOutcome& outcome : report.gaps) {
        EXPECT_EQ(outcome.reason.empty(), outcome.filled);
        for (std::size_t f = outcome.gap.first_frame; f <= outcome.gap.last_frame; ++f) {
          EXPECT_EQ(clip.is_observed(f, outcome.gap.track), outcome.filled);
        }
      }
    }
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, MeagreTakes,
                         testing::Values("auto", "spline", "quintic", "pchip", "hermite", "pattern",
                                         "rigid-body", "pca", "local-regression", "cyclic"),
                         [](const auto& method) {
                           std::string name = method.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST_P(MeagreTakes, AreFilledOrRefusedWithoutHarm) {
  for (const std::size_t markers : {1U, 2U, 3U, 4U, 7U}) {
    for (const std::size_t frames : {1U, 2U, 3U, 10U, 60U}) {
      Take whole = take(markers, frames);
      SCOPED_TRACE(fmt::format("{} markers, {} frames", markers, frames));
      check(whole);
      Take clip = whole;
      hide(clip, "m0", 0, 0);
      check(clip);
      clip = whole;
      hide(clip, "m0", frames - 1, frames - 1);
      check(clip);
      clip = whole;
      hide(clip, "m0", 0, frames - 1);  // never observed
      check(clip);
      clip = whole;
      hide(clip, "*", frames / 3, frames / 2);
      check(clip);
      clip = whole;
      hide(clip, "*", 0, frames - 1);
      check(clip);
      clip = whole;
      for (std::size_t f = 0; f < frames; f += 2) hide(clip, "m0", f, f);
      check(clip);
    }
  }
}

TEST_P(MeagreTakes, MayHaveMarkersOnOneLineOrInOnePlace) {
  for (const double spread : {0.0, 1.0}) {
    Take clip = take(6, 80);
    for (std::size_t f = 0; f < 80; ++f) {
      for (std::size_t m = 0; m < 6; ++m) {
        clip.position(f, m) = {0.3 * static_cast<double>(f), spread * static_cast<double>(m), 0};
      }
    }
    hide(clip, "m2", 30, 37);
    check(clip);
    hide(clip, "m3", 33, 60);
    check(clip);
  }
}

TEST(MarkerFill, ReturnsAnEmptyTakeAsItIs) {
  Take clip = make_marker_take({}, 0, 100);
  EXPECT_TRUE(fill_with(clip, "auto").gaps.empty());
  clip = make_marker_take({"a"}, 0, 100);
  EXPECT_TRUE(fill_with(clip, "auto").gaps.empty());
}

}  // namespace
}  // namespace kinemend::fill
