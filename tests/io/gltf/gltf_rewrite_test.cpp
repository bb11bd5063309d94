#include <fstream>

#include "gltf_support.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;
using nlohmann::json;
using Changed = std::set<std::pair<int, std::size_t>>;

std::vector<fs::path> good_scenes() {
  std::vector<fs::path> paths;
  for (const char* const format : {"glb", "gltf"}) {
    const fs::path folder = fs::path(KINEMEND_TEST_FIXTURES) / format / "good";
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  }
  EXPECT_GE(paths.size(), 20u);
  return paths;
}

TEST(GltfRewrite, AnUnchangedTakeComesBackToTheByte) {
  for (const fs::path& path : good_scenes()) {
    if (path.stem() == "not_finite") continue;
    const TakeResult read = read_take(path);
    EXPECT_TRUE(write_take(read.take) == read_file(path)) << path;
    EXPECT_TRUE(lost_in_writing(read.take, "glb").empty()) << path;
  }
}

TEST(GltfRewrite, OnlyTheKeysThatChangeGetOtherBytes) {
  for (const char* const scene : {"plain.glb", "shorts.glb", "bytes.glb", "two_animations.glb",
                                  "scaled.glb", "avatar.glb", "unknown_chunk.glb"}) {
    SCOPED_TRACE(scene);
    const std::string bytes = read_file(scene_path(scene));
    Take clip = read_glb_bytes(bytes);
    turn(clip, 2, "Spine", {0.3, -0.2, 0.1});
    turn(clip, 5, "Spine", {-0.1, 0.2, 0.3});
    const std::string written = write_take(clip);
    const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
    const int spine = static_cast<int>(before.output("Spine", "rotation"));
    EXPECT_EQ(changed_elements(before, after), (Changed{{spine, 2}, {spine, 5}}));
    const double tolerance = scene == std::string("bytes.glb")    ? 0.02
                             : scene == std::string("shorts.glb") ? 1e-4
                                                                  : 1e-6;
    expect_same_motion(clip, read_glb_bytes(written), tolerance);
  }
}

// JSON outside the range of the changed accessor is the same, member by member.
TEST(GltfRewrite, StatedRangesFollowTheValuesAndTheRestOfTheTextStays) {
  const std::string bytes = read_file(scene_path("plain.glb"));
  Take clip = read_glb_bytes(bytes);
  turn(clip, 3, "Leg", {2, 0, 0});
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(write_take(clip));
  const std::size_t leg = before.output("Leg", "rotation");
  json expected = before.json;
  for (const char* const end : {"min", "max"}) {
    for (std::size_t c = 0; c < 4; ++c) {
      float value = after.floats(leg, 0)[c];
      for (std::size_t i = 1; i < 6; ++i) {
        const float next = after.floats(leg, i)[c];
        value = end == std::string("min") ? std::min(value, next) : std::max(value, next);
      }
      EXPECT_EQ(after.json["accessors"][leg][end][c].get<float>(), value);
    }
    expected["accessors"][leg][end] = after.json["accessors"][leg][end];
  }
  EXPECT_NE(after.json, before.json);
  EXPECT_EQ(after.json, expected);
}

TEST(GltfRewrite, TheOppositeQuaternionIsNoChange) {
  const std::string bytes = read_file(scene_path("plain.glb"));
  Take clip = read_glb_bytes(bytes);
  for (Quat& q : clip.rotations) q = -q;
  EXPECT_TRUE(write_take(clip) == bytes);
}

TEST(GltfRewrite, ChangedKeysKeepTheSignOfTheirSource) {
  for (const fs::path& path : good_scenes()) {
    if (path.extension() != ".glb" || path.stem() != "plain") continue;
    Take clip = read_joints(path).take;
    for (std::size_t i = 0; i < clip.rotations.size(); ++i)
      clip.rotations[i] =
          (i % 2 == 0 ? 1.0 : -1.0) * normalized(clip.rotations[i] * exp({0.1, 0, 0}));
    const SceneParts before = parts_of_glb(read_file(path)), after = parts_of_glb(write_take(clip));
    for (const char* const joint : {"Hips", "Spine", "Head", "Leg"}) {
      const std::size_t output = before.output(joint, "rotation");
      for (std::size_t i = 0; i < 6; ++i) {
        const auto a = before.floats(output, i), b = after.floats(output, i);
        EXPECT_GT(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], 0.9) << joint;
      }
    }
  }
}

