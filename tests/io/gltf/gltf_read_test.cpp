#include <fstream>
#include <sstream>

#include "gltf_support.hpp"
#include "kinemend/extend/motion.hpp"

namespace kinemend {
namespace {

using namespace test;
namespace fs = std::filesystem;

// The places of all nodes in each frame, computed by tools/reference/gltf_scenes.py.
struct PlacesOfNodes {
  double rate_hz = 0;
  std::size_t frames = 0;
  std::map<std::pair<std::size_t, std::string>, Vec3> places;
};

PlacesOfNodes places_in(const fs::path& path) {
  std::ifstream file(path);
  PlacesOfNodes table;
  char comma = 0;
  std::string line;
  std::getline(file, line);
  std::istringstream(line) >> table.rate_hz >> comma >> table.frames;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::size_t frame = 0;
    std::string name;
    Vec3 p;
    words >> frame >> comma;
    std::getline(words, name, ',');
    words >> p.x >> comma >> p.y >> comma >> p.z;
    table.places[{frame, name}] = p;
  }
  return table;
}

std::vector<std::string> placed_scenes() {
  std::vector<std::string> names;
  const fs::path folder = fs::path(KINEMEND_TEST_FIXTURES) / "gltf/positions";
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  EXPECT_GE(names.size(), 14u);
  return names;
}

void expect_placed(const Take& clip, const std::string& scene) {
  const PlacesOfNodes table =
      places_in(fs::path(KINEMEND_TEST_FIXTURES) / "gltf/positions" / (scene + ".csv"));
  ASSERT_EQ(clip.frame_count(), table.frames);
  EXPECT_EQ(clip.frame_rate_hz, table.rate_hz);
  // Below axes of different scales, the end of the head has no exact position.
  const bool with_ends = scene != "stretched";
  std::vector<std::string> names = clip.skeleton.names;
  for (const EndSite& site : clip.skeleton.end_sites) {
    if (with_ends) names.push_back(site.name);
  }
  const auto found = joint_positions(clip, with_ends);
  for (std::size_t f = 0; f < table.frames; ++f) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const Vec3 expected = table.places.at({f, names[i]});
      ASSERT_LT(norm(found[f * names.size() + i] - expected), 5e-6)
          << names[i] << " in frame " << f;
    }
  }
}

TEST(GltfReader, JointsAreWhereTheNodesOfTheSceneAre) {
  for (const std::string& scene : placed_scenes()) {
    SCOPED_TRACE(scene);
    ASSERT_NO_FATAL_FAILURE(expect_placed(read_scene(scene + ".glb"), scene));
    if (!fs::exists(scene_path(scene + ".gltf"))) continue;
    ASSERT_NO_FATAL_FAILURE(expect_placed(read_scene(scene + ".gltf"), scene));
  }
}

TEST(GltfReader, ABufferBesideTheTextIsFoundByItsEncodedName) {
  expect_placed(read_joints(scene_beside()).take, "plain");
}

TEST(GltfReader, TheJointsOfTheSkinAreJointsAndStaticNodesAboveThemAreNot) {
  const Take clip = read_scene("plain.glb");
  EXPECT_EQ(clip.skeleton.names, (std::vector<std::string>{"Hips", "Spine", "Head", "Leg"}));
  EXPECT_EQ(clip.skeleton.parents, (std::vector<std::int32_t>{-1, 0, 1, 0}));
  EXPECT_TRUE(clip.translated_joints.empty());
  ASSERT_EQ(clip.skeleton.end_sites.size(), 1u);
  EXPECT_EQ(clip.skeleton.end_sites[0].name, "Head_end");
  EXPECT_EQ(clip.skeleton.end_sites[0].parent, 2);
  EXPECT_EQ(clip.metres_per_unit, 1);
  EXPECT_EQ(clip.source.format, "glb");
}

TEST(GltfReader, WithoutASkinTheAnimatedNodesAreJoints) {
  const Take clip = read_scene("by_hand.glb");
  EXPECT_EQ(clip.skeleton.names, (std::vector<std::string>{"Hips", "Spine"}));
}

TEST(GltfReader, AnAnimationIsChosenByNameAndAnUnknownNameListsThoseThatThereAre) {
  ReadOptions options;
  options.animation = "run";
  const Take run = read_scene("two_animations.glb", options);
  const Take first = read_scene("two_animations.glb");
  EXPECT_NE(run.rotations[0], first.rotations[0]);
  options.animation = "walk";
  EXPECT_EQ(read_scene("two_animations.glb", options).rotations, first.rotations);
  options.animation = "swim";
  const std::string message =
      message_of([&] { read_scene("two_animations.glb", options); }, ErrorKind::usage);
  EXPECT_TRUE(message.ends_with(": no animation is called \"swim\"; there are: \"walk\", \"run\""))
      << message;
}

