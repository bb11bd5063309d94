// Tests of files with several takes: one is selected, or all are cleaned.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

class SceneTakes : public Program {
 protected:
  // Writes a scene that holds its animation twice.
  void SetUp() override {
    Program::SetUp();
    const auto path = std::filesystem::path(KINEMEND_TEST_FIXTURES) / "gltf/good/plain.gltf";
    Json scene = Json::parse(contents(path));
    Json& animations = scene["animations"];
    animations.push_back(animations[0]);
    animations[0]["name"] = "Walk";
    animations[1]["name"] = "Run";
    put(folder / "hero.gltf", scene.dump());
  }
  double difference(const std::string& other, const std::string& take) {
    const Ran ran = run({"compare", "hero.gltf", other, "--take", take, "--json"});
    return Json::parse(ran.out)["takes"][0]["figures"]["geodesic_rms_deg"];
  }
};

TEST_F(SceneTakes, AreListed) {
  EXPECT_THAT(run({"info", "hero.gltf"}).out, HasSubstr("\"Walk\", \"Run\"; read: \"Walk\""));
}

TEST_F(SceneTakes, TheOneThatIsNamedIsCleanedAlone) {
  const Ran ran = run({"clean", "hero.gltf", "--take", "Run", "-m", "gaussian", "-o", "one.gltf"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("hero.gltf (Run): "));
  EXPECT_EQ(difference("one.gltf", "Walk"), 0);
  EXPECT_GT(difference("one.gltf", "Run"), 0.01);
}

TEST_F(SceneTakes, AllAreCleanedAndReported) {
  const Ran ran =
      run({"clean", "hero.gltf", "--all-takes", "-m", "gaussian", "-o", "all.gltf", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json takes = Json::parse(ran.out)["takes"];
  ASSERT_EQ(takes.size(), 2u);
  EXPECT_EQ(takes[0]["animation"], "Walk");
  EXPECT_EQ(takes[1]["animation"], "Run");
  for (const char* const take : {"Walk", "Run"}) EXPECT_GT(difference("all.gltf", take), 0.01);
}

TEST_F(SceneTakes, AnUnknownNameIsAnErrorThatListsThem) {
  const Ran ran = run({"clean", "hero.gltf", "--take", "Jump"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("no animation is called \"Jump\"; there are: \"Walk\", \"Run\""));
  EXPECT_EQ(run({"clean", "hero.gltf", "--all-takes", "--take", "Run"}).code, 2);
}

TEST_F(SceneTakes, AllStayInTheFormatOfTheInput) {
  const Ran ran = run({"clean", "hero.gltf", "--all-takes", "-o", "hero.bvh"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("--all-takes writes the format of the input, gltf"));
}

}  // namespace
}  // namespace kinemend::test
