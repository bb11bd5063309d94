#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "io/fbx/fbx_patch.hpp"
#include "io/fbx/fbx_tree.hpp"
#include "io/mended.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"

namespace kinemend {
namespace {

namespace fs = std::filesystem;

const fs::path real_fbx = fs::path(KINEMEND_DATA_FOLDER) / "fbx";

std::vector<fs::path> real_fbx_files() {
  std::vector<fs::path> paths;
  if (!fs::exists(real_fbx)) return paths;
  for (const auto& entry : fs::recursive_directory_iterator(real_fbx)) {
    if (entry.path().extension() == ".fbx") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TakeResult read_as_fbx(const fs::path& path) {
  ReadOptions options;
  options.format = "fbx";
  return read_take(path, options);
}

TEST(RealFbx, RecordsComeBackToTheByte) {
  if (!fs::exists(real_fbx)) GTEST_SKIP() << "the folder has no FBX files";
  std::size_t files = 0;
  for (const fs::path& path : real_fbx_files()) {
    SCOPED_TRACE(path);
    try {
      const std::string bytes = read_file(path);
      const FbxTree tree = read_fbx_tree(bytes, "file", 512);
      EXPECT_TRUE(write_patched_fbx(tree, {}) == bytes);
      // An empty patch uses the same code as a real change.
      const FbxRecord& record = tree.records.front();
      const std::size_t end = record.properties_end;
      EXPECT_TRUE(write_patched_fbx(tree, {{end, end, "", 0}}) == bytes);
      ++files;
    } catch (const Error&) {
      // These files of a fuzzer are damaged on purpose.
      EXPECT_NE(path.filename().string().find("fuzz"), std::string::npos);
    }
  }
  EXPECT_GE(files, 340u);
}

TEST(RealFbx, TakesAreValidAndComeBackToTheByte) {
  if (!fs::exists(real_fbx)) GTEST_SKIP() << "the folder has no FBX files";
  std::size_t files = 0;
  for (const fs::path& path : real_fbx_files()) {
    SCOPED_TRACE(path);
    try {
      const TakeResult result = read_as_fbx(path);
      result.take.validate();
      EXPECT_TRUE(test::was_mended(result.diagnostics) ||
                  write_take(result.take, "fbx") == read_file(path));
      ++files;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    }
  }
  EXPECT_GE(files, 110u);
}

// A scene saved in several versions and forms has the same motion in all.
TEST(RealFbx, VersionsOfASceneAgree) {
  if (!fs::exists(real_fbx)) GTEST_SKIP() << "the folder has no FBX files";
  std::map<std::string, std::vector<fs::path>> scenes;
  for (const fs::path& path : real_fbx_files()) {
    const std::string name = path.filename().string();
    const std::size_t version = name.find_first_of("0123456789");
    if (name.find("fuzz") == name.npos && version != name.npos && name.substr(0, 4) == "maya")
      scenes[name.substr(0, version)].push_back(path);
  }
  std::size_t compared = 0;
  for (const auto& [scene, paths] : scenes) {
    // The versions of these scenes hold different ranges of the animation.
    if (scene == "maya_resampled_" || scene == "maya_game_sausage_") continue;
    std::vector<Vec3> wanted;
    for (const fs::path& path : paths) {
      SCOPED_TRACE(path);
      try {
        const TakeResult result = read_as_fbx(path);
        const auto positions = joint_positions(result.take);
        if (wanted.empty()) {
          wanted = positions;
          continue;
        }
        ASSERT_EQ(positions.size(), wanted.size());
        for (std::size_t i = 0; i < positions.size(); ++i)
          ASSERT_LT(norm(positions[i] - wanted[i]), 2e-4 * (1 + norm(wanted[i]))) << i;
        ++compared;
      } catch (const Error&) {
        // This file has no joints.
      }
    }
  }
  EXPECT_GE(compared, 10u);
}

}  // namespace
}  // namespace kinemend
