#include "gltf_support.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

std::filesystem::path example_take(const char* name) {
  return std::filesystem::path(KINEMEND_TAKES) / name;
}

TEST(GltfRoundTrip, JointsComeBackFromTheirGlbInSinglePrecision) {
  for (const char* const format : {"glb", "gltf"}) {
    const Take clip = read_joints(example_take("walk.bvh")).take;
    const std::string bytes = write_take(clip, format);
    const Take again = read_joints(bytes, std::string("walk.") + format).take;
    EXPECT_EQ(again.skeleton.names, clip.skeleton.names);
    EXPECT_EQ(again.skeleton.parents, clip.skeleton.parents);
    EXPECT_EQ(again.skeleton.end_sites.size(), clip.skeleton.end_sites.size());
    EXPECT_EQ(again.frame_rate_hz, clip.frame_rate_hz);
    ASSERT_EQ(again.rotations.size(), clip.rotations.size());
    for (std::size_t i = 0; i < clip.rotations.size(); ++i)
      ASSERT_LT(angle_between(again.rotations[i], clip.rotations[i]), 1e-6) << i;
    const double metres = norm(again.skeleton.offsets[1]) / norm(clip.skeleton.offsets[1]);
    const auto before = joint_positions(clip, true), after = joint_positions(again, true);
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_LT(norm(after[i] - metres * before[i]), 1e-5) << i;
    EXPECT_TRUE(write_take(again) == bytes);
  }
}

TEST(GltfRoundTrip, AGlbOfATakeIsCleanedInPlace) {
  const std::string bytes = write_take(read_joints(example_take("walk.bvh")).take, "glb");
  Take clip = read_glb_bytes(bytes);
  const std::string joint = clip.skeleton.names[5];
  turn(clip, 100, joint, {0.1, 0, 0});
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(write_take(clip));
  EXPECT_EQ(before.json, after.json);
  EXPECT_EQ(changed_elements(before, after).size(), 1u);
}

Take moving_scene_markers() {
  Random random(3);
  Take clip = make_marker_take({"LASI", "RASI", "Ann:SACR"}, 40, 100);
  clip.unit = "mm";
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    clip.positions[i] = {1000 * random.normal(), 900 + 10 * random.normal(), 100 * random.normal()};
    clip.observed[i] = 1;
  }
  for (const std::size_t f : {0, 1, 7, 8, 39}) clip.observed[3 * f + 1] = 0;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    if (clip.observed[i] == 0) clip.positions[i] = {};
  }
  return clip;
}

Take read_glb_markers(const std::string& bytes) { return read_take(bytes, "take.glb").take; }

TEST(GltfRoundTrip, MarkersComeBackWithTheirGaps) {
  const Take clip = moving_scene_markers();
  const std::string bytes = write_take(clip, "glb");
  const Take again = read_glb_markers(bytes);
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_EQ(again.unit, "m");
  EXPECT_EQ(again.frame_rate_hz, 100);
  for (std::size_t i = 0; i < clip.positions.size(); ++i)
    ASSERT_LT(norm(1000 * again.positions[i] - clip.positions[i]), 1e-3) << i;
  EXPECT_TRUE(write_take(again) == bytes);
}

TEST(GltfRoundTrip, AFilledMarkerAppearsAndOneThatIsLostShrinks) {
  const std::string bytes = write_take(moving_scene_markers(), "glb");
  Take clip = read_glb_markers(bytes);
  clip.position(7, 1) = {1, 2, 3};
  clip.observed[3 * 7 + 1] = 1;
  clip.position(20, 1) = {};
  clip.observed[3 * 20 + 1] = 0;
  const std::string written = write_take(clip);
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
  const int places = static_cast<int>(before.output("RASI", "translation"));
  const int sizes = static_cast<int>(before.output("RASI", "scale"));
  EXPECT_EQ(changed_elements(before, after),
            (std::set<std::pair<int, std::size_t>>{{places, 7}, {sizes, 7}, {sizes, 20}}));
  const Take again = read_glb_markers(written);
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_LT(norm(again.position(7, 1) - Vec3{1, 2, 3}), 1e-6);
}

TEST(GltfRoundTrip, AMarkerThatWasAlwaysThereGetsAChannelForItsGaps) {
  const std::string bytes = write_take(moving_scene_markers(), "glb");
  Take clip = read_glb_markers(bytes);
  clip.observed[3 * 5] = 0;
  clip.position(5, 0) = {};
  const Take again = read_glb_markers(write_take(clip));
  EXPECT_EQ(again.observed, clip.observed);
  for (std::size_t f = 0; f < 40; ++f)
    EXPECT_LT(norm(again.position(f, 2) - clip.position(f, 2)), 1e-6);
}

TEST(GltfRoundTrip, MarkersWithOtherFramesKeepTheirScene) {
  const std::string bytes = write_take(moving_scene_markers(), "glb");
  Take clip = read_glb_markers(bytes);
  clip.positions.resize(3 * 20);
  clip.observed.resize(3 * 20);
  const Take again = read_glb_markers(write_take(clip));
  EXPECT_EQ(again.observed, clip.observed);
  EXPECT_EQ(again.frame_count(), 20u);
}

}  // namespace
}  // namespace kinemend
