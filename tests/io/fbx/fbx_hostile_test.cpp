#include "fbx_support.hpp"
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

// One file in every form, and a file with pivots, layers and keys of every kind.
std::vector<std::string> hostile_fbx_files() {
  std::vector<std::string> files;
  for (const FbxForm& form : fbx_forms) files.push_back(fbx_bytes(fbx_walker(), form));
  auto models = fbx_walker();
  models[1].rotation[0].flags = {1032, 264, 2, 258, 50332680, 520};
  models[1].rotation[0].data.assign(24, 0.25f);
  models[1].rotation[1] = {{0, 90}, 0, fbx_test_second / 6};
  models[0].scaling = {{{1, 1, 2, 1, 1, 1}}, {{1, 1, 2, 1, 1, 1}}, {{1, 1, 2, 1, 1, 1}}};
  files.push_back(fbx_bytes(models, fbx_forms[0], 2));
  files.push_back(fbx_bytes(models, fbx_forms.back(), 2));
  return files;
}

TEST(HostileFbx, CutAtAnyLength) {
  for (const std::string& bytes : hostile_fbx_files()) {
    for (std::size_t length = 0; length <= bytes.size(); length += 1 + length / 512) {
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes.substr(0, length), "fbx")) << length;
    }
  }
}

TEST(HostileFbx, PatchedAtAnyByte) {
  Random random(5);
  const std::string likely("\0\1\2\x0D\x19\x7F\x80\xFFSLDIlfdi{}:*,;\"", 23);
  for (const std::string& bytes : hostile_fbx_files()) {
    for (std::size_t at = 0; at < bytes.size(); at += 1 + random.below(20)) {
      std::string patched = bytes;
      const std::size_t count = 1 + random.below(4);
      for (std::size_t i = 0; i < count && at + i < bytes.size(); ++i) {
        patched[at + i] = random.chance(0.6) ? likely[random.below(likely.size())]
                                             : static_cast<char>(random.below(256));
      }
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(patched, "fbx")) << at;
    }
  }
}

TEST(HostileFbx, PiecesMovedAndRepeated) {
  Random random(6);
  const auto files = hostile_fbx_files();
  for (int i = 0; i < 1500; ++i) {
    std::string bytes = files[random.below(files.size())];
    const std::string& other = files[random.below(files.size())];
    const std::size_t from = random.below(other.size());
    bytes.insert(random.below(bytes.size()), other.substr(from, random.below(200)));
    ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes, "fbx")) << i;
  }
}

// Changing a damaged file gives a file or a one-line error.
TEST(HostileFbx, DamagedFilesCanBeChanged) {
  Random random(7);
  const auto files = hostile_fbx_files();
  for (int i = 0; i < 1500; ++i) {
    std::string bytes = files[random.below(files.size())];
    bytes[random.below(bytes.size())] = static_cast<char>(random.below(256));
    try {
      ReadOptions options;
      options.format = "fbx";
      TakeResult result = read_take(bytes, "take.fbx", options);
      if (Take* const clip = result.take.has_joints() ? &result.take : nullptr) {
        for (Quat& q : clip->rotations) {
          if (random.chance(0.3)) q = normalized(q * exp(Vec3{0.1, -0.2, 0.05}));
        }
        const Take again = read_take(write_take(*clip), "again.fbx", options).take;
        EXPECT_EQ(again.frame_count(), clip->frame_count());
      }
    } catch (const Error& error) {
      EXPECT_EQ(std::string(error.what()).find("again.fbx"), std::string::npos) << error.what();
    }
  }
}

std::string deep_text(std::size_t depth) {
  return "; FBX 7.4.0 project file\n" + repeated("a: {", depth) + repeated("}", depth);
}

std::string deep_binary(std::size_t depth) {
  std::vector<FbxNode> nodes{{"a", {}, {}}};
  for (std::size_t d = 0; d < depth; ++d) {
    FbxNode outer{"a", {}, std::move(nodes)};
    nodes.clear();
    nodes.push_back(std::move(outer));
  }
  return FbxTestWriter(fbx_forms[0]).file(nodes);
}

// A chain of models, each the child of the previous one.
std::string deep_models(std::size_t depth) {
  std::vector<FbxTestModel> models(depth);
  for (std::size_t m = 0; m < depth; ++m) models[m].parent = static_cast<std::int32_t>(m) - 1;
  return fbx_bytes(models);
}

// Many keys that compress well.
std::string packed_keys(std::size_t keys, std::int64_t step) {
  auto models = fbx_walker();
  for (auto& curve : models[1].rotation) {
    curve.values.assign(keys, 1.5f);
    curve.values[1] = 2;
    curve.step = step;
  }
  return fbx_bytes(models, fbx_forms[1]);
}

std::string many_links(std::size_t links) {
  FbxTestScene scene(fbx_walker());
  for (FbxNode& node : scene.nodes) {
    if (node.name != "Connections") continue;
    const std::vector<FbxNode> known = node.children;
    for (std::size_t i = 0; i < links; ++i) node.children.push_back(known[i % known.size()]);
  }
  return FbxTestWriter(fbx_forms[0]).file(scene.nodes);
}

TEST(HostileFbx, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::string good = fbx_bytes(fbx_walker());
  const std::string head = good.substr(0, 27);
  expect_quick_verdicts("fbx", {{"noise", noise},
                                {"noise behind a head", head + noise},
                                {"zero bytes", head + std::string(1 << 20, '\0')},
                                {"deep text", deep_text(200000)},
                                {"deep records", deep_binary(600)},
                                {"deep models", deep_models(600)},
                                {"braces", "; FBX 7.4.0\n" + repeated("{", 1 << 20)},
                                {"names", "; FBX 7.4.0\n" + repeated("a:", 1 << 19)},
                                {"numbers", "; FBX 7.4.0\na: " + repeated("1,", 1 << 19)},
                                {"packed keys", packed_keys(100000, 1539538600)},
                                {"far keys", packed_keys(50, std::int64_t{1} << 55)},
                                {"dense keys", packed_keys(100000, 1)},
                                {"many connections", many_links(20000)}});
}

TEST(HostileFbx, CountsAreCheckedBeforeMemoryIsTaken) {
  std::string bytes = fbx_bytes(fbx_walker(), fbx_forms[1]);
  const std::size_t at = bytes.find("KeyValueFloatf") + 14;
  bytes.replace(at, 4, "\xFF\xFF\xFF\x3F");
  ReadOptions options;
  options.format = "fbx";
  const std::size_t peak =
      peak_memory([&] { EXPECT_THROW(read_take(bytes, "take.fbx", options), Error); });
  EXPECT_LT(peak, memory_allowed);
}

}  // namespace
}  // namespace kinemend
