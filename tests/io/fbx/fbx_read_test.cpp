#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fbx_support.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;

constexpr double degree = std::numbers::pi / 180;

// A transform as a 3 x 3 matrix and a point, computed by the test itself.
struct Placement {
  double m[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double t[3] = {0, 0, 0};
};

Placement operator*(const Placement& a, const Placement& b) {
  Placement out;
  for (int i = 0; i < 3; ++i) {
    out.t[i] = a.t[i];
    for (int j = 0; j < 3; ++j) {
      out.t[i] += a.m[i][j] * b.t[j];
      out.m[i][j] = 0;
      for (int k = 0; k < 3; ++k) out.m[i][j] += a.m[i][k] * b.m[k][j];
    }
  }
  return out;
}

Placement moved(double x, double y, double z) {
  Placement p;
  p.t[0] = x;
  p.t[1] = y;
  p.t[2] = z;
  return p;
}

Placement turned(int axis, double degrees) {
  const double c = std::cos(degrees * degree), s = std::sin(degrees * degree);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  Placement p;
  p.m[u][u] = p.m[v][v] = c;
  p.m[v][u] = s;
  p.m[u][v] = -s;
  return p;
}

Placement sized(double x, double y, double z) {
  Placement p;
  p.m[0][0] = x;
  p.m[1][1] = y;
  p.m[2][2] = z;
  return p;
}

Placement xyz(double x, double y, double z) { return turned(2, z) * turned(1, y) * turned(0, x); }

void expect_at(Vec3 found, const Placement& wanted) {
  EXPECT_NEAR(found.x, wanted.t[0], 1e-5);
  EXPECT_NEAR(found.y, wanted.t[1], 1e-5);
  EXPECT_NEAR(found.z, wanted.t[2], 1e-5);
}

Placement inverse_turn(const Placement& p) {
  Placement out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.m[i][j] = p.m[j][i];
  }
  return out;
}

TEST(FbxRead, JointsAreTheLimbsInTreeOrder) {
  const Take clip = read_fbx_clip(fbx_bytes(fbx_walker()));
  EXPECT_EQ(clip.skeleton.names, (std::vector<std::string>{"Hips", "Spine", "Head"}));
  EXPECT_EQ(clip.skeleton.parents, (std::vector<std::int32_t>{-1, 0, 1}));
  EXPECT_EQ(clip.frame_count(), 6u);
  EXPECT_DOUBLE_EQ(clip.frame_rate_hz, 30);
  EXPECT_DOUBLE_EQ(clip.metres_per_unit, 0.01);
  EXPECT_EQ(clip.root_position(2), (Vec3{2, 92, 0}));
}

TEST(FbxRead, EveryFormOfAFileHoldsTheSameTake) {
  const Take wanted = read_fbx_clip(fbx_bytes(fbx_walker()));
  for (const FbxForm& form : fbx_forms) {
    SCOPED_TRACE(form.title);
    const Take clip = read_fbx_clip(fbx_bytes(fbx_walker(), form));
    EXPECT_EQ(clip.skeleton.names, wanted.skeleton.names);
    EXPECT_EQ(clip.rotations, wanted.rotations);
    EXPECT_EQ(clip.positions, wanted.positions);
  }
}

TEST(FbxRead, RotationsAreRelativeToThePreRotation) {
  const Take clip = read_fbx_clip(fbx_bytes(fbx_walker()));
  const auto order = parse_rotation_order("ZYX");
  EXPECT_LT(angle_between(clip.skeleton.rest_rotations[1],
                          from_euler({30 * degree, -20 * degree, 10 * degree}, order)),
            1e-7);
  EXPECT_LT(
      angle_between(clip.rotation(1, 1), from_euler({8 * degree, -5 * degree, 20 * degree}, order)),
      1e-7);
  EXPECT_EQ(clip.skeleton.rotation_order(1), order);
}

