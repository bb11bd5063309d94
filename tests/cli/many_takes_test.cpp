// Tests of commands with several takes: names of results, results of an earlier run, folders; and
// of files with several takes, of which one is selected or all are cleaned.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using ManyTakes = Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(ManyTakes, ASecondRunSkipsTheResultsOfTheFirst) {
  for (const char* name : {"a.bvh", "b.bvh"}) put(folder / name, hand_take());
  ASSERT_EQ(run({"clean", "a.bvh", "b.bvh"}).code, 0);
  const std::vector<std::string> all = {"clean", "a.bvh", "a.clean.bvh", "b.bvh", "b.clean.bvh"};
  const Ran second = run(all);
  EXPECT_EQ(second.code, 4);
  EXPECT_EQ(second.err,
            "kinemend: skipped 2 results of an earlier run: a.clean.bvh, b.clean.bvh\n"
            "kinemend: a.clean.bvh: exists already (--force overwrites it)\n"
            "kinemend: b.clean.bvh: exists already (--force overwrites it)\n"
            "kinemend: 2 of 2 takes failed\n");
  put(folder / "a.clean.bvh", "older");
  std::vector<std::string> forced = all;
  forced.emplace_back("--force");
  const Ran third = run(forced);
  EXPECT_EQ(third.code, 0) << third.err;
  EXPECT_THAT(contents(folder / "a.clean.bvh"), testing::StartsWith("HIERARCHY"));
  EXPECT_FALSE(fs::exists(folder / "a.clean.clean.bvh"));
}

TEST_F(ManyTakes, AResultThatIsNamedAloneIsCleanedAgain) {
  put(folder / "a.clean.bvh", hand_take());
  EXPECT_EQ(run({"clean", "a.clean.bvh"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "a.clean.clean.bvh"));
  put(folder / "b.clean.bvh", hand_take());
  const Ran both = run({"clean", "a.clean.bvh", "b.clean.bvh", "--output-dir", "again"});
  EXPECT_EQ(both.code, 0);
  EXPECT_EQ(both.err, "");
  EXPECT_TRUE(fs::exists(folder / "again/b.clean.bvh"));
}

TEST_F(ManyTakes, FillSkipsItsOwnResultsAndFillsWhatIsCleaned) {
  put(folder / "a.bvh", hand_take());
  put(folder / "a.clean.bvh", hand_take());
  put(folder / "a.filled.bvh", "older");
  const Ran ran = run({"fill", "a.bvh", "a.clean.bvh", "a.filled.bvh", "--output-dir", "out"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.err, "kinemend: skipped 1 result of an earlier run: a.filled.bvh\n");
  EXPECT_TRUE(fs::exists(folder / "out/a.bvh"));
  EXPECT_TRUE(fs::exists(folder / "out/a.clean.bvh"));
}

TEST_F(ManyTakes, OneBadTakeStopsNeitherFillNorConvert) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", "nothing");
  put(folder / "c.bvh", hand_take());
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fill", "a.bvh", "b.bvh", "c.bvh", "--output-dir", "fill"},
        std::vector<std::string>{"convert", "a.bvh", "b.bvh", "c.bvh", "--output-dir",
                                 "convert"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 3) << words[0];
    EXPECT_THAT(ran.err, AllOf(HasSubstr("b.bvh:"), HasSubstr("1 of 3 takes failed"))) << words[0];
    EXPECT_TRUE(fs::exists(folder / words[0] / "a.bvh")) << words[0];
    EXPECT_FALSE(fs::exists(folder / words[0] / "b.bvh")) << words[0];
    EXPECT_EQ(contents(folder / words[0] / "c.bvh"), hand_take()) << words[0];
  }
}

