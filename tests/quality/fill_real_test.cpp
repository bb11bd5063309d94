// Artificial gaps in real takes are filled within error bounds, and expected errors hold.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "fill/made_gaps.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/take.hpp"
#include "quality/gapped_markers.hpp"

namespace kinemend::quality {
namespace {

Take take_points(const std::string& path, std::size_t skip, std::size_t most) {
  return points_of(std::filesystem::path(KINEMEND_DATA_FOLDER) / path, skip, most);
}

struct Figures {
  double mean = 0;   ///< mean over seeds of the mean distance to the truth
  double worst = 0;  ///< worst seed
  std::size_t refused = 0;
};

Figures fill_figures(const Take& truth, std::size_t length, const std::string& method = "auto") {
  constexpr std::uint64_t seeds = 10;
  Figures figures;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const Take damaged = with_gaps(truth, length, seed);
    Take clip = damaged;
    FillSettings settings;
    settings.method = method;
    figures.refused += fill_gaps(clip, settings).refused();
    settings.fill_all = true;
    fill_gaps(clip, settings);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
      if (damaged.observed[i]) continue;
      sum += norm(clip.positions[i] - truth.positions[i]);
      count += 1;
    }
    figures.mean += sum / count / static_cast<double>(seeds);
    figures.worst = std::max(figures.worst, sum / count);
  }
  testing::Test::RecordProperty("mean", std::to_string(figures.mean));
  testing::Test::RecordProperty("worst", std::to_string(figures.worst));
  printf("  %s, %zu frames: mean %.2f, worst seed %.2f, refused %zu\n", method.c_str(), length,
         figures.mean, figures.worst, figures.refused);
  return figures;
}

constexpr std::size_t body_markers = 41;

TEST(FillRealTakes, ThirtyFramesOfAcrobaticsAreOffByLessThanEightMillimetres) {
  const Figures f = fill_figures(take_points("cmu/c3d/85_02.c3d", 0, body_markers), 30);
  EXPECT_LT(f.mean, 3.5);
  EXPECT_LT(f.worst, 8.0);
  EXPECT_EQ(f.refused, 0U);
}

TEST(FillRealTakes, AHundredAndTwentyFramesOfAcrobaticsAreOffByLessThanEighteenMillimetres) {
  const Figures f = fill_figures(take_points("cmu/c3d/85_02.c3d", 0, body_markers), 120);
  EXPECT_LT(f.mean, 9.0);
  EXPECT_LT(f.worst, 18.0);
}

TEST(FillRealTakes, AHundredAndTwentyFramesOfALongTakeAreOffByLessThanNineMillimetres) {
  const Figures f = fill_figures(take_points("cmu/c3d/85_12.c3d", 0, body_markers), 120);
  EXPECT_LT(f.mean, 8.0);
  EXPECT_LT(f.worst, 14.0);
}

// The takes have other bodies, rooms and movements.
TEST(FillRealTakes, OtherTakesAreOffByAsLittle) {
  EXPECT_LT(fill_figures(take_points("cmu/c3d/05_13.c3d", 0, body_markers), 120).mean, 10.0);
  EXPECT_LT(
      fill_figures(take_points("c3d/other/HDM_bd_05-01_01_120.c3d", 3, body_markers), 120).mean,
      3.0);
  // The nine points are joint centres of legs and pelvis, without clusters.
  EXPECT_LT(fill_figures(take_points("paired/S02-Trial-Walk-1-vicon.c3d", 0, 9), 100).mean, 10.0);
}

TEST(FillRealTakes, AutoIsBetterThanEachMethodByItself) {
  const Take truth = take_points("cmu/c3d/85_02.c3d", 0, body_markers);
  const double chosen = fill_figures(truth, 30).mean;
  for (const char* method :
       {"spline", "quintic", "pchip", "rigid-body", "pca", "local-regression"}) {
    EXPECT_LT(chosen, fill_figures(truth, 30, method).mean) << method;
  }
}

// Expected errors on takes of subjects on which no constant was chosen.
struct Promises {
  std::vector<fill::Kept> kept;

  template <class Take>
  void add(const Take& truth, std::vector<std::size_t> tracks, std::uint64_t rounds) {
    for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
      const auto some = fill::make_and_fill(truth, tracks, 8, seed);
      kept.insert(kept.end(), some.begin(), some.end());
    }
  }

  // `least` is the smallest error of a short gap that is counted.
  fill::Figures figures(const char* what, double least) const {
    const fill::Figures f = fill::figures_of(kept, least);
    printf(
        "  %s: %zu gaps, %.1f %% within twice, %zu above ten times, worst %.1f times; %zu of %zu "
        "short ones worse than twice the spline\n",
        what, f.gaps, 100 * f.share_within_twice(), f.above_ten, f.worst, f.worse_than_spline,
        f.short_gaps);
    return f;
  }
};