TEST(FbxRead, EachRotationOrderIsTheProductOfItsName) {
  // The name gives the order in which rotations act; the product has the opposite order.
  const int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}, {1, 0, 2}, {2, 0, 1}, {2, 1, 0}};
  const double angles[3] = {20, 10, 8};
  for (std::int32_t order = 0; order < 6; ++order) {
    auto models = fbx_walker();
    models[1].properties = {fbx_vector("Lcl Translation", 0, 20, 1),
                            fbx_number_property("RotationOrder", order),
                            fbx_number_property("RotationActive", 1)};
    models[1].rotation = {{{20, 20}}, {{10, 10}}, {{8, 8.5}}};
    models[0].rotation.clear();
    models[0].translation.clear();
    const Take clip = read_fbx_clip(fbx_bytes(models));
    Placement p = moved(0, 20, 1);
    for (int i = 2; i >= 0; --i) p = p * turned(orders[order][i], angles[orders[order][i]]);
    expect_at(forward_kinematics(clip, 0).positions[2], p * moved(0, 30, 0));
  }
}

TEST(FbxRead, PivotsOffsetsAndPostRotationPlaceTheChildren) {
  auto models = fbx_walker();
  models[0].translation.clear();
  models[0].rotation = {{{0, 40}}, {{0, 30}}, {{0, -20}}};
  models[0].properties = {
      fbx_vector("Lcl Translation", 1, 2, 3),   fbx_vector("RotationOffset", 4, 5, 6),
      fbx_vector("RotationPivot", -3, 2, 7),    fbx_vector("PreRotation", 15, 25, 35),
      fbx_vector("PostRotation", -10, 20, 5),   fbx_vector("ScalingOffset", 0.5, 1, 2),
      fbx_vector("ScalingPivot", 1, -1, 0.25),  fbx_vector("Lcl Scaling", 2, 2, 2),
      fbx_number_property("RotationActive", 1), fbx_number_property("InheritType", 1)};
  models[1].rotation.clear();
  models[1].properties = {fbx_vector("Lcl Translation", 3, 20, 1),
                          fbx_number_property("InheritType", 1)};
  const Take clip = read_fbx_clip(fbx_bytes(models));
  ASSERT_EQ(clip.frame_count(), 2u);
  const Placement place = moved(1, 2, 3) * moved(4, 5, 6) * moved(-3, 2, 7) * xyz(15, 25, 35) *
                          xyz(40, 30, -20) * inverse_turn(xyz(-10, 20, 5)) * moved(3, -2, -7) *
                          moved(0.5, 1, 2) * moved(1, -1, 0.25) * sized(2, 2, 2) *
                          moved(-1, 1, -0.25);
  const auto pose = forward_kinematics(clip, 1);
  expect_at(pose.positions[0], moved(2, 9, 16));  // the centre of rotation
  expect_at(pose.positions[1], place * moved(3, 20, 1));
  expect_at(pose.positions[2], place * moved(3, 20, 1) * moved(0, 30, 0));
}

TEST(FbxRead, StaticModelsAboveTheRootTurnAndScaleIt) {
  auto models = fbx_walker();
  models.insert(models.begin(), FbxTestModel{});
  models[0].name = "Armature";
  models[0].kind = "Null";
  models[0].properties = {fbx_vector("Lcl Rotation", -90, 0, 0),
                          fbx_vector("Lcl Scaling", 100, 100, 100)};
  for (auto& model : models) model.parent = model.parent < 0 ? 0 : model.parent + 1;
  models[0].parent = -1;
  const Take clip = read_fbx_clip(fbx_bytes(models));
  EXPECT_EQ(clip.skeleton.names.front(), "Hips");
  const Placement hips = xyz(-90, 0, 0) * sized(100, 100, 100) * moved(1, 91, 0);
  const auto pose = forward_kinematics(clip, 1);
  expect_at(pose.positions[0], hips);
  expect_at(pose.positions[1], hips * xyz(5, 2, -2) * moved(0, 20, 1));
}

TEST(FbxRead, ScalesThatMoveAJointArePositions) {
  auto models = fbx_walker();
  models[0].scaling = {{{1, 1, 2, 1, 1, 1}}, {{1, 1, 2, 1, 1, 1}}, {{1, 1, 2, 1, 1, 1}}};
  const TakeResult result = read_fbx_take(fbx_bytes(models));
  const Take& clip = result.take;
  EXPECT_EQ(result.diagnostics.count("scale_moves_joint"), 2u);
  const Placement hips = moved(2, 92, 0) * xyz(10, 3, -1) * sized(2, 2, 2);
  expect_at(forward_kinematics(clip, 2).positions[1], hips * moved(0, 20, 1));
}

