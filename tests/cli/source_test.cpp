// Tests of --source: its effect, the source that a file states, and the reports.
#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class SourceOption : public Program {
 protected:
  // Runs `clean` on a take and returns the result.
  std::string cleaned(const std::string& take, std::vector<std::string> more) {
    const std::string output = "out" + fs::path(take).extension().string();
    std::vector<std::string> words = {"clean", take, "-o", output, "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    text_ = ran.out;
    return contents(folder / output);
  }
  Json entry(std::vector<std::string> words) {
    words.emplace_back("--json");
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out)["takes"][0];
  }
  // Writes a glTF take whose exporter name belongs to a mocap suit.
  void of_a_suit(const std::string& name) {
    noisy("walk.bvh", "1");
    ASSERT_EQ(run({"convert", "walk.bvh", "blank.gltf"}).code, 0);
    std::string text = contents(folder / "blank.gltf");
    const std::size_t at = text.find("\"Kinemend ");
    ASSERT_NE(at, std::string::npos);
    put(folder / name, text.replace(at, text.find('"', at + 1) + 1 - at, "\"Axis Studio\""));
  }

  std::string text_;
};

TEST_F(SourceOption, UnknownIsTheSameAsNoOption) {
  noisy("walk.bvh", "1");
  put(folder / "plate.trc", plate_take());
  for (const char* take : {"walk.bvh", "plate.trc"}) {
    for (const char* method : {"learned", "auto", "median"}) {
      const std::vector<std::string> words = {"-m", method};
      EXPECT_EQ(cleaned(take, {"-m", method, "--source", "unknown"}), cleaned(take, words));
      EXPECT_THAT(text_, HasSubstr("\n  source: not known\n"));
    }
  }
}

TEST_F(SourceOption, KeysComeBackUnlessAMethodIsNamedThatDoesNotMeasure) {
  noisy("walk.bvh", "1");
  const std::string before = contents(folder / "walk.bvh");
  EXPECT_NE(cleaned("walk.bvh", {}), before);
  for (const char* method : {"learned", "auto"}) {
    EXPECT_EQ(cleaned("walk.bvh", {"-m", method, "--source", "keyframed"}), before);
    EXPECT_THAT(text_, HasSubstr("\n  source: keyframed (given)\n"));
    EXPECT_THAT(text_, Not(HasSubstr("jitter")));
  }
  EXPECT_EQ(cleaned("walk.bvh", {"-m", "median", "--source", "keyframed"}),
            cleaned("walk.bvh", {"-m", "median"}));
}

TEST_F(SourceOption, TheFileSaysItWhereNobodyDoes) {
  of_a_suit("suit.gltf");
  const std::string reason = "read from the file, software: Axis Studio";
  for (const std::string command : {"clean", "check"}) {
    std::vector<std::string> words = {command, "suit.gltf"};
    if (command == "clean") words.emplace_back("--dry-run");
    Json take = entry(words);
    EXPECT_EQ(take["source"], "suit") << command;
    EXPECT_EQ(take["source_reason"], reason) << command;
    words.insert(words.end(), {"--source", "keyframed"});
    take = entry(words);
    EXPECT_EQ(take["source"], "keyframed") << command;
    EXPECT_EQ(take["source_reason"], "given") << command;
    words.pop_back();
    words.emplace_back("unknown");
    EXPECT_EQ(entry(words)["source"], "suit") << command;
  }
  EXPECT_THAT(run({"check", "suit.gltf"}).out, HasSubstr(" suit (" + reason + ")\n"));
  EXPECT_EQ(cleaned("suit.gltf", {}), cleaned("suit.gltf", {"--source", "suit"}));
  EXPECT_EQ(entry({"clean", "blank.gltf", "--dry-run"})["source_reason"], "not known");
}

TEST_F(SourceOption, IsASettingOfConfigurationFiles) {
  noisy("walk.bvh", "1");
  put(folder / "keys.toml", "source = \"keyframed\"\n");
  EXPECT_EQ(cleaned("walk.bvh", {"--config", "keys.toml"}), contents(folder / "walk.bvh"));
  EXPECT_NE(cleaned("walk.bvh", {"--config", "keys.toml", "--source", "optical"}),
            contents(folder / "walk.bvh"));
}

TEST_F(SourceOption, BatchesHaveIt) {
  noisy("walk.bvh", "1");
  fs::create_directory(folder / "takes");
  fs::copy(folder / "walk.bvh", folder / "takes" / "walk.bvh");
  ASSERT_EQ(run({"batch", "takes", "-o", "done", "--source", "keyframed"}).code, 0);
  EXPECT_EQ(contents(folder / "done" / "walk.bvh"), contents(folder / "walk.bvh"));
  // Another source gives another result.
  ASSERT_EQ(run({"batch", "takes", "-o", "done", "--source", "video"}).code, 0);
  EXPECT_NE(contents(folder / "done" / "walk.bvh"), contents(folder / "walk.bvh"));
}

TEST_F(SourceOption, StreamsOfKeysPass) {
  noisy("walk.bvh", "1");
  Setting setting;
  setting.in = contents(folder / "walk.bvh");
  const auto streamed = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"stream", "-m", "learned"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words, setting);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const std::string plain = streamed({});
  EXPECT_EQ(streamed({"--source", "unknown"}), plain);
  EXPECT_NE(streamed({"--source", "video"}), plain);
  put(folder / "keys.bvh", streamed({"--source", "keyframed"}));
  const Ran compared = run({"compare", "walk.bvh", "keys.bvh", "--json"});
  ASSERT_EQ(compared.code, 0) << compared.err;
  EXPECT_LT(Json::parse(compared.out)["takes"][0]["figures"]["rms_deg"], 1e-4);
}

}  // namespace
}  // namespace kinemend::test