TEST(GltfReader, AnAnimationWithoutANameIsCalledByItsNumber) {
  ReadOptions options;
  options.animation = "#1";
  EXPECT_EQ(read_scene("interleaved.glb", options).frame_count(), 6u);
}

TEST(GltfReader, ASkinWithoutMotionIsATakeWithoutFrames) {
  const Take clip = read_scene("static.glb");
  EXPECT_EQ(clip.joint_count(), 4u);
  EXPECT_EQ(clip.frame_count(), 0u);
  EXPECT_EQ(write_take(clip), read_file(scene_path("static.glb")));
}

Diagnostics repairs_of_scene(const std::string& scene, const ReadOptions& options = {}) {
  return read_joints(scene_path(scene), options).diagnostics;
}

TEST(GltfReader, KeysThatLieOnNoFramesAreReadAtTheRateThatIsAskedFor) {
  EXPECT_EQ(repairs_of_scene("by_hand.glb").count("keys_resampled"), 1u);
  ReadOptions options;
  options.frame_rate_hz = 100;
  const Take clip = read_scene("by_hand.glb", options);
  EXPECT_EQ(clip.frame_rate_hz, 100);
  EXPECT_EQ(clip.frame_count(), 34u) << "0 to 0.3217 s";
  options.strict = true;
  EXPECT_NE(message_of([&] { repairs_of_scene("by_hand.glb", options); }, ErrorKind::quality_limit)
                .find("the keys lie on no common frames"),
            std::string::npos);
}

TEST(GltfReader, ChannelsWithKeysInSomeFramesOnlyAreNamed) {
  EXPECT_EQ(repairs_of_scene("posed.glb").count("keys_interpolated"), 1u);
  EXPECT_TRUE(repairs_of_scene("plain.glb").empty());
  EXPECT_TRUE(repairs_of_scene("scaled.glb").empty());
}

TEST(GltfReader, TurnsBelowAxesOfDifferentScalesAreNamed) {
  const Diagnostics repairs = repairs_of_scene("stretched.glb");
  ASSERT_EQ(repairs.count("scale_not_uniform"), 1u);
  EXPECT_NE(repairs.entries()[0].message.find("\"Head\""), std::string::npos);
}

TEST(GltfReader, AKeyThatIsNotFiniteHoldsTheOneBeforeAndIsNotObserved) {
  const Take clip = read_scene("not_finite.glb");
  const std::size_t head = joint_called(clip, "Head");
  EXPECT_EQ(clip.rotation(2, head), clip.rotation(1, head));
  for (std::size_t f = 0; f < 6; ++f) EXPECT_EQ(clip.is_observed(f, head), f != 2);
  EXPECT_EQ(repairs_of_scene("not_finite.glb").count("value_not_finite"), 1u);
}

std::string refusal_of_scene(const std::string& name) {
  const std::string folder = name.ends_with(".glb") ? "glb" : "gltf";
  const fs::path path = fs::path(KINEMEND_TEST_FIXTURES) / folder / "bad" / name;
  const std::string message = message_of([&] { read_take(path); }, ErrorKind::unreadable_input);
  return message.substr(std::min(message.size(), path.string().size() + 2));
}

TEST(GltfReader, DamagedAndHostileScenesAreRefusedWithTheByteAndTheReason) {
  EXPECT_EQ(refusal_of_scene("version_1.glb"), "byte 4: glTF of version 1: only 2 is read");
  EXPECT_EQ(refusal_of_scene("longer_than_the_file.glb"),
            "byte 8: the header states 2712 bytes, the file has 2704");
  EXPECT_EQ(refusal_of_scene("meshopt.glb"),
            "byte 752: bufferViews[1]: compressed by EXT_meshopt_compression: refused");
  EXPECT_EQ(refusal_of_scene("two_parents.gltf"), "byte 470: nodes[4]: a node with two parents");
  EXPECT_EQ(refusal_of_scene("cycle.gltf"), "byte 265: nodes[2]: a node that is its own ancestor");
  EXPECT_EQ(refusal_of_scene("beyond_the_view.gltf"),
            "byte 1352: accessors[3]: it reaches beyond its buffer view");
  EXPECT_EQ(refusal_of_scene("no_base64.gltf"), "byte 4507: buffers[0]: its data are not base64");
  for (const char* const name : {"parent_folder.gltf", "absolute.gltf", "elsewhere.gltf"}) {
    EXPECT_EQ(
        refusal_of_scene(name),
        "byte 4507: buffers[0]: its address is no path within the folder of the file: refused");
  }
  EXPECT_NE(refusal_of_scene("not_there.gltf").find("nowhere.bin is not there"), std::string::npos);
  EXPECT_EQ(refusal_of_scene("no_motion.gltf"),
            "byte 0: the scene has neither an animation nor a skin: there is no motion in it");
}

