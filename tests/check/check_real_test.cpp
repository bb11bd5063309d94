// Real takes show their known faults, and clean takes show none.
#include <gtest/gtest.h>

#include "check/support.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {
namespace {

CheckReport report_of(const std::string& path) {
  const TakeResult read = read_take(std::filesystem::path(KINEMEND_DATA_FOLDER) / path);
  return check_take(read.take);
}

struct KnownFault {
  const char* path;
  FindingKind kind;
  std::size_t first_frame, last_frame;  // from 1, as people count
};

std::ostream& operator<<(std::ostream& out, const KnownFault& fault) { return out << fault.path; }

class KnownFaults : public testing::TestWithParam<KnownFault> {};

TEST_P(KnownFaults, AreFound) {
  const KnownFault& fault = GetParam();
  for (const Finding& finding : of_kind(report_of(fault.path), fault.kind)) {
    if (finding.first_frame + 1 == fault.first_frame && finding.last_frame + 1 == fault.last_frame)
      return;
  }
  FAIL() << to_string(fault.kind) << " not found";
}

TEST(RealPlates, TouchDownAndLiftOffAgreeWithForcePlates) {
  std::vector<PlateStand> stands;
  for (const char* file : {"btk/PiG/PiG_Motion3_FF.c3d", "btk/others/FunctionalWalk.c3d",
                           "kineticstoolkit/c3d_sample.c3d"}) {
    const Take take = read_take(std::filesystem::path(KINEMEND_DATA_FOLDER) / "c3d" / file).take;
    CheckSettings settings;
    settings.plates = force_plates(take);
    const CheckReport report = check_take(take, settings);
    EXPECT_EQ(report.plate_stands.size(), 3u) << file;
    stands.insert(stands.end(), report.plate_stands.begin(), report.plate_stands.end());
  }
  const PlateFigures figures = plate_figures(stands);
  EXPECT_EQ(figures.found, figures.loads);
  EXPECT_LT(figures.onset_ms.value_or(1000), 20);
  EXPECT_LT(figures.offset_ms.value_or(1000), 20);
}

// The persons stand on the plates while the file calls them unloaded.
TEST(RealPlates, APlateIsNotBelievedUnderAPersonWhoAlreadyStoodOnIt) {
  const Take take =
      read_take(std::filesystem::path(KINEMEND_DATA_FOLDER) / "c3d/btk/others/FunctionalStatic.c3d")
          .take;
  CheckSettings settings;
  settings.plates = force_plates(take);
  EXPECT_EQ(settings.plates.size(), 3u);
  EXPECT_TRUE(check_take(take, settings).plate_stands.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Takes, KnownFaults,
    testing::Values(KnownFault{"cmu/bvh/07_12.bvh", FindingKind::zero_frames, 2, 2},
                    KnownFault{"cmu/bvh/09_10.bvh", FindingKind::zero_frames, 2, 5},
                    KnownFault{"cmu/amc/09/09_10.amc", FindingKind::zero_frames, 1, 4},
                    KnownFault{"cmu/bvh/06_02.bvh", FindingKind::repeated_frames, 642, 722},
                    KnownFault{"cmu/bvh/01_07.bvh", FindingKind::repeated_frames, 3344, 3365},
                    KnownFault{"cmu/bvh/03_02.bvh", FindingKind::repeated_frames, 13, 25}));

TEST(RealTakes, HaveWholeTurnsInTheirAngles) {
  const CheckReport report = report_of("cmu/bvh/05_16.bvh");
  EXPECT_GT(report.figures.flips, 0u);
}

TEST(RealTakes, OfMarkersThatAreCleanHaveNoFaultOfTheirSamples) {
  for (const char* path : {"cmu/c3d/85_02.c3d", "cmu/c3d/85_12.c3d", "cmu/c3d/05_13.c3d",
                           "paired/S02-Trial-Walk-1-vicon.c3d"}) {
    const CheckReport report = report_of(path);
    EXPECT_EQ(report.figures.gaps, 0u) << path;
    EXPECT_EQ(report.figures.spikes, 0u) << path;
    EXPECT_EQ(report.figures.frozen, 0u) << path;
    EXPECT_EQ(report.figures.swaps, 0u) << path;
  }
}

}  // namespace
}  // namespace kinemend::test