TEST(GltfRewrite, InterleavedKeysAreWrittenBetweenTheOthers) {
  const std::string bytes = read_file(scene_path("interleaved.glb"));
  Take clip = read_glb_bytes(bytes);
  turn(clip, 1, "Hips", {0, 0.2, 0});
  clip.root_position(4) += Vec3{0.5, 0, 0};
  const std::string written = write_take(clip);
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
  EXPECT_EQ(before.json, after.json);
  const int turns = static_cast<int>(before.output("Hips", "rotation"));
  const int moves = static_cast<int>(before.output("Hips", "translation"));
  EXPECT_EQ(changed_elements(before, after), (Changed{{turns, 1}, {moves, 4}}));
  expect_same_motion(clip, read_glb_bytes(written), 1e-6);
}

TEST(GltfRewrite, ASparseValueIsWrittenWhereItIsStored) {
  const std::string bytes = read_file(scene_path("sparse.glb"));
  Take clip = read_glb_bytes(bytes);
  turn(clip, 4, "Spine", {0, 0.2, 0});
  turn(clip, 3, "Spine", {0, 0.2, 0});
  const std::string written = write_take(clip);
  EXPECT_EQ(parts_of_glb(written).json, parts_of_glb(bytes).json);
  EXPECT_EQ(written.size(), bytes.size());
  expect_same_motion(clip, read_glb_bytes(written), 1e-6);
}

TEST(GltfRewrite, AZeroThatIsNotStoredGetsNewKeys) {
  const std::string bytes = read_file(scene_path("sparse.glb"));
  Take clip = read_glb_bytes(bytes);
  clip.root_position(1) = {1, 2, 3};
  const std::string written = write_take(clip);
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
  EXPECT_EQ(after.json["accessors"].size(), before.json["accessors"].size() + 1);
  EXPECT_EQ(changed_elements(before, after), Changed{});
  expect_same_motion(clip, read_glb_bytes(written), 1e-6);
}

TEST(GltfRewrite, OfSplinesTheTangentsBesideAChangeFollow) {
  const std::string bytes = read_file(scene_path("spline.glb"));
  Take clip = read_glb_bytes(bytes);
  turn(clip, 1, "Head", {0, 0.2, 0});
  const std::string written = write_take(clip);
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
  const int head = static_cast<int>(before.output("Head", "rotation"));
  // A key has an in-tangent, a value and an out-tangent, in this order.
  EXPECT_EQ(changed_elements(before, after),
            (Changed{{head, 0}, {head, 2}, {head, 3}, {head, 4}, {head, 5}, {head, 6}, {head, 8}}));
  const auto a = after.floats(static_cast<std::size_t>(head), 1);
  const auto c = after.floats(static_cast<std::size_t>(head), 7);
  const auto slope = after.floats(static_cast<std::size_t>(head), 5);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(slope[i], (c[i] - a[i]) * 24 / 2, 1e-4);
  expect_same_motion(clip, read_glb_bytes(written), 1e-6);
}

TEST(GltfRewrite, ASharedAccessorStaysAndTheChangedJointGetsItsOwn) {
  const std::string bytes = read_file(scene_path("shared.glb"));
  for (const char* const joint : {"Hips", "Spine", "Head"}) {
    SCOPED_TRACE(joint);
    Take clip = read_glb_bytes(bytes);
    turn(clip, 3, joint, {0.2, 0, 0});
    const std::string written = write_take(clip);
    const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
    EXPECT_EQ(changed_elements(before, after), Changed{}) << "nothing that was there";
    EXPECT_EQ(after.json["accessors"].size(), before.json["accessors"].size() + 1);
    expect_same_motion(clip, read_glb_bytes(written), 1e-6);
  }
}

TEST(GltfRewrite, AChannelWithoutAKeyInEachFrameIsWrittenWithThem) {
  for (const char* const scene : {"posed.glb", "by_hand.glb"}) {
    SCOPED_TRACE(scene);
    const std::string bytes = read_file(scene_path(scene));
    Take clip = read_glb_bytes(bytes);
    turn(clip, 6, "Spine", {0.2, 0, 0});
    turn(clip, 3, "Hips", {0.2, 0, 0});
    const std::string written = write_take(clip);
    const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
    EXPECT_EQ(changed_elements(before, after), Changed{});
    EXPECT_EQ(after.accessor(after.output("Spine", "rotation"))["count"], clip.frame_count());
    EXPECT_EQ(
        after.json["buffers"][0]["byteLength"].get<std::size_t>() + 3 - after.binary.size() < 4,
        true);
    // The clips have different rates because of single keys; the frames are the same.
    expect_same_motion(clip, read_glb_bytes(written), 2e-6);
  }
}

