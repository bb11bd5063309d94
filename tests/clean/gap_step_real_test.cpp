// Real takes with gaps: filling changes no measured sample and is not misled by spikes.
#include <gtest/gtest.h>

#include "kinemend/clean.hpp"
#include "kinemend/io.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {
namespace {

Take take_of(const std::string& path) {
  return read_take(std::filesystem::path(KINEMEND_DATA_FOLDER) / path).take;
}

CleanResult filled(const Take& clip) {
  CleanSettings settings;
  settings.fill = FillSettings{};
  return clean_take(clip, *make_cleaner("auto"), settings);
}

TEST(GapStepOfRealTakes, LeavesWhatWasMeasuredAsCleaningAloneMakesIt) {
  for (const char* path :
       {"c3d/btk/c3d.org/sample01/Eb015pr.c3d", "c3d/btk/c3d.org/sample06/MACsample.c3d",
        "c3d/btk/c3d.org/sample28/dynamic.C3D", "c3d/btk/c3d.org/sample02/pc_real.c3d",
        "c3d/btk/others/561xxa01_anonym.C3D", "c3d/kineticstoolkit/c3d_sample.c3d"}) {
    const Take clip = take_of(path);
    const CleanResult alone = clean_take(clip, *make_cleaner("auto"));
    const CleanResult with = filled(clip);
    EXPECT_GT(with.report.fill.filled(), 0U) << path;
    for (std::size_t i = 0; i < clip.positions.size(); ++i) {
      if (clip.observed[i] == 0) continue;
      ASSERT_EQ(with.take.positions[i], alone.take.positions[i]) << path << ", sample " << i;
    }
    for (std::size_t m = 0; m < clip.marker_count(); ++m)
      EXPECT_EQ(with.report.tracks[m].noise, alone.report.tracks[m].noise) << path;
  }
}

TEST(GapStepOfRealTakes, ASpikeBesideAGapIsRepairedAndDoesNotBendTheFilling) {
  const Take clip = take_of("c3d/btk/c3d.org/sample01/Eb015pr.c3d");
  const Take without = filled(clip).take;
  for (const Gap& gap : find_gaps(clip)) {
    if (gap.first_frame <= 10) continue;
    Take spiked = clip;
    spiked.position(gap.first_frame - 1, gap.track) += {0, 0, 400};
    const Take with = filled(spiked).take;
    for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f) {
      if (!without.is_observed(f, gap.track) || !with.is_observed(f, gap.track)) continue;
      EXPECT_LT(norm(with.position(f, gap.track) - without.position(f, gap.track)), 20)
          << clip.names[gap.track] << ", frame " << f;
    }
  }
}

}  // namespace
}  // namespace kinemend::test