TEST_F(ManyTakes, FillReportsEachTakeAndTakesNoPlanForSeveral) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", hand_take());
  put(folder / "gaps.csv", "LeftArm,4,5\n");
  const Ran ran = run({"fill", "a.bvh", "b.bvh", "--gaps", "gaps.csv", "--output-dir", "out",
                       "--report", "r.json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto told = lines_of(ran.out);
  ASSERT_EQ(told.size(), 2u) << ran.out;
  EXPECT_THAT(told[1], AllOf(testing::StartsWith("b.bvh: 1 gap"),
                             testing::EndsWith("; written to out/b.bvh")));
  EXPECT_EQ(Json::parse(contents(folder / "r.json"))["takes"].size(), 2u);
  const Ran alone = run({"fill", "a.bvh", "--gaps", "gaps.csv", "-o", "alone.bvh"});
  EXPECT_EQ(contents(folder / "out/a.bvh"), contents(folder / "alone.bvh"));
  const Ran planned = run({"fill", "a.bvh", "b.bvh", "--plan-out", "plan.csv"});
  EXPECT_EQ(planned.code, 2);
  EXPECT_THAT(planned.err, HasSubstr("--plan and --plan-out are for one take"));
}

TEST_F(ManyTakes, ConvertNamesResultsAfterTheFormat) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", hand_take());
  const Ran beside = run({"convert", "a.bvh", "b.bvh", "--to", "trc", "-q"});
  EXPECT_EQ(beside.code, 0) << beside.err;
  EXPECT_EQ(beside.err, "");
  EXPECT_TRUE(fs::exists(folder / "b.trc"));
  EXPECT_EQ(contents(folder / "b.bvh"), hand_take()) << "an input, though two words are IN OUT";
  const Ran again = run({"convert", "a.bvh", "a.trc", "b.bvh", "b.trc", "--to", "trc", "--force"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("skipped 2 results of an earlier run: a.trc, b.trc"));
  EXPECT_EQ(run({"convert", "a.bvh", "--to", "csv", "--output-dir", "tables"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "tables/a.csv"));
}

TEST_F(ManyTakes, ConvertOfOneTakeIsStillInAndOut) {
  put(folder / "a.bvh", hand_take());
  EXPECT_EQ(run({"convert", "a.bvh", "b.csv"}).code, 0);
  EXPECT_EQ(run({"convert", "a.bvh", "plain", "--to", "bvh"}).code, 0);
  EXPECT_EQ(contents(folder / "plain"), hand_take());
  EXPECT_EQ(run({"convert", "a.bvh", "b.csv"}).code, 4) << "it exists";
  EXPECT_THAT(run({"convert", "a.bvh"}).err, HasSubstr("OUT is missing"));
  EXPECT_THAT(run({"convert", "a.bvh", "b.bvh", "c.bvh"}).err, HasSubstr("need --output-dir"));
}

TEST_F(ManyTakes, AnOutputThatIsAFolderTakesResultsUnderTheirNames) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", hand_take());
  fs::create_directory(folder / "there");
  for (const char* command : {"clean", "fill", "convert"}) {
    EXPECT_EQ(run({command, "a.bvh", "b.bvh", "-o", "there", "--force"}).code, 0) << command;
    EXPECT_EQ(run({command, "a.bvh", "-o", std::string(command) + "/"}).code, 0) << command;
    EXPECT_TRUE(fs::exists(folder / command / "a.bvh")) << command;
    const Ran ran = run({command, "a.bvh", "b.bvh", "-o", "new"});
    EXPECT_EQ(ran.code, 2) << command;
    EXPECT_THAT(ran.err, HasSubstr("--output-dir new writes them into a folder"));
  }
  EXPECT_TRUE(fs::exists(folder / "there/b.bvh"));
}

/// The input is not read, and no output is announced.
TEST_F(ManyTakes, AMissingFolderIsFoundBeforeTheWork) {
  put(folder / "a.bvh", "nothing that can be read");
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"clean", "a.bvh"},
                                             {"fill", "a.bvh"},
                                             {"convert", "a.bvh"},
                                             {"contacts", "a.bvh"},
                                             {"plot", "a.bvh"},
                                             {"corrupt", "a.bvh", "--damage", "gaussian"},
                                             {"synth", "walk"},
                                             {"train", "example", "a.bvh"}}) {
    std::vector<std::string> all = words;
    const std::string name = words[0] == "plot" ? "new/x.svg" : "new/x.bvh";
    all.insert(all.end(), {"-o", name});
    const Ran ran = run(all);
    EXPECT_EQ(ran.code, 4) << words[0] << ran.err;
    EXPECT_EQ(ran.err, "kinemend: " + name + ": there is no folder new; make it first\n")
        << words[0];
    EXPECT_EQ(ran.out, "") << words[0];
  }
  EXPECT_FALSE(fs::exists(folder / "new"));
}

/// A limit on file sizes simulates a full disk.
TEST_F(ManyTakes, WhatCouldNotBeWrittenIsNotSaidToBeWritten) {
  noisy("a.bvh", "2");
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  Setting small;
  small.most_file_bytes = 20000;
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"clean", "a.bvh", "-o", "x.bvh"},
           {"fill", "a.bvh", "--gaps", "gaps.csv", "-o", "x.bvh"},
           {"corrupt", "a.bvh", "--damage", "gaussian", "-o", "x.bvh"},
           {"convert", "a.bvh", "x.bvh", "--plain"}}) {
    const Ran ran = run(words, small);
    EXPECT_EQ(ran.code, 4) << words[0] << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("x.bvh: File too large")) << words[0];
    EXPECT_EQ(ran.out, "") << words[0];
    EXPECT_FALSE(fs::exists(folder / "x.bvh")) << words[0];
  }
}

TEST_F(ManyTakes, AFolderIsCheckedTakeByTakeAndNamesBatch) {
  fs::create_directories(folder / "raw/deep");
  put(folder / "raw/a.bvh", hand_take());
  put(folder / "raw/deep/b.bvh", hand_take());
  const Ran ran = run({"check", "raw"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("raw/a.bvh: "), HasSubstr("raw/deep/b.bvh: ")));
  EXPECT_EQ(ran.err, "kinemend: to clean the takes in raw use: kinemend batch raw -o OUT\n");
  const Ran quiet = run({"check", "raw", "-q"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  fs::create_directory(folder / "empty");
  EXPECT_THAT(run({"check", "empty"}).err, HasSubstr("empty: holds no take"));
  EXPECT_THAT(run({"fill", "raw"}).err,
              HasSubstr("kinemend batch raw -o OUT --no-clean --fill auto"));
  EXPECT_THAT(run({"convert", "raw", "--to", "trc"}).err,
              HasSubstr("kinemend batch raw -o OUT --no-clean --to FORMAT"));
}

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
