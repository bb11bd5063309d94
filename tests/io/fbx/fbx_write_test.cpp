#include <gtest/gtest.h>

#include <map>
#include <set>

#include "fbx_support.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;

const Quat small_turn = exp(Vec3{0.02, -0.01, 0.03});

// The paths and numbers of the records whose properties differ; an empty path if the trees differ.
std::map<std::string, int> changed_records(const std::string& before, const std::string& after) {
  const auto a = walk_binary_fbx(before), b = walk_binary_fbx(after);
  std::map<std::string, int> changed;
  if (a.empty() || a.size() != b.size()) return {{"", 1}};
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].path != b[i].path) ++changed[""];
    if (a[i].properties != b[i].properties) ++changed[a[i].path];
  }
  return changed;
}

TEST(FbxWrite, AnUnchangedTakeComesBackToTheByte) {
  for (const FbxForm& form : fbx_forms) {
    SCOPED_TRACE(form.title);
    const std::string bytes = fbx_bytes(fbx_walker(), form);
    EXPECT_EQ(write_take(read_fbx_take(bytes).take, "fbx"), bytes);
  }
}

TEST(FbxWrite, AChangedJointChangesItsKeyValuesAndNothingElse) {
  for (const FbxForm& form : fbx_forms) {
    if (form.is_text) continue;
    SCOPED_TRACE(form.title);
    const std::string bytes = fbx_bytes(fbx_walker(), form);
    Take clip = read_fbx_clip(bytes);
    clip.rotation(3, 1) = normalized(clip.rotation(3, 1) * small_turn);
    const std::string written = write_take(clip);
    EXPECT_EQ(changed_records(bytes, written),
              (std::map<std::string, int>{{"/Objects/AnimationCurve/KeyValueFloat", 3}}));
    const Take again = read_fbx_clip(written);
    EXPECT_LT(angle_between(again.rotation(3, 1), clip.rotation(3, 1)), 1e-6);
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        const bool is_changed = f == 3 && j == 1;
        EXPECT_EQ(again.rotation(f, j) == clip.rotation(f, j), !is_changed);
      }
    }
  }
}

TEST(FbxWrite, InTextOnlyTheChangedNumbersAreOtherBytes) {
  const FbxForm& form = fbx_forms.back();
  const std::string bytes = fbx_bytes(fbx_walker(), form);
  Take clip = read_fbx_clip(bytes);
  clip.position(2, 0).x = 2.5;
  std::string wanted = bytes;
  wanted.replace(wanted.find("a: 0,1,2,3,4,5"), 14, "a: 0,1,2.5,3,4,5");
  EXPECT_EQ(write_take(clip), wanted);
}

TEST(FbxWrite, TheFooterStaysAlignedWhenRecordsMove) {
  const std::string bytes = fbx_bytes(fbx_walker(), fbx_forms[1]);
  Take clip = read_fbx_clip(bytes);
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.position(f, 0).x += 0.123 * double(f * f);
  const std::string written = write_take(clip);
  ASSERT_NE(written.size(), 0u);
  const std::size_t version = written.size() - 140;
  EXPECT_EQ(version % 16, 4u);
  EXPECT_EQ(written.substr(version), bytes.substr(bytes.size() - 140));
}

TEST(FbxWrite, ARotationContinuesTheAnglesOfTheFrameBefore) {
  auto models = fbx_walker();
  models[1].rotation = {
      {{350, 355, 360, 365, 370, 375}}, {{0, 0, 0, 0, 0, 0}}, {{0, 0, 0, 0, 0, 0}}};
  Take clip = read_fbx_clip(fbx_bytes(models));
  clip.rotation(4, 1) = exp(Vec3{0.15, 0, 0});
  const Take again = read_fbx_clip(write_take(clip));
  const auto values = again.source.document->channel_values();
  const std::size_t width = values.size() / again.frame_count();
  // The hips have three positions and three rotations; the spine is in the order z, y, x.
  EXPECT_NEAR(values[4 * width + 8], 360 + 0.15 * 57.29578, 1e-3);
}

TEST(FbxWrite, StatedTangentsBecomeStraightWhereAValueChanges) {
  auto models = fbx_walker();
  models[1].rotation[0].flags = {1032};
  models[1].rotation[0].data = {3, 4, 0, 0};
  const std::string bytes = fbx_bytes(models);
  Take clip = read_fbx_clip(bytes);
  clip.rotation(3, 1) = normalized(clip.rotation(3, 1) * small_turn);
  const auto changed = changed_records(bytes, write_take(clip));
  EXPECT_EQ(changed.at("/Objects/AnimationCurve/KeyAttrFlags"), 1);
  EXPECT_EQ(changed.at("/Objects/AnimationCurve/KeyValueFloat"), 3);
}

