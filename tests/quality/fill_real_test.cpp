#include <gmock/gmock.h>

#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <variant>
#include <vector>

#include "fill/made_gaps.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/gaps.hpp"
#include "kinemend/io.hpp"
#include "kinemend/random.hpp"

// Gaps made in takes that have none, filled again.
namespace kinemend::quality {
namespace {

// `most` points of a take from number `skip` on: what comes behind them are angles and the like.
MarkerClip points_of(const std::string& path, std::size_t skip, std::size_t most) {
  const Take take = read_take(KINEMEND_DATA_FOLDER "/" + path).take;
  const MarkerClip& all = std::get<MarkerClip>(take);
  std::vector<std::size_t> kept;
  std::vector<std::string> names;
  for (std::size_t m = skip; m < all.marker_count() && kept.size() < most; ++m) {
    kept.push_back(m);
    names.push_back(all.names[m]);
  }
  MarkerClip clip = make_marker_clip(names, all.frame_count(), all.frame_rate_hz);
  for (std::size_t f = 0; f < all.frame_count(); ++f) {
    for (std::size_t k = 0; k < kept.size(); ++k) {
      clip.position(f, k) = all.position(f, kept[k]);
      clip.observed[f * kept.size() + k] = all.is_observed(f, kept[k]) ? 1 : 0;
    }
  }
  return clip;
}

// Three gaps in each of five markers, at places drawn by the seed.
MarkerClip with_gaps(const MarkerClip& truth, std::size_t length, std::uint64_t seed) {
  constexpr std::size_t damaged_markers = 5, gaps_each = 3, apart = 10;
  MarkerClip clip = truth;
  Random random(seed);
  std::vector<std::size_t> order(clip.marker_count());
  for (std::size_t m = 0; m < order.size(); ++m) order[m] = m;
  for (std::size_t i = 0; i < damaged_markers; ++i) {
    std::swap(order[i], order[i + random.below(order.size() - i)]);
    std::vector<std::size_t> starts;
    while (starts.size() < gaps_each) {
      const std::size_t start = apart + random.below(clip.frame_count() - length - 2 * apart);
      const bool free = std::all_of(starts.begin(), starts.end(), [&](std::size_t other) {
        return std::max(start, other) - std::min(start, other) > length + apart;
      });
      if (free) starts.push_back(start);
      // Three gaps that leave no room for one another are drawn anew.
      else if (random.chance(0.05))
        starts.clear();
    }
    for (const std::size_t start : starts) {
      const NamedGap gap{clip.names[order[i]], start, start + length - 1};
      mark_gaps(clip, {&gap, 1});
    }
  }
  return clip;
}

struct Figures {
  double mean = 0;   ///< over seeds, of the mean distance to the truth
  double worst = 0;  ///< seed
  std::size_t refused = 0;
};

Figures figures(const MarkerClip& truth, std::size_t length, const std::string& method = "auto") {
  constexpr std::uint64_t seeds = 10;
  Figures figures;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const MarkerClip damaged = with_gaps(truth, length, seed);
    MarkerClip clip = damaged;
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
  ::testing::Test::RecordProperty("mean", std::to_string(figures.mean));
  ::testing::Test::RecordProperty("worst", std::to_string(figures.worst));
  printf("  %s, %zu frames: mean %.2f, worst seed %.2f, refused %zu\n", method.c_str(), length,
         figures.mean, figures.worst, figures.refused);
  return figures;
}

constexpr std::size_t body_markers = 41;

TEST(FillRealTakes, ThirtyFramesOfAcrobaticsAreOffByLessThanEightMillimetres) {
  const Figures f = figures(points_of("cmu/c3d/85_02.c3d", 0, body_markers), 30);
  EXPECT_LT(f.mean, 3.5);
  EXPECT_LT(f.worst, 8.0);
  EXPECT_EQ(f.refused, 0U);
}

TEST(FillRealTakes, AHundredAndTwentyFramesOfAcrobaticsAreOffByLessThanEighteenMillimetres) {
  const Figures f = figures(points_of("cmu/c3d/85_02.c3d", 0, body_markers), 120);
  EXPECT_LT(f.mean, 9.0);
  EXPECT_LT(f.worst, 18.0);
}

TEST(FillRealTakes, AHundredAndTwentyFramesOfALongTakeAreOffByLessThanNineMillimetres) {
  const Figures f = figures(points_of("cmu/c3d/85_12.c3d", 0, body_markers), 120);
  EXPECT_LT(f.mean, 8.0);
  EXPECT_LT(f.worst, 14.0);
}

// Other bodies, rooms and movements.
TEST(FillRealTakes, OtherTakesAreOffByAsLittle) {
  EXPECT_LT(figures(points_of("cmu/c3d/05_13.c3d", 0, body_markers), 120).mean, 10.0);
  EXPECT_LT(figures(points_of("c3d/other/HDM_bd_05-01_01_120.c3d", 3, body_markers), 120).mean,
            3.0);
  // Nine points of the legs and the pelvis: joint centres, no clusters.
  EXPECT_LT(figures(points_of("paired/S02-Trial-Walk-1-vicon.c3d", 0, 9), 100).mean, 10.0);
}

TEST(FillRealTakes, AutoIsBetterThanEachMethodByItself) {
  const MarkerClip truth = points_of("cmu/c3d/85_02.c3d", 0, body_markers);
  const double chosen = figures(truth, 30).mean;
  for (const char* method :
       {"spline", "quintic", "pchip", "rigid-body", "pca", "local-regression"}) {
    EXPECT_LT(chosen, figures(truth, 30, method).mean) << method;
  }
}

// Promises, over takes that nothing was chosen with: no subject of these is among those that are.
struct Promises {
  std::vector<fill::Kept> kept;

