#include "gltf_support.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;

const fs::path gltf_scenes = fs::path(KINEMEND_DATA_FOLDER) / "fbx";

// The expected joints, frames and rate of a scene; without joints, it is refused with this part of
// the reason.
struct KnownScene {
  const char* path;
  std::size_t joints, frames;
  double rate_hz;
  const char* reason;
};

const std::vector<KnownScene> known_scenes{
    {"app-mixamo-animation/dancing2.glb", 67, 518, 30, ""},
    {"app-mixamo-animation/dynamic_pose.glb", 67, 2, 30, ""},
    {"ozz-animation/box_animated.gltf", 3, 90, 24, ""},
    {"ozz-animation/cesium_man.gltf", 19, 49, 24, ""},
    {"ozz-animation/rigged_simple.gltf", 2, 50, 24, ""},
    {"ozz-animation/interpolation_test.gltf", 0, 0, 0, "interpolation_test.bin is not there"},
    {"ozz-animation/scene.gltf", 0, 0, 0, "scene.bin is not there"},
    {"ozz-animation/triangle.gltf", 0, 0, 0, "neither an animation nor a skin"},
};

TEST(RealGltf, ScenesAreReadAsKnownAndComeBackToTheByte) {
  for (const KnownScene& scene : known_scenes) {
    SCOPED_TRACE(scene.path);
    const fs::path path = gltf_scenes / scene.path;
    if (scene.joints == 0) {
      const std::string message = message_of([&] { read_take(path); }, ErrorKind::unreadable_input);
      EXPECT_NE(message.find(scene.reason), std::string::npos) << message;
      continue;
    }
    const Take clip = read_joints(path).take;
    EXPECT_EQ(clip.joint_count(), scene.joints);
    EXPECT_EQ(clip.frame_count(), scene.frames);
    EXPECT_EQ(clip.frame_rate_hz, scene.rate_hz);
    EXPECT_TRUE(clip.translated_joints.empty()) << "bones keep their lengths";
    clip.validate();
    EXPECT_TRUE(write_take(clip) == read_file(path));
  }
}

TEST(RealGltf, ChangedJointsReadBackAndTheOthersStay) {
  for (const KnownScene& scene : known_scenes) {
    if (scene.joints == 0) continue;
    SCOPED_TRACE(scene.path);
    Take clip = read_joints(gltf_scenes / scene.path).take;
    const std::size_t joint = clip.joint_count() / 2;
    for (std::size_t f = 0; f < clip.frame_count(); f += 3)
      clip.rotation(f, joint) = normalized(clip.rotation(f, joint) * exp({0.02, 0.01, -0.03}));
    const Take again = read_joints(write_take(clip), scene.path).take;
    ASSERT_EQ(again.rotations.size(), clip.rotations.size());
    for (std::size_t i = 0; i < clip.rotations.size(); ++i) {
      if (i % clip.joint_count() != joint) {
        ASSERT_EQ(again.rotations[i], clip.rotations[i]);
      } else {
        ASSERT_LT(angle_between(again.rotations[i], clip.rotations[i]), 1e-6) << i;
      }
    }
  }
}

// The positions of the dancer's joints in Blender 3.4.1, in metres with Y up.
TEST(RealGltf, ADancerInCentimetresBelowATurnedArmatureStandsWhereBlenderPutsIt) {
  const Take clip = read_joints(gltf_scenes / "app-mixamo-animation/dancing2.glb").take;
  const Pose pose = forward_kinematics(clip, 132);
  const std::map<std::string, Vec3> expected{
      {"mixamorig:HeadTop_End", {-0.027326, 1.736556, 1.14493}},
      {"mixamorig:LeftHand", {0.574669, 1.103084, 0.871846}},
      {"mixamorig:RightToeBase", {-0.02823, 0.000217, 1.027753}}};
  for (const auto& [joint, place] : expected)
    EXPECT_LT(norm(pose.positions[joint_called(clip, joint)] - place), 5e-6) << joint;
}

}  // namespace
}  // namespace kinemend
