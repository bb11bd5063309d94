// Tests that calibration poses of real takes are found, and no others.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/corrupt.hpp"

namespace kinemend {
namespace {

std::vector<std::filesystem::path> takes_below(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  const std::filesystem::path root = std::filesystem::path(KINEMEND_DATA_FOLDER) / folder;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".bvh") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(LeadingCalibrationFramesOfRealTakes, AreFoundInEveryCmuFile) {
  // Known defects: in these two takes, frames after the T-pose are all zero.
  const std::map<std::string, std::size_t> longer{{"07_12", 2}, {"09_10", 5}};
  const auto paths = takes_below("cmu/bvh");
  ASSERT_GT(paths.size(), 200u);
  for (const auto& path : paths) {
    const auto known = longer.find(path.stem().string());
    EXPECT_EQ(leading_calibration_frames(read_joints(path).take),
              known == longer.end() ? 1u : known->second)
        << path;
  }
}

TEST(LeadingCalibrationFramesOfRealTakes, AreFoundInNoisyCmuFiles) {
  for (const char* name : {"35_01", "02_05", "09_03", "16_15", "03_02"}) {
    Take clip = read_joints(std::filesystem::path(KINEMEND_DATA_FOLDER) / "cmu/bvh" /
                            (std::string(name) + ".bvh"))
                    .take;
    Random random(1);
    apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
    apply_damage(clip, "outliers", {{"share", 0.004}, {"std_deg", 25.0}}, random);
    EXPECT_EQ(leading_calibration_frames(clip), 1u) << name;
  }
}

TEST(LeadingCalibrationFramesOfRealTakes, AreNotInventedInOthers) {
  // Three of these takes come from the CMU database and begin with its T-pose.
  const std::set<std::string> with_pose{"backflip", "blender_rendering_example",
                                        "tests_data_01_01"};
  std::size_t read = 0;
  for (const auto& path : takes_below("bvh-other")) {
    try {
      const Take clip = read_joints(path).take;
      ++read;
      EXPECT_EQ(leading_calibration_frames(clip), with_pose.count(path.stem().string())) << path;
    } catch (const Error&) {
      // The tests of the reader cover malformed files.
    }
  }
  EXPECT_GT(read, 100u);
}

}  // namespace
}  // namespace kinemend
