#include "gltf_support.hpp"
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

const std::string likely_in_scenes("\0\1\2\x7F\x80\xFF\"{}[],:0159-eE.", 22);

// Cuts each fixture at every `step` bytes only, because there are many fixtures of a few thousand
// bytes.
void expect_sane_when_cut_at_some_lengths(const std::string& format, std::size_t step) {
  std::size_t length = 0;
  for (const std::string& bytes : fixture_bytes(format)) {
    for (length %= step; length <= bytes.size(); length += step)
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes.substr(0, length), format)) << length;
  }
}

void expect_sane_when_patched_at_some_bytes(const std::string& format, int count) {
  Random random(21);
  const auto all = fixture_bytes(format);
  for (int i = 0; i < count; ++i) {
    std::string bytes = all[random.below(all.size())];
    for (std::size_t n = 1 + random.below(3); n > 0; --n) {
      bytes[random.below(bytes.size())] =
          random.chance(0.7) ? likely_in_scenes[random.below(likely_in_scenes.size())]
                             : static_cast<char>(random.below(256));
    }
    ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes, format)) << i;
  }
}

TEST(HostileGltf, EveryFixtureIsReadOrRefused) {
  for (const char* const format : {"glb", "gltf"}) {
    for (const std::string& bytes : fixture_bytes(format)) expect_take_or_error(bytes, format);
  }
}

TEST(HostileGltf, CutAtManyLengths) {
  expect_sane_when_cut_at_some_lengths("glb", 13);
  expect_sane_when_cut_at_some_lengths("gltf", 31);
}

TEST(HostileGltf, PatchedAtManyBytes) {
  expect_sane_when_patched_at_some_bytes("glb", 3000);
  expect_sane_when_patched_at_some_bytes("gltf", 1500);
}

TEST(HostileGltf, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("gltf"); }

// If a reader accepts a damaged scene, it can still be written when a joint changes.
TEST(HostileGltf, DamagedScenesThatAreReadCanBeChanged) {
  Random random(22);
  const auto all = fixture_bytes("glb");
  std::size_t changed = 0;
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = all[random.below(all.size())];
    bytes[random.below(bytes.size())] = likely_in_scenes[random.below(likely_in_scenes.size())];
    try {
      TakeResult read = read_take(bytes, "take.glb");
      Take* const clip = &read.take;
      if (!clip->has_joints() || clip->frame_count() == 0) continue;
      for (Quat& q : clip->rotations) q = normalized(q * exp({0.01, 0.02, 0}));
      for (Vec3& p : clip->positions) p += Vec3{0.1, 0, 0};
      const TakeResult again = read_take(write_take(read.take), "take.glb");
      ASSERT_EQ(again.take.joint_count(), clip->joint_count());
      ++changed;
    } catch (const Error& error) {
      // Writing may fail only for a scale of 0 above a joint, or for keys outside the loaded
      // buffers.
      const bool is_lawful =
          error.kind() == ErrorKind::unreadable_input || error.kind() == ErrorKind::usage;
      ASSERT_TRUE(is_lawful) << error.what();
    }
  }
  EXPECT_GT(changed, 500u);
}

std::string scene_of(const std::string& rest) {
  return R"({"asset":{"version":"2.0"},)" + rest + "}";
}

std::string many(const std::string& piece, std::size_t count) {
  std::string text = piece;
  for (std::size_t i = 1; i < count; ++i) text += "," + piece;
  return text;
}

std::string chain_of_nodes(std::size_t count) {
  std::string nodes;
  for (std::size_t i = 0; i + 1 < count; ++i)
    nodes += R"({"children":[)" + std::to_string(i + 1) + "]},";
  return nodes + "{}";
}

TEST(HostileGltf, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string moved =
      R"("animations":[{"samplers":[{"input":0,"output":1}],"channels":[{"sampler":0,"target":{"node":0,"path":"translation"}}]}])";
  const auto zeros = [&](const std::string& count) {
    return scene_of(R"("nodes":[{}],"accessors":[{"componentType":5126,"count":)" + count +
                    R"(,"type":"SCALAR"},{"componentType":5126,"count":)" + count +
                    R"(,"type":"VEC3"}],)" + moved);
  };
  std::string leaves, joints;
  for (int i = 1; i < 30000; ++i) {
    leaves += (i == 1 ? "" : ",") + std::to_string(i);
    joints += (i == 1 ? "" : ",") + std::to_string(i);
  }
  expect_quick_verdicts(
      "gltf",
      {{"nested arrays", scene_of(R"("extras":)" + std::string(1 << 20, '['))},
       {"nested objects", scene_of(R"("extras":)" + repeated("{\"a\":", 200000))},
       {"many nodes", scene_of(R"("nodes":[)" + many("{}", 300000) + "]")},
       {"many roots with a skin",
        scene_of(R"("nodes":[)" + many("{}", 60000) + R"(],"skins":[{"joints":[0]}])")},
       {"a long chain",
        scene_of(R"("nodes":[)" + chain_of_nodes(50000) + R"(],"skins":[{"joints":[0,49999]}])")},
       {"a long chain above a joint",
        scene_of(R"("nodes":[)" + chain_of_nodes(50000) + R"(],"skins":[{"joints":[49999]}])")},
       {"a wide tree", scene_of(R"("nodes":[{"children":[)" + leaves + "]}," + many("{}", 29999) +
                                R"(],"skins":[{"joints":[)" + joints + "]}]")},
       {"many skins",
        scene_of(R"("nodes":[{}],"skins":[)" + many(R"({"joints":[0]})", 60000) + "]")},
       {"many accessors",
        scene_of(R"("accessors":[)" +
                 many(R"({"componentType":5126,"count":1,"type":"VEC3"})", 20000) + "]")},
       {"zeros without bytes", zeros("60000")},
       {"too many zeros", zeros("1000000000000")},
       {"many animations", scene_of(R"("nodes":[)" + many("{}", 60000) + R"(],"animations":[)" +
                                    many(R"({"channels":[],"samplers":[]})", 20000) + "]")},
       {"spaces", std::string(1 << 20, ' ')},
       {"a long string", scene_of(R"("extras":")" + std::string(1 << 20, 'a') + "\"")}});
}

}  // namespace
}  // namespace kinemend
