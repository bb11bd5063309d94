// Tests of the glTF writer, which evaluate the nodes, animations and skins of a written file.
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/support.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;
using nlohmann::json;

std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Glb {
  json document;
  std::string binary;
};

// Reads the chunks of a file and checks every rule of the container.
Glb parse(const std::string& bytes) {
  Glb glb;
  EXPECT_EQ(bytes.substr(0, 4), "glTF");
  EXPECT_EQ(u32(bytes, 4), 2u);
  EXPECT_EQ(u32(bytes, 8), bytes.size());
  EXPECT_EQ(bytes.size() % 4, 0u);
  const std::size_t json_size = u32(bytes, 12);
  EXPECT_EQ(json_size % 4, 0u);
  EXPECT_EQ(bytes.substr(16, 4), "JSON");
  glb.document = json::parse(bytes.substr(20, json_size));
  const std::size_t at = 20 + json_size;
  EXPECT_EQ(bytes.substr(at + 4, 4), std::string("BIN\0", 4));
  EXPECT_EQ(u32(bytes, at) % 4, 0u);
  glb.binary = bytes.substr(at + 8);
  EXPECT_EQ(glb.binary.size(), u32(bytes, at));
  EXPECT_EQ(glb.document["buffers"][0]["byteLength"], glb.binary.size());
  return glb;
}

std::vector<float> floats(const Glb& glb, std::size_t accessor) {
  const json& a = glb.document["accessors"][accessor];
  const json& view = glb.document["bufferViews"][a["bufferView"].get<std::size_t>()];
  EXPECT_EQ(a["componentType"], 5126);
  const std::size_t offset = view["byteOffset"], size = view["byteLength"];
  EXPECT_EQ(offset % 4, 0u);
  EXPECT_LE(offset + size, glb.binary.size());
  std::vector<float> values(size / sizeof(float));
  std::memcpy(values.data(), glb.binary.data() + offset, size);
  const std::map<std::string, std::size_t> components{
      {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const std::size_t width = components.at(a["type"]);
  EXPECT_EQ(a["count"].get<std::size_t>() * width, values.size());
  if (a.contains("min")) {
    for (std::size_t c = 0; c < width; ++c) {
      float least = values[c], most = values[c];
      for (std::size_t i = c; i < values.size(); i += width) {
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
      }
      EXPECT_EQ(a["min"][c].get<float>(), least);
      EXPECT_EQ(a["max"][c].get<float>(), most);
    }
  }
  return values;
}

// World positions of all nodes at a key frame, computed from the file's numbers only.
std::vector<Vec3> node_positions(const Glb& glb, std::size_t frame) {
  const json& nodes = glb.document["nodes"];
  std::vector<Vec3> translations(nodes.size());
  std::vector<Quat> rotations(nodes.size());
  std::vector<std::int64_t> parents(nodes.size(), -1);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].contains("translation")) {
      const auto t = nodes[n]["translation"].get<std::vector<double>>();
      translations[n] = {t[0], t[1], t[2]};
    }
    if (nodes[n].contains("rotation")) {
      const auto q = nodes[n]["rotation"].get<std::vector<double>>();
      rotations[n] = {q[3], q[0], q[1], q[2]};
    }
    if (!nodes[n].contains("children")) continue;
    for (const std::size_t child : nodes[n]["children"])
      parents[child] = static_cast<std::int64_t>(n);
  }
  const json& animation = glb.document["animations"][0];
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const auto values = floats(glb, sampler["output"]);
    const std::size_t node = channel["target"]["node"];
    if (channel["target"]["path"] == "translation") {
      const float* t = values.data() + 3 * frame;
      translations[node] = {t[0], t[1], t[2]};
    } else if (channel["target"]["path"] == "rotation") {
      const float* q = values.data() + 4 * frame;
      rotations[node] = {q[3], q[0], q[1], q[2]};
    }
  }
  std::vector<Vec3> world(nodes.size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Vec3 v = translations[n];
    for (auto p = parents[n]; p >= 0; p = parents[static_cast<std::size_t>(p)])
      v = translations[static_cast<std::size_t>(p)] +
          rotate(rotations[static_cast<std::size_t>(p)], v);
    world[n] = v;
  }
  return world;
}