  template <class AnyClip>
  void add(const AnyClip& truth, std::vector<std::size_t> tracks, std::uint64_t rounds) {
    for (std::uint64_t seed = 1; seed <= rounds; ++seed) {
      const auto some = fill::make_and_fill(truth, tracks, 8, seed);
      kept.insert(kept.end(), some.begin(), some.end());
    }
  }

  // `least`: a short gap's error that counts.
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

// Markers that are seen in every frame.
std::vector<std::size_t> whole_markers(const MarkerClip& clip) {
  std::vector<std::size_t> whole;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    bool seen = true;
    for (std::size_t f = 0; seen && f < clip.frame_count(); ++f) seen = clip.is_observed(f, m);
    if (seen) whole.push_back(m);
  }
  return whole;
}

TEST(FillRealTakes, PromisesOfMarkersHoldOnTakesOfOthers) {
  Promises promises;
  for (const char* path :
       {"c3d/other/HDM_bd_05-01_01_120.c3d", "c3d/btk/others/FunctionalLHip.c3d",
        "c3d/btk/others/561xxa01_anonym.C3D", "c3d/btk/c3d.org/sample21/sample21.c3d",
        "paired/S02-Trial-Walk-1-vicon.c3d", "trc/SprintMotion.trc", "trc/MOTEK/ballet_reduced.trc",
        "real/depth-RTK.reference.trc"}) {
    const std::size_t skip = std::string(path).find("HDM") == std::string::npos ? 0 : 3;
    const MarkerClip truth = points_of(path, skip, body_markers);
    promises.add(truth, whole_markers(truth), 8);
  }
  const fill::Figures f = promises.figures("markers", 0.5);
  EXPECT_GT(f.gaps, 300U);
  EXPECT_GE(f.share_within_twice(), 0.9);
  EXPECT_EQ(f.above_ten, 0U);
  EXPECT_LE(f.worse_than_spline, f.short_gaps / 200);
}

TEST(FillRealTakes, PromisesOfJointsHoldOnTakesOfOthers) {
  Promises promises;
  for (const char* name :
       {"01_05", "03_03", "07_04", "09_05", "10_03", "11_01", "35_20", "131_05"}) {
    const std::string path = std::string(KINEMEND_DATA_FOLDER "/cmu/bvh/") + name + ".bvh";
    const Clip all = read_clip(std::filesystem::path(path)).clip;
    const Clip truth = slice(all, leading_calibration_frames(all), all.frame_count());
    std::vector<std::size_t> moving;
    for (std::size_t j = 0; j < truth.joint_count(); ++j) {
      double farthest = 0;
      for (std::size_t f = 0; f < truth.frame_count(); ++f)
        farthest = std::max(farthest, angle_between(truth.rotation(0, j), truth.rotation(f, j)));
      if (farthest > 0.02) moving.push_back(j);
    }
    promises.add(truth, moving, 8);
  }
  const fill::Figures f = promises.figures("joints", 0.1);
  EXPECT_GT(f.gaps, 300U);
  EXPECT_GE(f.share_within_twice(), 0.9);
  EXPECT_EQ(f.above_ten, 0U);
  EXPECT_LE(f.worse_than_spline, f.short_gaps / 200);
}

}  // namespace
}  // namespace kinemend::quality
