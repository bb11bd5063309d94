// An output never replaces a file that the run reads or another of its outputs.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using RunFiles = Program;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(RunFiles, AnOutputNeverReplacesASideFileThatTheRunReads) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  put(folder / "settings.toml", "strength = 0.5\n");
  ASSERT_EQ(run({"contacts", "walk.bvh", "-o", "walk.contacts"}).code, 0);
  noisy("noisy.bvh");
  ASSERT_EQ(run({"check", "noisy.bvh", "--report", "noise.json"}).code, 0);
  ASSERT_EQ(run({"train", "wiener", "walk.bvh", "-o", "walk.kmodel"}).code, 0);
  put(folder / "map.csv", "LeftFoot,LeftFoot\n");
  const std::vector<std::vector<std::string>> commands = {
      {"clean", "walk.bvh", "--gaps", "gaps.csv"},
      {"clean", "walk.bvh", "--config", "settings.toml"},
      {"clean", "walk.bvh", "--contacts", "walk.contacts"},
      {"clean", "walk.bvh", "--noise", "noise.json"},
      {"clean", "walk.bvh", "--method", "wiener", "--model", "walk.kmodel"},
      {"clean", "walk.bvh", "--feet", "auto", "--map", "map.csv"},
      {"fill", "walk.bvh", "--gaps", "gaps.csv"},
      {"contacts", "walk.bvh", "--map", "map.csv"}};
  for (const std::vector<std::string>& command : commands) {
    const std::string side = command.back(), option = command[command.size() - 2];
    const std::string before = contents(folder / side);
    fs::remove(folder / "link");
    fs::create_symlink(side, folder / "link");
    for (const std::string& name :
         {side, "./" + side, (folder / side).string(), std::string("link")}) {
      std::vector<std::string> words = command;
      words.insert(words.end(), {"-o", name, "--force"});
      const Ran ran = run(words);
      EXPECT_EQ(ran.code, 2) << command[0] << " " << option << " " << name << ran.err;
      EXPECT_THAT(ran.err, AllOf(HasSubstr("would be lost"), HasSubstr("(" + option + ")")));
      EXPECT_EQ(contents(folder / side), before) << command[0] << " " << option << " " << name;
    }
  }
}

TEST_F(RunFiles, ATakeMayBeCleanedInPlaceButNotOverAnotherTakeOfTheRun) {
  noisy("walk.bvh", "1");
  fs::create_directory(folder / "other");
  synth("other/walk.bvh", "walk", "1");
  fs::create_symlink("walk.bvh", folder / "link.bvh");
  const std::string before = contents(folder / "walk.bvh");
  const Ran over = run({"clean", "link.bvh", "other/walk.bvh", "--output-dir", ".", "--force"});
  EXPECT_EQ(over.code, 2);
  EXPECT_THAT(over.err, HasSubstr("walk.bvh is also read by this run (IN)"));
  EXPECT_EQ(contents(folder / "walk.bvh"), before);
  const std::string noisy_take = contents(folder / "walk.bvh");
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "walk.bvh", "--force"}).code, 0);
  EXPECT_NE(contents(folder / "walk.bvh"), noisy_take);
}

TEST_F(RunFiles, ALinkToAFileThatDoesNotExistYetIsThatFile) {
  noisy("walk.bvh", "1");
  fs::create_symlink("result.bvh", folder / "report.json");
  const Ran ran = run({"clean", "walk.bvh", "-o", "result.bvh", "--report", "report.json"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("--report: report.json is also written by --output"));
  EXPECT_FALSE(fs::exists(folder / "result.bvh"));
}

TEST_F(RunFiles, DevicesTakeAnyNumberOfOutputs) {
  noisy("walk.bvh", "1");
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "/dev/null", "--report", "/dev/null"}).code, 0);
}

TEST_F(RunFiles, BothAPageAndJsonAreWrittenByEveryCommandThatReports) {
  noisy("walk.bvh", "1");
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  const std::vector<std::vector<std::string>> commands = {
      {"clean", "walk.bvh", "-o", "out.bvh"},
      {"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh"},
      {"check", "walk.bvh"},
      {"compare", "truth.bvh", "walk.bvh"}};
  for (std::vector<std::string> words : commands) {
    const std::string name = words[0];
    words.insert(words.end(), {"--report", name + ".json", "--report", name + ".html"});
    const Ran ran = run(words);
    ASSERT_EQ(ran.code, 0) << name << ran.err;
    EXPECT_EQ(Json::parse(contents(folder / (name + ".json")))["command"], name);
    EXPECT_THAT(contents(folder / (name + ".html")), testing::StartsWith("<!")) << name;
  }
  const Ran twice = run({"check", "walk.bvh", "--report", "a.json", "--report", "./a.json"});
  EXPECT_EQ(twice.code, 2);
  EXPECT_THAT(twice.err, HasSubstr("also written by --report"));
}

TEST_F(RunFiles, ATakeWhoseNameBeginsWithADashIsReadAfterTwoDashes) {
  noisy("walk.bvh", "1");
  fs::copy_file(folder / "walk.bvh", folder / "-dash.bvh");
  const Ran cleaned = run({"clean", "--", "-dash.bvh"});
  EXPECT_EQ(cleaned.code, 0) << cleaned.err;
  EXPECT_TRUE(fs::exists(folder / "-dash.clean.bvh"));
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  const Ran filled = run({"fill", "--gaps", "gaps.csv", "--", "-dash.bvh"});
  EXPECT_EQ(filled.code, 0) << filled.err;
  EXPECT_TRUE(fs::exists(folder / "-dash.filled.bvh"));
}

}  // namespace
}  // namespace kinemend::test