Take random_clip() {
  Take clip;
  clip.frame_rate_hz = 60;
  clip.metres_per_unit = 0.01;
  const RotationOrder order = parse_rotation_order("ZXY");
  clip.skeleton.add_joint("Hips", -1, {1, 95, 2}, make_channels(true, order));
  clip.skeleton.add_joint("Spine", 0, {0, 20, 1}, make_channels(false, order));
  clip.skeleton.add_joint("Head \"top\"", 1, {0, 30, 0}, make_channels(true, order));
  clip.skeleton.add_joint("Leg", 0, {9, -40, 0}, make_channels(false, order));
  clip.skeleton.add_joint("Foot", 3, {0, -45, 0}, make_channels(false, order));
  clip.skeleton.end_sites = {{2, {0, 15, 3}, ""}, {4, {0, -5, 12}, "Toe"}};
  clip.translated_joints = {2};
  Random random(4);
  for (Quat& rest : clip.skeleton.rest_rotations)
    rest = exp({random.normal(), random.normal(), random.normal()});
  for (std::size_t f = 0; f < 20; ++f) {
    clip.positions.push_back({random.normal(), 90 + random.normal(), random.normal()});
    clip.positions.push_back({random.normal(), 30, random.normal()});
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const Quat q = exp({random.normal(), random.normal(), random.normal()});
      clip.rotations.push_back(random.chance(0.5) ? q : -q);
    }
  }
  return clip;
}

TEST(GlbWriter, NodesAndAnimationGiveTheJointPositionsInMetres) {
  const Take clip = random_clip();
  const Glb glb = parse(write_take(clip, "glb"));
  const std::size_t points = clip.joint_count() + clip.skeleton.end_sites.size();
  const auto expected = joint_positions(clip, true);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto found = node_positions(glb, f);
    for (std::size_t i = 0; i < points; ++i)
      ASSERT_LT(norm(found[i] - 0.01 * expected[f * points + i]), 1e-6) << f << " " << i;
  }
}

TEST(GlbWriter, TimesAreSecondsAndSignsContinue) {
  const Take clip = random_clip();
  const Glb glb = parse(write_take(clip, "glb"));
  const json& animation = glb.document["animations"][0];
  std::size_t rotations = 0;
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    const auto times = floats(glb, sampler["input"]);
    ASSERT_EQ(times.size(), 20u);
    for (std::size_t f = 0; f < times.size(); ++f)
      EXPECT_FLOAT_EQ(times[f], static_cast<float>(f) / 60);
    EXPECT_TRUE(glb.document["accessors"][sampler["input"].get<std::size_t>()].contains("max"));
    EXPECT_EQ(sampler["interpolation"], "LINEAR");
    if (channel["target"]["path"] != "rotation") continue;
    ++rotations;
    const auto q = floats(glb, sampler["output"]);
    for (std::size_t i = 4; i < q.size(); i += 4) {
      EXPECT_GE(q[i] * q[i - 4] + q[i + 1] * q[i - 3] + q[i + 2] * q[i - 2] + q[i + 3] * q[i - 1],
                0);
      EXPECT_NEAR(q[i] * q[i] + q[i + 1] * q[i + 1] + q[i + 2] * q[i + 2] + q[i + 3] * q[i + 3], 1,
                  1e-6);
    }
  }
  EXPECT_EQ(rotations, clip.joint_count());
}

// Inverse bind matrices move the rest pose of each joint to the origin.
TEST(GlbWriter, TheSkinIsBoundToTheRestPose) {
  Take clip = random_clip();
  const Glb glb = parse(write_take(clip, "glb"));
  const json& skin = glb.document["skins"][0];
  ASSERT_EQ(skin["joints"].size(), clip.joint_count());
  const auto matrices = floats(glb, skin["inverseBindMatrices"]);
  for (Quat& q : clip.rotations) q = {};
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    clip.root_position(f) = clip.skeleton.offsets[0];
    clip.position(f, 1) = clip.skeleton.offsets[2];
  }
  const Pose rest = forward_kinematics(clip, 0);
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const float* m = matrices.data() + 16 * j;
    const auto apply = [&](Vec3 v) {
      return Vec3{m[0] * v.x + m[4] * v.y + m[8] * v.z + m[12],
                  m[1] * v.x + m[5] * v.y + m[9] * v.z + m[13],
                  m[2] * v.x + m[6] * v.y + m[10] * v.z + m[14]};
    };
    const Vec3 place = 0.01 * rest.positions[j];
    EXPECT_LT(norm(apply(place)), 1e-6);
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
      EXPECT_LT(norm(apply(place + rotate(rest.rotations[j], axis)) - axis), 1e-6);
    EXPECT_EQ(m[3], 0);
    EXPECT_EQ(m[15], 1);
  }
}