TEST(GltfRewrite, ATurnOfANodeThatWasNotAnimatedAddsAChannel) {
  const std::string bytes = read_file(scene_path("posed.glb"));
  Take clip = read_glb_bytes(bytes);
  turn(clip, 2, "Hips", {0, 0, 0.5});
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(write_take(clip));
  EXPECT_EQ(after.json["animations"][0]["channels"].size(),
            before.json["animations"][0]["channels"].size() + 1);
  EXPECT_EQ(after.accessor(after.output("Hips", "rotation"))["count"], 13);
}

TEST(GltfRewrite, ARootBelowAScaledAndTurnedArmatureMovesInMetres) {
  Take clip = read_scene("scaled.glb");
  const auto before = joint_positions(clip);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) clip.root_position(f) += Vec3{1, 0.5, -0.25};
  const Take again = read_glb_bytes(write_take(clip));
  const auto after = joint_positions(again);
  for (std::size_t i = 0; i < before.size(); ++i)
    ASSERT_LT(norm(after[i] - before[i] - Vec3{1, 0.5, -0.25}), 1e-6);
}

TEST(GltfRewrite, AKeyThatWasNotFiniteIsWrittenAsWhatStandsInForIt) {
  const std::string bytes = read_file(scene_path("not_finite.glb"));
  const std::string written = write_take(read_glb_bytes(bytes));
  const SceneParts before = parts_of_glb(bytes), after = parts_of_glb(written);
  const std::size_t head = before.output("Head", "rotation");
  EXPECT_EQ(changed_elements(before, after), (Changed{{static_cast<int>(head), 2}}));
  EXPECT_EQ(after.floats(head, 2), after.floats(head, 1));
  EXPECT_TRUE(write_take(read_glb_bytes(written)) == written);
}

TEST(GltfRewrite, OtherFramesAreWrittenAsNewKeysInTheSameScene) {
  Take clip = read_scene("plain.glb");
  Take twice = clip;
  twice.frame_rate_hz = 60;
  twice.rotations.clear();
  twice.positions.clear();
  for (std::size_t f = 0; f < 11; ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j)
      twice.rotations.push_back(clip.rotation(f / 2, j));
    twice.positions.push_back(clip.root_position(f / 2));
  }
  const std::string written = write_take(twice);
  const Take again = read_glb_bytes(written);
  EXPECT_EQ(again.frame_rate_hz, 60);
  expect_same_motion(twice, again, 1e-6);
  EXPECT_EQ(parts_of_glb(written).json["meshes"], parts_of_glb(write_take(clip)).json["meshes"]);
}

TEST(GltfRewrite, AnotherSkeletonMakesANewFileAndSaysWhatIsLost) {
  Take clip = read_scene("plain.glb");
  clip.skeleton.names[1] = "Back";
  const Diagnostics losses = lost_in_writing(clip, "glb");
  ASSERT_EQ(losses.count("not_kept"), 1u);
  EXPECT_EQ(losses.entries()[0].message,
            "a new file is written: meshes, skins, other nodes and properties are left out");
  EXPECT_EQ(parts_of_glb(write_take(clip)).json["nodes"][1]["name"], "Back");
}

TEST(GltfRewrite, BinaryAndTextTurnIntoEachOther) {
  const TakeResult binary = read_take(scene_path("avatar.glb"));
  const std::string text = write_take(binary.take, "gltf");
  const TakeResult back = read_take(text, "take.gltf");
  EXPECT_EQ(back.take.rotations, binary.take.rotations);
  const std::string again = write_take(back.take, "glb");
  const SceneParts first = parts_of_glb(write_take(binary.take)), second = parts_of_glb(again);
  EXPECT_EQ(first.binary, second.binary);
  EXPECT_EQ(first.json, second.json);
  EXPECT_EQ(json::parse(text)["extensions"], first.json["extensions"]);
}

