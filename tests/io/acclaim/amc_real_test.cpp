// Real AMC files are written back byte for byte, and their joints are at the positions in BVH and
// C3D files of the same takes.

#include "acclaim.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;

const fs::path takes = KINEMEND_DATA_FOLDER;

std::vector<fs::path> files_with(const char* extension) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(takes)) {
    if (entry.path().extension() == extension) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool has_skeleton(const fs::path& amc) {
  return amc.parent_path().filename() != "08" && amc.filename().string().rfind("out", 0) != 0;
}

TEST(RealAmc, EveryTakeIsValidAndComesBackToTheByte) {
  std::size_t takes = 0;
  for (const fs::path& path : files_with(".amc")) {
    SCOPED_TRACE(path);
    if (!has_skeleton(path)) {
      EXPECT_NE(message_of([&] { read_joints(path); }, ErrorKind::unreadable_input).find("--asf"),
                std::string::npos);
      continue;
    }
    const std::string bytes = read_file(path);
    const Take clip = read_joints(bytes, path.string()).take;
    clip.validate();
    const std::string written = write_take(clip, "amc");
    if (bytes.find("nan") == bytes.npos) {
      EXPECT_TRUE(written == bytes);
    } else {
      // The writer replaces NaN by the held value; a second round trip changes nothing.
      EXPECT_EQ(written.find("nan"), written.npos);
      EXPECT_TRUE(write_take(read_joints(written, path.string()).take, "amc") == written);
    }
    ++takes;
  }
  EXPECT_EQ(takes, 160u);
}

TEST(RealAmc, EverySkeletonIsValidAndOfAPerson) {
  const std::vector<fs::path> paths = files_with(".asf");
  EXPECT_EQ(paths.size(), 13u);
  for (const fs::path& path : paths) {
    SCOPED_TRACE(path);
    const TakeResult result = read_joints(path);
    EXPECT_TRUE(result.diagnostics.empty());
    EXPECT_EQ(result.take.joint_count(), 31u);
    EXPECT_EQ(result.take.skeleton.end_sites.size(), 7u);
    const double metres = body_height(result.take.skeleton) * result.take.metres_per_unit;
    EXPECT_GT(metres, 1.4);
    EXPECT_LT(metres, 2.1);
    EXPECT_EQ(result.take.skeleton.limits.size(), 31u);
  }
}

TEST(RealAmc, GapsAreFoundWhereAProgramWroteNan) {
  const fs::path folder = takes / "amc-odd/csci520-shreyabhaumik";
  const TakeResult result = read_joints(folder / "131_04-dance-bq-N20.amc");
  EXPECT_EQ(result.diagnostics.count("value_not_finite"), 4082u);
  const auto fingers = static_cast<std::size_t>(result.take.skeleton.find("lfingers"));
  EXPECT_FALSE(result.take.is_observed(1, fingers));
}

// The BVH of the same take begins with a T-pose and lacks the bones that lead to the neck, the
// collar bones, the thumbs and the fingers.
TEST(RealAmc, JointsStandWhereTheBvhOfTheSameTakePutsThem) {
  const Take amc = read_joints(takes / "cmu/amc/35/35_01.amc").take;
  const Take bvh = read_joints(takes / "cmu/bvh/35_01.bvh").take;
  ASSERT_EQ(amc.joint_count(), bvh.joint_count());
  ASSERT_EQ(amc.frame_count() + 1, bvh.frame_count());
  const auto thorax = static_cast<std::size_t>(amc.skeleton.find("thorax"));
  for (std::size_t f = 0; f < amc.frame_count(); ++f) {
    const Pose a = forward_kinematics(amc, f), b = forward_kinematics(bvh, f + 1);
    for (std::size_t j = 0; j <= thorax; ++j) {
      ASSERT_LT(norm(a.positions[j] - b.positions[j]), 2e-4) << f << " " << amc.skeleton.names[j];
    }
    const auto arm = [](const Take& clip, const Pose& pose, const char* from, const char* to) {
      return pose.positions[static_cast<std::size_t>(clip.skeleton.find(to))] -
             pose.positions[static_cast<std::size_t>(clip.skeleton.find(from))];
    };
    ASSERT_LT(norm(arm(amc, a, "lhumerus", "lwrist") - arm(bvh, b, "LeftArm", "LeftHand")), 4e-4);
    ASSERT_LT(norm(arm(amc, a, "rhumerus", "rwrist") - arm(bvh, b, "RightArm", "RightHand")), 4e-4);
  }
}

// The C3D of the take holds the joints of the program that wrote the AMC, in millimetres, z up,
// rounded to its scale of 0.16 mm. Its feet rotate about three axes, of which the AMC has two.
TEST(RealAmc, JointsStandWhereTheC3dOfTheSameTakePutsThem) {
  const Take amc = read_joints(takes / "cmu/amc/05/05_13.amc").take;
  const auto c3d = read_take(takes / "cmu/c3d/05_13.c3d").take;
  ASSERT_EQ(amc.frame_count(), c3d.frame_count());
  const std::vector<std::pair<std::string, std::string>> pairs{
      {"root", "PEL0"},     {"lfemur", "LHJ0"},    {"rfemur", "RHJ0"},  {"ltibia", "LFE0"},
      {"rtibia", "RFE0"},   {"lfoot", "LTI0"},     {"rfoot", "RTI0"},   {"upperback", "LBK0"},
      {"thorax", "UBK0"},   {"lowerneck", "TRX0"}, {"head", "UNK0"},    {"upperneck", "LNK0"},
      {"lhumerus", "LCL0"}, {"rhumerus", "RCL0"},  {"lradius", "LHU0"}, {"rradius", "RHU0"},
      {"lwrist", "LRA0"},   {"rwrist", "RRA0"},    {"lhand", "LWR0"},   {"rhand", "RWR0"},
      {"lfingers", "LHN0"}, {"rfingers", "RHN0"},  {"lthumb", "LWR0"},  {"rthumb", "RWR0"}};
  const double mm = 1000 * amc.metres_per_unit;
  for (const auto& [joint, point] : pairs) {
    const auto j = static_cast<std::size_t>(amc.skeleton.find(joint));
    const auto found = std::find(c3d.names.begin(), c3d.names.end(), "Dance:" + point);
    ASSERT_NE(found, c3d.names.end()) << point;
    const auto m = static_cast<std::size_t>(found - c3d.names.begin());
    for (std::size_t f = 0; f < amc.frame_count(); f += 7) {
      const Vec3 p = c3d.positions[f * c3d.names.size() + m];
      const Vec3 q = mm * forward_kinematics(amc, f).positions[j];
      ASSERT_LT(norm(Vec3{p.y, p.z, p.x} - q), 0.25) << joint << " " << f;
    }
  }
}

// Takes with a small rotation at all joints read back correctly, and no angle jumps where the
// source's does not.
TEST(RealAmc, ChangedTakesReadBack) {
  const auto paths = files_with(".amc");
  for (std::size_t i = 0; i < paths.size(); i += 25) {
    if (!has_skeleton(paths[i])) continue;
    SCOPED_TRACE(paths[i]);
    Take clip = read_joints(paths[i]).take;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        if (clip.skeleton.rotation_order(j).count == 3)
          clip.rotation(f, j) = clip.rotation(f, j) * exp({0.002, -0.003, 0.001});
      }
    }
    const std::string skeleton = clip.source.facts.at(0).text;
    const Take again = read_pair(write_take(clip, "amc"), read_file(skeleton)).take;
    expect_same_motion(clip, again, 2e-5);
  }
}

TEST(RealAmc, TakesOfBvhKeepTheirJointPositions) {
  for (const char* name : {"cmu/bvh/35_01.bvh", "bvh-other/GPmat/Swagger.bvh",
                           "bvh-other/bandai-namco/dataset-1_bow_happy_001.bvh",
                           "bvh-other/pybvh/bvh_data_bvh_test3.bvh"}) {
    SCOPED_TRACE(name);
    const Take clip = read_joints(takes / name).take;
    const Take again = read_pair(write_take(clip, "amc"), write_take(clip, "asf")).take;
    const double size = body_height(clip.skeleton);
    for (std::size_t f = 0; f < clip.frame_count(); f += 5) {
      const Pose a = forward_kinematics(clip, f), b = forward_kinematics(again, f);
      for (std::size_t j = 1; j < clip.joint_count(); ++j) {
        const std::int32_t k = again.skeleton.find(clip.skeleton.names[j]);
        ASSERT_GT(k, 0) << clip.skeleton.names[j];
        ASSERT_LT(norm(a.positions[j] - b.positions[static_cast<std::size_t>(k)]), 1e-9 * size);
      }
    }
  }
}

}  // namespace
}  // namespace kinemend