TEST(FbxWrite, OtherFramesGetOtherKeys) {
  for (const FbxForm& form : fbx_forms) {
    SCOPED_TRACE(form.title);
    const std::string bytes = fbx_bytes(fbx_walker(), form);
    Take clip = read_fbx_clip(bytes);
    const Take finer = resample(clip, 60);
    Take longer = clip;
    longer.frame_rate_hz = 60;
    longer.rotations = finer.rotations;
    longer.positions = finer.positions;
    const Take again = read_fbx_clip(write_take(longer));
    ASSERT_EQ(again.frame_count(), finer.frame_count());
    EXPECT_DOUBLE_EQ(again.frame_rate_hz, 60);
    for (std::size_t f = 0; f < again.frame_count(); ++f) {
      EXPECT_LT(norm(again.root_position(f) - longer.root_position(f)), 1e-4);
      for (std::size_t j = 0; j < again.joint_count(); ++j)
        EXPECT_LT(angle_between(again.rotation(f, j), longer.rotation(f, j)), 1e-5);
    }
  }
}

TEST(FbxWrite, AJointThatLayersMoveIsNotChanged) {
  const std::string bytes = fbx_bytes(fbx_walker(), fbx_forms[0], 2);
  Take clip = read_fbx_clip(bytes);
  EXPECT_EQ(write_take(clip), bytes);
  clip.rotation(1, 1) = normalized(clip.rotation(1, 1) * small_turn);
  try {
    write_take(clip);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_STREQ(error.what(),
                 "take.fbx: 2 of 2 layers move \"Spine\"; merge the layers into one to change it");
  }
}

TEST(FbxWrite, AMovedJointBelowTurnedAndScaledModelsIsWhereItWasPut) {
  auto models = fbx_walker();
  models.insert(models.begin(), FbxTestModel{});
  models[0].name = "Armature";
  models[0].kind = "Null";
  models[0].properties = {fbx_vector("Lcl Rotation", -90, 20, 0),
                          fbx_vector("Lcl Scaling", 100, 100, 100)};
  for (auto& model : models) model.parent = model.parent < 0 ? 0 : model.parent + 1;
  models[0].parent = -1;
  Take clip = read_fbx_clip(fbx_bytes(models));
  clip.position(2, 0) += Vec3{30, -20, 10};
  const Take again = read_fbx_clip(write_take(clip));
  EXPECT_LT(norm(again.root_position(2) - clip.root_position(2)), 1e-3);
  EXPECT_EQ(again.root_position(3), clip.root_position(3));
}

Take made_clip() {
  Take clip;
  const auto zxy = make_channels(true, parse_rotation_order("ZXY"));
  const auto turns = make_channels(false, parse_rotation_order("XYZ"));
  clip.skeleton.add_joint("Hips", -1, {0, 90, 0}, zxy);
  clip.skeleton.add_joint("Knee", 0, {5, -40, 0}, {Channel::x_rotation});
  clip.skeleton.add_joint("Foot", 1, {0, -45, 2}, turns);
  clip.skeleton.rest_rotations[2] = exp(Vec3{0.3, 0.2, -0.1});
  clip.skeleton.end_sites.push_back({2, {0, -5, 12}, ""});
  clip.frame_rate_hz = 120;
  clip.metres_per_unit = 0.01;
  for (int f = 0; f < 9; ++f) {
    clip.rotations.push_back(exp(Vec3{0.1 * f, 0.2, -0.05 * f}));
    clip.rotations.push_back(exp(Vec3{0.2 * f, 0, 0}));
    clip.rotations.push_back(exp(Vec3{0, 0.1 * f, 0.3}));
    clip.positions.push_back({1.0 * f, 90 - 0.5 * f, 3});
  }
  return clip;
}

TEST(FbxWrite, ANewFileHoldsTheSamePoses) {
  const Take clip = made_clip();
  const std::string bytes = write_take(clip, "fbx");
  EXPECT_EQ(write_take(clip, "fbx"), bytes);
  const Take again = read_fbx_clip(bytes);
  EXPECT_EQ(again.skeleton.names, (std::vector<std::string>{"Hips", "Knee", "Foot", "Foot_end"}));
  EXPECT_DOUBLE_EQ(again.frame_rate_hz, 120);
  EXPECT_DOUBLE_EQ(again.metres_per_unit, 0.01);
  ASSERT_EQ(again.frame_count(), clip.frame_count());
  const auto wanted = joint_positions(clip, true), found = joint_positions(again, true);
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_LT(norm(found[i] - wanted[i]), 1e-4);
  EXPECT_EQ(again.skeleton.rotation_order(0), clip.skeleton.rotation_order(0));
  EXPECT_EQ(write_take(again), bytes);
}

TEST(FbxWrite, ANewFileIsMadeOfWholeRecords) {
  const std::string bytes = write_take(made_clip(), "fbx");
  std::set<std::string> paths;
  for (const WalkedRecord& record : walk_binary_fbx(bytes)) paths.insert(record.path);
  for (const char* path :
       {"/FBXHeaderExtension/FBXVersion", "/FileId", "/GlobalSettings/Properties70/P",
        "/Definitions/ObjectType/Count", "/Objects/Model/Properties70/P",
        "/Objects/NodeAttribute/TypeFlags", "/Objects/AnimationCurve/KeyTime", "/Connections/C",
        "/Takes/Take/LocalTime"}) {
    EXPECT_TRUE(paths.contains(path)) << path;
  }
}