TEST(FillRealTakes, PromisesOfMarkersHoldOnTakesOfOthers) {
  Promises promises;
  for (const char* path :
       {"c3d/other/HDM_bd_05-01_01_120.c3d", "c3d/btk/others/FunctionalLHip.c3d",
        "c3d/btk/others/561xxa01_anonym.C3D", "c3d/btk/c3d.org/sample21/sample21.c3d",
        "paired/S02-Trial-Walk-1-vicon.c3d", "trc/SprintMotion.trc", "trc/MOTEK/ballet_reduced.trc",
        "real/depth-RTK.reference.trc"}) {
    const std::size_t skip = std::string(path).find("HDM") == std::string::npos ? 0 : 3;
    const Take truth = take_points(path, skip, body_markers);
    promises.add(truth, fill::whole_markers(truth), 8);
  }
  const fill::Figures f = promises.figures("markers", 0.5);
  EXPECT_GT(f.gaps, 300U);
  EXPECT_GE(f.share_within_twice(), 0.975);
  EXPECT_EQ(f.above_ten, 0U);
  EXPECT_EQ(f.worse_than_spline, 0U);
}

// A swinging heel, seen for three seconds at 60 Hz: frames nearest in time are slower.
TEST(FillRealTakes, PromisesHoldForAHeelInItsSwing) {
  const Take truth = take_points("c3d/btk/c3d.org/sample06/MACsample.c3d", 0, body_markers);
  const std::size_t heel = fill::track_of(truth, "LHEE"), length = 20;
  std::size_t gaps = 0, within_twice = 0;
  for (std::size_t first = 1; first + length < truth.frame_count(); ++first) {
    Take clip = truth;
    fill::hide(clip, "LHEE", first, first + length - 1);
    const Gap hidden{heel, first, first + length - 1};
    const FillReport report = fill_gaps(clip);
    for (const GapOutcome& outcome : report.gaps) {
      const bool is_hidden = outcome.gap.track == heel && outcome.gap.first_frame == first &&
                             outcome.gap.last_frame == hidden.last_frame;
      if (!is_hidden || !outcome.filled) continue;
      gaps += 1;
      within_twice += fill::rms_error(truth, clip, outcome.gap) <= 2 * outcome.expected_error;
    }
  }
  printf("  heel: %zu gaps, %zu within twice\n", gaps, within_twice);
  EXPECT_GT(gaps, 60U);
  EXPECT_GE(static_cast<double>(within_twice), 0.87 * static_cast<double>(gaps));
}

// At 50 Hz, six frames are longer than the gaps for which a spline is tried first.
TEST(FillRealTakes, GapsOfSixFramesAtFiftyHertzAreSeldomWorseThanTwiceTheSpline) {
  const Take truth = take_points("c3d/btk/c3d.org/sample01/Eb015si.c3d", 0, body_markers);
  std::size_t gaps = 0, worse = 0;
  for (std::size_t first = 3; first + 9 < truth.frame_count(); first += 2) {
    Take clip = truth;
    fill::hide(clip, "LFT2", first, first + 5);
    Take splined = clip;
    const FillReport report = fill_gaps(clip);
    fill::fill_with(splined, "spline", true);
    for (const GapOutcome& outcome : report.gaps) {
      if (outcome.gap.first_frame != first || !outcome.filled) continue;
      gaps += 1;
      worse += fill::rms_error(truth, clip, outcome.gap) >
               std::max(2 * fill::rms_error(truth, splined, outcome.gap), 0.5);
    }
  }
  printf("  six frames at 50 Hz: %zu gaps, %zu worse than twice the spline\n", gaps, worse);
  EXPECT_GT(gaps, 200U);
  EXPECT_LE(worse, gaps / 33);
}

TEST(FillRealTakes, PromisesOfJointsHoldOnTakesOfOthers) {
  Promises promises;
  for (const char* name :
       {"01_05", "03_03", "07_04", "09_05", "10_03", "11_01", "35_20", "131_05"}) {
    const std::string path = std::string(KINEMEND_DATA_FOLDER "/cmu/bvh/") + name + ".bvh";
    const Take all = read_joints(std::filesystem::path(path)).take;
    const Take truth = slice(all, leading_calibration_frames(all), all.frame_count());
    promises.add(truth, fill::moving_joints(truth), 8);
  }
  const fill::Figures f = promises.figures("joints", 0.1);
  EXPECT_GT(f.gaps, 300U);
  EXPECT_GE(f.share_within_twice(), 0.96);
  EXPECT_EQ(f.above_ten, 0U);
  EXPECT_LE(f.worse_than_spline, f.short_gaps / 200);
}

}  // namespace
}  // namespace kinemend::quality
