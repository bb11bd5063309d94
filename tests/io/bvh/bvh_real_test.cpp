// Real BVH files are written back byte for byte, and changed ones read back without jumps.
#include <cmath>
#include <set>

#include "io/support.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::vector<fs::path> real_takes() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(KINEMEND_DATA_FOLDER)) {
    const Format* const format = format_of_path(entry.path());
    if (format != nullptr && format->name == "bvh") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(RealBvh, EveryTakeIsValidAndComesBackToTheByte) {
  const std::set<std::string> malformed{"kick.bvh"};
  std::size_t takes = 0;
  for (const fs::path& path : real_takes()) {
    SCOPED_TRACE(path);
    if (malformed.count(path.filename().string()) > 0) {
      EXPECT_THROW(read_joints(path), Error);
      continue;
    }
    const std::string bytes = read_file(path);
    const Take clip = read_joints(bytes, path.string()).take;
    clip.validate();
    EXPECT_TRUE(write_take(clip) == bytes);
    ++takes;
  }
  EXPECT_GT(takes, 400u);
}

// Every 20th take, with a small rotation at all joints, reads back correctly, stays near the
// source's angles where the source does not wrap, and has no jumps.
TEST(RealBvh, ChangedTakesReadBackAndJumpNowhere) {
  const std::vector<fs::path> paths = real_takes();
  std::size_t takes = 0;
  for (std::size_t i = 0; i < paths.size(); i += 20) {
    SCOPED_TRACE(paths[i]);
    const std::string bytes = read_file(paths[i]);
    Take clip = read_joints(bytes, paths[i].string()).take;
    for (Quat& q : clip.rotations) q = q * exp({0.002, -0.003, 0.001});
    const std::string text = write_take(clip);
    const Take again = read_joints(text, "again.bvh").take;
    expect_same_motion(clip, again, 2e-5);
    std::size_t channels = 0;
    for (const auto& joint : clip.skeleton.channels) channels += joint.size();
    const auto before = rows_of(bytes, channels), after = rows_of(text, channels);
    for (std::size_t f = 1; f < after.size(); ++f) {
      std::size_t c = 0;
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        const double turn =
            angle_between(clip.rotation(f - 1, j), clip.rotation(f, j)) * degrees_per_radian;
        for (const Channel channel : clip.skeleton.channels[j]) {
          // A jump is a step of an angle without such a rotation; near gimbal lock, angles may
          // change fast.
          const double step = std::fabs(after[f][c] - after[f - 1][c]);
          if (is_rotation(channel) && turn < 30) {
            ASSERT_LT(step, 200) << "frame " << f << ", joint " << clip.skeleton.names[j];
          }
          ++c;
        }
      }
    }
    ++takes;
  }
  EXPECT_GT(takes, 20u);
}

}  // namespace
}  // namespace kinemend