TEST(FbxWrite, MarkersAreNullsAndComeBackAsMarkers) {
  Take clip = make_marker_take({"LASI", "RASI"}, 4, 100);
  clip.unit = "mm";
  for (std::size_t f = 0; f < 4; ++f) {
    clip.position(f, 0) = {100.0 + static_cast<double>(f), 900, 10};
    clip.observed[2 * f] = 1;
    clip.position(f, 1) = {-100, 900 - static_cast<double>(f), 10};
    clip.observed[2 * f + 1] = f == 2 ? 0 : 1;
  }
  const std::string bytes = write_take(clip, "fbx");
  const TakeResult result = read_fbx_take(bytes);
  const Take& again = result.take;
  EXPECT_EQ(again.names, clip.names);
  EXPECT_EQ(again.unit, "mm");
  EXPECT_DOUBLE_EQ(again.frame_rate_hz, 100);
  EXPECT_EQ(again.position(3, 0), clip.position(3, 0));
  EXPECT_EQ(again.position(2, 1), clip.position(1, 1));
  EXPECT_EQ(write_take(result.take, "fbx"), bytes);
}

// The same motion in version 6, whose curves are lists with letters.
std::vector<FbxNode> version_6_scene() {
  const auto text = [](const char* s) { return std::string(s); };
  const auto channel = [&](const char* name, std::vector<double> values) {
    FbxNode node{"Channel",
                 {text(name)},
                 {{"Default", {values.front()}, {}},
                  {"KeyVer", {4005}, {}},
                  {"KeyCount", {static_cast<std::int32_t>(values.size())}, {}},
                  {"Key", {}, {}}}};
    for (std::size_t k = 0; k < values.size(); ++k) {
      FbxNode& keys = node.children.back();
      keys.values.push_back(static_cast<std::int64_t>(k) * (fbx_test_second / 30));
      keys.values.push_back(values[k]);
      keys.values.push_back(FbxWord{'L'});
    }
    return node;
  };
  const std::string hips = fbx_object("Hips", "Model"), spine = fbx_object("Spine", "Model");
  const auto property = [&](const char* name, double x, double y, double z) {
    return FbxNode{"Property", {text(name), text(name), text("A+"), x, y, z}, {}};
  };
  FbxNode objects{"Objects",
                  {},
                  {{"Model",
                    {hips, text("Limb")},
                    {{"Properties60", {}, {property("Lcl Translation", 0, 90, 0)}}}},
                   {"Model",
                    {spine, text("Limb")},
                    {{"Properties60", {}, {property("Lcl Translation", 0, 20, 0)}}}}}};
  FbxNode links{"Connections", {}, {{"Connect", {text("OO"), spine, hips}, {}}}};
  FbxNode turns{"Channel",
                {text("R")},
                {channel("X", {0, 10, 20}), channel("Y", {1, 2, 3}), channel("Z", {0, 0.5, 0})}};
  FbxNode model{"Model", {hips}, {{"Channel", {text("Transform")}, {turns}}}};
  FbxNode takes{"Takes", {}, {{"Current", {text("walk")}, {}}, {"Take", {text("walk")}, {model}}}};
  return {{"FBXHeaderExtension", {}, {{"FBXVersion", {6100}, {}}}}, objects, links, takes};
}

TEST(FbxWrite, Version6IsRewrittenInPlaceToo) {
  for (const FbxForm& form : {FbxForm{"binary", 6100}, FbxForm{"text", 6100, true}}) {
    SCOPED_TRACE(form.title);
    const std::string bytes = FbxTestWriter(form).file(version_6_scene());
    Take clip = read_fbx_clip(bytes);
    ASSERT_EQ(clip.frame_count(), 3u);
    EXPECT_EQ(clip.skeleton.names, (std::vector<std::string>{"Hips", "Spine"}));
    EXPECT_EQ(write_take(clip), bytes);
    clip.rotation(1, 0) = normalized(clip.rotation(1, 0) * small_turn);
    const std::string written = write_take(clip);
    EXPECT_TRUE(form.is_text || written.size() == bytes.size());
    const Take again = read_fbx_clip(written);
    EXPECT_LT(angle_between(again.rotation(1, 0), clip.rotation(1, 0)), 1e-6);
    EXPECT_EQ(again.rotation(2, 0), clip.rotation(2, 0));
  }
}

TEST(FbxWrite, Version6TakesOtherFrames) {
  for (const FbxForm& form : {FbxForm{"binary", 6100}, FbxForm{"text", 6100, true}}) {
    SCOPED_TRACE(form.title);
    Take clip = read_fbx_clip(FbxTestWriter(form).file(version_6_scene()));
    clip.rotations.insert(clip.rotations.end(), {exp(Vec3{0.5, 0, 0}), Quat{}});
    clip.positions.push_back(clip.positions.back());
    const Take again = read_fbx_clip(write_take(clip));
    ASSERT_EQ(again.frame_count(), 4u);
    for (std::size_t f = 0; f < 4; ++f)
      EXPECT_LT(angle_between(again.rotation(f, 0), clip.rotation(f, 0)), 1e-6);
  }
}

}  // namespace
}  // namespace kinemend
