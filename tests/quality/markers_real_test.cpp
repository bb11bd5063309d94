// The methods `auto` and `learned` on optical takes of the CMU database, with and without known
// damage.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "kinemend/io.hpp"
#include "quality/marker_quality.hpp"

namespace kinemend::quality {
namespace {

using test::max_distance;
using test::rms_distance;

Take real_take(const char* name) {
  const std::filesystem::path folder = KINEMEND_DATA_FOLDER;
  return read_take(folder / "cmu" / "c3d" / name).take;
}

// A part that is long enough: 10 s of 41 markers, 2 s of 330.
Take part(const Take& clip) {
  const std::size_t frames = clip.marker_count() > 100 ? 240 : 1200;
  return slice(clip, 0, std::min(clip.frame_count(), frames));
}

class RealMarkers : public testing::TestWithParam<const char*> {};

TEST_P(RealMarkers, ComeBackAsTheyWereWhereTheyAreClean) {
  const Take truth = real_take(GetParam());
  for (const char* method : {"auto", "learned"}) {
    const Take result = cleaned_markers(truth, method);
    EXPECT_LT(rms_distance(result, truth), 0.2) << method;
    EXPECT_EQ(result.observed, truth.observed) << method;
  }
}

TEST_P(RealMarkers, AreCleanedBestByAuto) {
  const Take truth = part(real_take(GetParam()));
  for (const double noise_mm : {2.0, 5.0, 10.0}) {
    const Take noisy = damaged_markers(truth, noise_mm, 11);
    const double ours = rms_distance(cleaned_markers(noisy, "auto"), truth);
    std::string figures =
        fmt::format("noisy {:.2f}, auto {:.2f}", rms_distance(noisy, truth), ours);
    for (const std::string& method : other_methods()) {
      const double theirs = rms_distance(cleaned_markers(noisy, method), truth);
      EXPECT_LT(ours, theirs) << method << " at " << noise_mm << " mm";
      figures += fmt::format(", {} {:.2f}", method, theirs);
    }
    RecordProperty(fmt::format("rms_at_{}_mm", noise_mm), figures);
  }
}

TEST_P(RealMarkers, MayBeLongOrShortOfSamples) {
  Take clip = part(real_take(GetParam()));
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    test::lose(clip, m, 100 + m % 60, 120 + 2 * (m % 60));
  }
  const Take result = cleaned_markers(clip, "auto");
  EXPECT_EQ(result.observed, clip.observed);
  EXPECT_LT(rms_distance(result, clip), 0.3);
}

INSTANTIATE_TEST_SUITE_P(Cmu, RealMarkers, testing::Values("85_02.c3d", "85_12.c3d", "05_13.c3d"),
                         [](const auto& take) { return "take_" + std::string(take.param, 5); });

}  // namespace
}  // namespace kinemend::quality