TEST(GltfReader, ContentDecidesBetweenBinaryAndText) {
  const std::string binary = read_file(scene_path("plain.glb"));
  const std::string text = read_file(scene_path("plain.gltf"));
  EXPECT_EQ(read_take(binary, "walk.vrm").take.source.format, "glb");
  EXPECT_EQ(read_take(text, "walk.gltf").take.source.format, "gltf");
  const TakeResult misnamed = read_take(text, "walk.glb");
  EXPECT_EQ(misnamed.take.source.format, "gltf");
  EXPECT_EQ(misnamed.diagnostics.count("extension_mismatch"), 1u);
}

// The plain scene as text with other times.
std::string with_times(const std::vector<float>& times) {
  const SceneParts plain = parts_of_glb(read_file(scene_path("plain.glb")));
  nlohmann::json json = plain.json;
  const auto input = json["animations"][0]["samplers"][0]["input"].get<std::size_t>();
  std::string binary = plain.binary;
  const std::size_t begin = plain.element(input, 0).first;
  std::memcpy(binary.data() + begin, times.data(), times.size() * sizeof(float));
  const auto size32 = [](std::size_t size) {
    const auto value = static_cast<std::uint32_t>(size);
    return std::string(reinterpret_cast<const char*>(&value), sizeof value);
  };
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string body = size32(text.size()) + "JSON" + text + size32(binary.size()) +
                           std::string("BIN\0", 4) + binary;
  return std::string("glTF") + size32(2) + size32(12 + body.size()) + body;
}

TEST(GltfReader, TheRateFollowsFromTheTimesOfTheKeys) {
  const auto rate_of = [](double rate_hz, double start_s, double decimals) {
    std::vector<float> times;
    for (int i = 0; i < 6; ++i) {
      const double t = start_s + i / rate_hz;
      times.push_back(static_cast<float>(decimals > 0 ? std::round(t * decimals) / decimals : t));
    }
    return read_glb_bytes(with_times(times));
  };
  for (const double rate_hz :
       {1.0, 12.0, 23.976, 24.0, 29.97, 30.0, 59.94, 60.0, 100.0, 119.88, 120.0, 240.0, 1000.0}) {
    EXPECT_EQ(rate_of(rate_hz, 0, 0).frame_rate_hz, rate_hz);
    EXPECT_EQ(rate_of(rate_hz, 3, 0).frame_rate_hz, rate_hz) << "from 3 s";
    EXPECT_EQ(rate_of(rate_hz, 3, 0).frame_count(), 6u);
  }
  const Take rounded = rate_of(30, 0, 10000);
  EXPECT_NEAR(rounded.frame_rate_hz, 30, 0.02) << "times with four decimals";
  EXPECT_EQ(rounded.frame_count(), 6u);
}

TEST(GltfReader, EscapedSlashesAndOddSpellingsOfTheTextAreRead) {
  const std::string text = read_file(scene_path("plain.gltf"));
  const Take plain = read_joints(text, "take.gltf").take;
  std::string escaped;
  for (const char c : text) escaped += c == '/' ? std::string("\\/") : std::string(1, c);
  std::string renamed = text;
  renamed.replace(renamed.find("\"buffers\""), 9, "\"\\u0062uffers\"");
  std::string quoting = text;
  quoting.insert(1, "\"extras\":\"say \\\"data:no\\\" here\",");
  for (const std::string& bytes : {escaped, renamed, quoting, "\xEF\xBB\xBF" + text}) {
    Take take = read_joints(bytes, "take.gltf").take;
    EXPECT_EQ(take.rotations, plain.rotations);
    EXPECT_TRUE(write_take(take) == bytes);
    turn(take, 1, "Leg", {0.1, 0, 0});
    expect_same_motion(take, read_joints(write_take(take), "take.gltf").take, 1e-6);
  }
}

TEST(GltfReader, InlineDataThatIsNoJsonStringIsRefused) {
  std::string text = read_file(scene_path("plain.gltf"));
  text.insert(text.find("base64,") + 7, "\\q");
  EXPECT_NE(message_of([&] { read_take(text, "take.gltf"); }, ErrorKind::unreadable_input)
                .find("its data are not base64"),
            std::string::npos);
}

TEST(GltfReader, TimesThatGoBackAreRefused) {
  const std::string message = message_of(
      [] {
        read_glb_bytes(with_times({0, 1, 2, 1.5F, 3, 4}));
      },
      ErrorKind::unreadable_input);
  EXPECT_NE(message.find("time 3 goes back"), std::string::npos) << message;
}

}  // namespace
}  // namespace kinemend