TEST(GltfRewrite, AChangedTextKeepsItsLayout) {
  const std::string text = read_file(scene_path("plain.gltf"));
  Take clip = read_joints(text, "take.gltf").take;
  turn(clip, 3, "Leg", {0.1, 0, 0});
  const std::string written = write_take(clip);
  // The range of one accessor is written in one line of the text, and the data differ.
  const std::size_t data = text.find("\"uri\""), new_data = written.find("\"uri\"");
  EXPECT_EQ(text.substr(0, text.find("\"min\"")), written.substr(0, written.find("\"min\"")));
  EXPECT_EQ(text.substr(text.find_last_of('\n', data)).size(),
            written.substr(written.find_last_of('\n', new_data)).size());
  expect_same_motion(clip, read_joints(written, "take.gltf").take, 1e-6);
}

class GltfBeside : public ::testing::Test {
 protected:
  void SetUp() override {
    // Two of these tests may run in parallel, in two processes.
    folder = fs::path(::testing::TempDir()) /
             (std::string("gltf_beside_") +
              ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder);
    fs::create_directories(folder / "source");
    fs::create_directories(folder / "output");
    fs::copy(scene_beside(), folder / "source/walk cycle.gltf");
    fs::path bin = scene_beside();
    fs::copy(bin.replace_extension(".bin"), folder / "source/walk cycle.bin");
    result = read_take(folder / "source/walk cycle.gltf");
  }
  void TearDown() override { fs::remove_all(folder); }

  TakeFiles write(const fs::path& output) {
    const TakeFiles files = files_of_take(result.take, "gltf", output);
    write_file(output, files.bytes, true);
    for (const SideFile& file : files.beside) write_file(file.path, file.bytes, true);
    return files;
  }

  fs::path folder;
  TakeResult result;
};

TEST_F(GltfBeside, AnUnchangedTakeBringsItsBufferAlongIntoAnotherFolderOnly) {
  EXPECT_TRUE(write(folder / "source/copy.gltf").beside.empty());
  const TakeFiles files = write(folder / "output/copy.gltf");
  EXPECT_EQ(files.bytes, read_file(folder / "source/walk cycle.gltf"));
  ASSERT_EQ(files.beside.size(), 1u);
  EXPECT_EQ(files.beside[0].path, folder / "output/walk cycle.bin");
  read_take(folder / "output/copy.gltf");
}

TEST_F(GltfBeside, AChangedBufferGetsTheNameOfTheOutput) {
  const std::string old = read_file(folder / "source/walk cycle.bin");
  Take& clip = result.take;
  turn(clip, 1, "Head", {0.4, 0, 0});
  const TakeFiles files = write(folder / "source/clean.gltf");
  ASSERT_EQ(files.beside.size(), 1u);
  EXPECT_EQ(files.beside[0].path, folder / "source/clean.bin");
  EXPECT_EQ(read_file(folder / "source/walk cycle.bin"), old);
  EXPECT_EQ(json::parse(files.bytes)["buffers"][0]["uri"], "clean.bin");
  expect_same_motion(clip, read_joints(folder / "source/clean.gltf").take, 1e-6);
}

TEST_F(GltfBeside, ANameThatTheSourceNeedsIsNotTaken) {
  turn(result.take, 1, "Head", {0.4, 0, 0});
  const TakeFiles other = files_of_take(result.take, "gltf", folder / "source/walk cycle.x.gltf");
  EXPECT_EQ(other.beside.at(0).path, folder / "source/walk cycle.x.bin");
  const TakeFiles same = files_of_take(result.take, "gltf", folder / "source/walk cycle.GLTF");
  EXPECT_EQ(same.beside.at(0).path, folder / "source/walk cycle_2.bin");
  EXPECT_EQ(json::parse(same.bytes)["buffers"][0]["uri"], "walk%20cycle_2.bin");
}

TEST_F(GltfBeside, WithoutAPlaceAChangedBufferGoesIntoTheText) {
  Take& clip = result.take;
  turn(clip, 1, "Head", {0.4, 0, 0});
  const std::string text = write_take(result.take);
  EXPECT_EQ(json::parse(text)["buffers"][0]["uri"].get<std::string>().substr(0, 5), "data:");
  expect_same_motion(clip, read_joints(text, "elsewhere.gltf").take, 1e-6);
}

}  // namespace
}  // namespace kinemend