TEST(FbxRead, TurnsWithoutCurvesAreNoChannels) {
  auto models = fbx_walker();
  models[1].properties.push_back(fbx_vector("Lcl Rotation", 11, 0, 33));
  models[1].rotation = {{}, {{0, 5, 10, 15, 20, 25}}, {}};
  const Take clip = read_fbx_clip(fbx_bytes(models));
  EXPECT_EQ(clip.skeleton.channels[1], std::vector<Channel>{Channel::y_rotation});
  const Placement spine =
      moved(1, 91, 0) * xyz(5, 2, -2) * moved(0, 20, 1) * xyz(10, -20, 30) * xyz(11, 5, 33);
  expect_at(forward_kinematics(clip, 1).positions[2], spine * moved(0, 30, 0));
}

TEST(FbxRead, KeysThatAreNotOneAFrameAreResampledAndReported) {
  auto models = fbx_walker();
  FbxTestCurve sparse{{0, 50}, 0, fbx_test_second / 6};
  models[1].rotation = {sparse, {}, {}};
  const TakeResult result = read_fbx_take(fbx_bytes(models));
  EXPECT_EQ(result.diagnostics.count("keys_resampled"), 1u);
  const Take& clip = result.take;
  EXPECT_EQ(clip.frame_count(), 6u);
  EXPECT_NEAR(angle_between(clip.rotation(3, 1), Quat{}), 30 * degree, 1e-6);
  ReadOptions strict;
  strict.strict = true;
  EXPECT_THROW(read_fbx_take(fbx_bytes(models), strict), Error);
}

TEST(FbxRead, ATakeIsChosenByName) {
  ReadOptions options;
  options.animation = "walk";
  EXPECT_NO_THROW(read_fbx_take(fbx_bytes(fbx_walker()), options));
  options.animation = "run";
  try {
    read_fbx_take(fbx_bytes(fbx_walker()), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_STREQ(error.what(), "take.fbx: has no animation \"run\"; it has walk");
  }
}

TEST(FbxRead, AFileWithoutJointsIsRefused) {
  std::vector<FbxTestModel> models(1);
  models[0].name = "Cube";
  models[0].kind = "Mesh";
  try {
    read_fbx_take(fbx_bytes(models));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    EXPECT_STREQ(error.what(),
                 "take.fbx: holds no joints: none of its 1 models is a limb, and none has curves");
  }
}

TEST(FbxRead, AKeyThatIsNotFiniteIsHeldAndNotObserved) {
  auto models = fbx_walker();
  models[1].rotation[0].values[2] = std::numeric_limits<float>::quiet_NaN();
  const TakeResult result = read_fbx_take(fbx_bytes(models));
  const Take& clip = result.take;
  EXPECT_EQ(result.diagnostics.count("value_not_finite"), 1u);
  EXPECT_FALSE(clip.is_observed(2, 1));
  EXPECT_TRUE(clip.is_observed(2, 0));
  models[1].rotation[0].values[2] = 20;
  EXPECT_EQ(write_take(clip, "fbx"), fbx_bytes(models));
}

TEST(FbxRead, LayersAreAddedToTheFirst) {
  const Take one = read_fbx_clip(fbx_bytes(fbx_walker()));
  const Take two = read_fbx_clip(fbx_bytes(fbx_walker(), fbx_forms[0], 2));
  for (std::size_t f = 0; f < one.frame_count(); ++f) {
    EXPECT_LT(norm(two.root_position(f) - 2 * one.root_position(f)), 1e-9);
    for (std::size_t j = 0; j < 2; ++j) {
      const Quat turn = one.rotation(f, j);
      EXPECT_LT(angle_between(two.rotation(f, j), turn * turn), 1e-7);
    }
  }
}

}  // namespace
}  // namespace kinemend
