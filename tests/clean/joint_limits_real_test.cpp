#include <gtest/gtest.h>

#include <filesystem>

#include "clean/joint_limits.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {
namespace {

const std::filesystem::path amc = std::filesystem::path(KINEMEND_DATA_FOLDER) / "cmu/amc";

struct Limited {
  PoseMatrix poses;
  JointLimits limits;
};

Limited limited_take(const std::filesystem::path& path) {
  Clip clip = read_clip(path).clip;
  clip = slice(clip, leading_calibration_frames(clip), clip.frame_count());
  BodyLayoutBuilder builder;
  builder.add(clip);
  const BodyLayout layout = builder.finish();
  const BodyMatch match = match_body(layout, clip);
  return {encode_body(clip, layout, match).poses,
          skeleton_joint_limits(clip.skeleton, layout, match)};
}

double largest_move(const Limited& take) {
  PoseMatrix nearest;
  project_to_limits(take.limits, take.poses, nearest);
  double most = 0;
  for (std::size_t i = 0; i < nearest.values.size(); ++i)
    most = std::max(most, std::abs(nearest.values[i] - take.poses.values[i]));
  return most;
}

// Takes go beyond what their skeleton files state, some by far.
TEST(RealJointLimits, AreWidenedToWhatTheTakeDoes) {
  for (const char* name : {"02/02_01.amc", "16/16_35.amc", "05/05_02.amc"}) {
    SCOPED_TRACE(name);
    Limited take = limited_take(amc / name);
    ASSERT_GT(take.limits.joints.size(), 15u);
    const double before = largest_move(take);
    const std::vector<std::string> moved = widen_joint_limits(take.limits, take.poses);
    const double after = largest_move(take);
    std::string list;
    for (const std::string& text : moved) list += text + "; ";
    RecordProperty("before", std::to_string(before));
    RecordProperty("after", std::to_string(after));
    RecordProperty("moved", list);
    EXPECT_LE(after, before);
    EXPECT_LT(after, 10);
  }
}

}  // namespace
}  // namespace kinemend::test