TEST(GlbWriter, BonesReachFromJointToChild) {
  const Take clip = random_clip();
  const Glb glb = parse(write_take(clip, "glb"));
  const json& primitive = glb.document["meshes"][0]["primitives"][0];
  const auto positions = floats(glb, primitive["attributes"]["POSITION"]);
  const auto normals = floats(glb, primitive["attributes"]["NORMAL"]);
  // Four bones between joints and two to end sites, eight triangles each.
  EXPECT_EQ(positions.size(), 6u * 8 * 9);
  EXPECT_EQ(normals.size(), positions.size());
  for (std::size_t i = 0; i < normals.size(); i += 3)
    EXPECT_NEAR(std::hypot(normals[i], normals[i + 1], normals[i + 2]), 1, 1e-5);
  EXPECT_TRUE(
      glb.document["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()].contains(
          "min"));
}

TEST(GlbWriter, AGuessedUnitMakesAPerson) {
  Take clip = read_joints(std::filesystem::path(KINEMEND_TAKES) / "walk.bvh").take;
  const auto unit = guess_length_unit(clip.skeleton);
  ASSERT_TRUE(unit);
  const Glb glb = parse(write_take(clip, "glb"));
  const auto found = node_positions(glb, 0);
  const auto expected = joint_positions(clip, true);
  EXPECT_LT(norm(found[5] - unit->metres * expected[5]), 1e-5);
}

TEST(GlbWriter, NamesThatAreNotUtf8LoseTheirBadBytes) {
  Take clip = random_clip();
  clip.skeleton.names[1] = "Sp\xFFine";
  EXPECT_EQ(parse(write_take(clip, "glb")).document["nodes"][1]["name"], "Spine");
}

TEST(GlbWriter, MarkersMoveAndVanishWhereTheyAreMissing) {
  Take clip = make_marker_take({"A", "never", "B"}, 4, 100);
  clip.unit = "mm";
  for (std::size_t f = 0; f < 4; ++f) {
    clip.position(f, 0) = {1000.0 * static_cast<double>(f), 500, 0};
    clip.observed[3 * f] = 1;
  }
  clip.position(2, 2) = {0, 0, 250};
  clip.observed[3 * 2 + 2] = 1;
  const Glb glb = parse(write_take(clip, "glb"));
  const json& nodes = glb.document["nodes"];
  ASSERT_EQ(nodes.size(), 3u) << "two markers and their group";
  EXPECT_EQ(nodes[0]["name"], "A");
  EXPECT_EQ(nodes[1]["name"], "B");
  EXPECT_LT(norm(node_positions(glb, 3)[0] - Vec3{3, 0.5, 0}), 1e-6);
  EXPECT_LT(norm(node_positions(glb, 0)[1] - Vec3{0, 0, 0.25}), 1e-6) << "held";
  const json& animation = glb.document["animations"][0];
  std::size_t scales = 0;
  for (const json& channel : animation["channels"]) {
    if (channel["target"]["path"] != "scale") continue;
    ++scales;
    EXPECT_EQ(channel["target"]["node"], 1);
    const json& sampler = animation["samplers"][channel["sampler"].get<std::size_t>()];
    EXPECT_EQ(sampler["interpolation"], "STEP");
    EXPECT_EQ(floats(glb, sampler["output"]),
              (std::vector<float>{0, 0, 0, 0, 0, 0, 1, 1, 1, 0, 0, 0}));
  }
  EXPECT_EQ(scales, 1u);
}

}  // namespace
}  // namespace kinemend
