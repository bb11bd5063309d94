// Tests of unreadable inputs (exit code 3), unwritable outputs (4), and the files that a run leaves
// on disk.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Files = Program;
using testing::ElementsAre;
using testing::HasSubstr;

TEST_F(Files, AResultWithoutANameGoesBesideItsInput) {
  noisy("walk.bvh");
  EXPECT_EQ(run({"clean", "walk.bvh"}).code, 0);
  EXPECT_THAT(files(), ElementsAre("truth.bvh", "walk.bvh", "walk.clean.bvh"));
}

TEST_F(Files, ADanglingLinkLeadsToANewFile) {
  noisy("walk.bvh");
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/target.bvh", folder / "link.bvh");
  const Ran ran = run({"clean", "walk.bvh", "-o", "link.bvh"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(fs::is_symlink(folder / "link.bvh"));
  EXPECT_FALSE(fs::is_symlink(folder / "deep/target.bvh"));
  EXPECT_THAT(contents(folder / "deep/target.bvh"), testing::StartsWith("HIERARCHY"));
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "link.bvh"}).code, 4) << "now it is there";
  fs::create_symlink("round.bvh", folder / "round.bvh");
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "round.bvh"}).code, 4);
}

TEST_F(Files, AReportNeverReplacesAnInput) {
  noisy("walk.bvh");
  const std::string take = contents(folder / "walk.bvh");
  fs::create_hard_link(folder / "walk.bvh", folder / "same.bvh");
  put(folder / "gaps.csv", "Head,3,5\n");
  put(folder / "lab.toml", "strength = 1\n");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"clean", "walk.bvh", "-o", "out.bvh", "--report", "walk.bvh"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--report", "./walk.bvh"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--report", "same.bvh"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--report", "out.bvh"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--config", "lab.toml", "--report", "lab.toml"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--gaps", "gaps.csv", "--report", "gaps.csv"},
           {"fill", "walk.bvh", "-o", "out.bvh", "--report", "walk.bvh"},
           {"fill", "walk.bvh", "-o", "out.bvh", "--report", "out.bvh"},
           {"fill", "walk.bvh", "-o", "out.bvh", "--gaps", "gaps.csv", "--report", "gaps.csv"},
           {"fill", "walk.bvh", "-o", "out.bvh", "--report", "plan.csv", "--plan-out", "plan.csv"},
           {"check", "walk.bvh", "--gaps-out", "walk.bvh"},
           {"check", "walk.bvh", "--report", "same.bvh"},
           {"check", "walk.bvh", "--map", "gaps.csv", "--report", "gaps.csv"},
           {"compare", "walk.bvh", "same.bvh", "--report", "walk.bvh"},
           {"compare", "walk.bvh", "same.bvh", "--report", "./same.bvh"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--noise", "gaps.csv", "--report", "gaps.csv"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--feet=auto", "--map=gaps.csv",
            "--report=gaps.csv"},
           {"clean", "walk.bvh", "-o", "out.bvh", "--asf", "gaps.csv", "--report", "gaps.csv"},
           {"batch", "walk.bvh", "-o", "out", "--config", "lab.toml", "--report", "lab.toml"},
           {"batch", "walk.bvh", "-o", "out", "--report", "walk.bvh"},
           {"contacts", "walk.bvh", "-o", "walk.bvh"},
           {"train", "example", "walk.bvh", "-o", "walk.bvh"}}) {
    std::vector<std::string> forced = words;
    forced.push_back("--force");
    const Ran ran = run(forced);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_THAT(ran.err, IsOneLine());
    EXPECT_EQ(contents(folder / "walk.bvh"), take);
    EXPECT_EQ(contents(folder / "gaps.csv"), "Head,3,5\n");
    EXPECT_EQ(contents(folder / "lab.toml"), "strength = 1\n");
    EXPECT_FALSE(fs::exists(folder / "out.bvh"));
  }
}

TEST_F(Files, ATakeWithoutFramesConvertsToAFileThatCanBeRead) {
  synth("walk.bvh");
  std::string text = contents(folder / "walk.bvh");
  text.resize(text.find("MOTION"));
  put(folder / "still.bvh", text + "MOTION\nFrames: 0\nFrame Time: 0.0166667\n");
  for (const char* format : {"bvh", "amc", "csv", "trc", "c3d"}) {
    const std::string name = std::string("out.") + format;
    const Ran ran = run({"convert", "still.bvh", "-o", name});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const Ran info = run({"info", name});
    EXPECT_EQ(info.code, 0) << info.err;
    EXPECT_THAT(info.out, HasSubstr("0 frames")) << format;
    for (const char* to : {"csv", "trc"}) {
      const std::string again = std::string("again.") + to;
      EXPECT_EQ(run({"convert", name, "-o", again, "--force"}).code, 0) << format;
      EXPECT_EQ(run({"info", again}).code, 0) << format << " to " << to;
    }
    EXPECT_EQ(run({"clean", name, "-o", std::string("clean.") + format}).code, 0) << format;
  }
}

TEST_F(Files, AnAmcFileIsNeverLeftWithoutItsSkeleton) {
  synth("walk.bvh");
  synth("run.bvh", "run");
  ASSERT_EQ(run({"convert", "walk.bvh", "-o", "walk.amc"}).code, 0);
  put(folder / "other.asf", contents(folder / "walk.asf") + "# another\n");
  const std::string skeleton = contents(folder / "walk.asf");
  // The result goes beside its source, in a folder with two skeletons.
  EXPECT_EQ(run({"clean", "walk.amc"}).code, 0);
  EXPECT_EQ(run({"info", "walk.clean.amc"}).code, 0);
  EXPECT_EQ(contents(folder / "walk.clean.asf"), skeleton);
  // The result goes to another folder under the same name.
  EXPECT_EQ(run({"clean", "walk.amc", "--output-dir", "out"}).code, 0);
  EXPECT_EQ(contents(folder / "out/walk.asf"), skeleton);
  EXPECT_EQ(run({"info", "out/walk.amc"}).code, 0);
  EXPECT_EQ(run({"clean", "walk.amc", "--output-dir", "out", "--force"}).code, 0);
  // Other commands write the skeleton under another name.
  for (const std::vector<std::string>& words : {std::vector<std::string>{"fill", "walk.amc"},
                                                {"convert", "walk.amc"},
                                                {"corrupt", "walk.amc", "--damage", "gaussian"},
                                                {"clean", "walk.amc", "--asf", "other.asf"}}) {
    fs::create_directory(folder / words[0]);
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", words[0] + "/named.amc"});
    EXPECT_EQ(run(all).code, 0) << words[0];
    EXPECT_EQ(run({"info", words[0] + "/named.amc"}).code, 0) << words[0];
  }
  EXPECT_EQ(contents(folder / "clean/named.asf"), contents(folder / "other.asf"));
  // A foreign skeleton is never replaced.
  fs::create_directory(folder / "foreign");
  put(folder / "foreign/walk.asf", "dear");
  EXPECT_EQ(run({"clean", "walk.amc", "-o", "foreign/walk.amc"}).code, 4);
  EXPECT_EQ(contents(folder / "foreign/walk.asf"), "dear");
  EXPECT_FALSE(fs::exists(folder / "foreign/walk.amc"));
}

TEST_F(Files, TakesOfOneSubjectShareTheirSkeleton) {
  synth("walk.bvh");
  for (const char* name : {"35_01.bvh", "35_02.bvh", "35_03.bvh"})
    fs::copy_file(folder / "walk.bvh", folder / name);
  for (const char* take : {"35_01", "35_02", "35_03"}) {
    ASSERT_EQ(run({"convert", take + std::string(".bvh"), "-o", take + std::string(".amc")}).code,
              0);
    // The first conversion writes the skeleton; later ones find it.
    if (fs::exists(folder / "35_01.asf")) fs::rename(folder / "35_01.asf", folder / "35.asf");
  }
  EXPECT_FALSE(fs::exists(folder / "35_02.asf"));
  EXPECT_EQ(run({"clean", "35_01.amc", "35_02.amc", "35_03.amc", "--output-dir", "out"}).code, 0);
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder / "out"))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_THAT(names, ElementsAre("35.asf", "35_01.amc", "35_02.amc", "35_03.amc"));
}

TEST_F(Files, AMissingFileIsExitCode3) {
  const Ran ran = run({"clean", "no.bvh"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.err, "kinemend: no.bvh: No such file or directory\n");
  EXPECT_EQ(run({"info", "no.bvh"}).code, 3);
  EXPECT_EQ(run({"compare", "no.bvh", "no.bvh"}).code, 3);
  EXPECT_EQ(run({"convert", "no.bvh", "-o", "a.bvh"}).code, 3);
  EXPECT_THAT(files(), ElementsAre());
}

TEST_F(Files, AMissingOrMalformedConfigurationIsExitCode3WithItsLine) {
  put(folder / "a.bvh", hand_take());
  EXPECT_EQ(run({"clean", "a.bvh", "--config", "no.toml"}).err,
            "kinemend: no.toml: No such file or directory\n");
  put(folder / "lab.toml", "# fine\nstrength = \n");
  const Ran ran = run({"clean", "a.bvh", "--config", "lab.toml"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, testing::StartsWith("kinemend: lab.toml:2: "));
  EXPECT_THAT(files(), ElementsAre("a.bvh", "lab.toml"));
}

TEST_F(Files, AnExistingOutputIsLeftAloneWithoutForce) {
  noisy("walk.bvh");
  put(folder / "walk.clean.bvh", "precious");
  const Ran refused = run({"clean", "walk.bvh"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_EQ(refused.err, "kinemend: walk.clean.bvh: exists already (--force overwrites it)\n");
  EXPECT_EQ(contents(folder / "walk.clean.bvh"), "precious");
  EXPECT_EQ(run({"clean", "walk.bvh", "--force"}).code, 0);
  EXPECT_THAT(contents(folder / "walk.clean.bvh"), HasSubstr("HIERARCHY"));
}

TEST_F(Files, EveryCommandThatWritesRespectsAnExistingOutput) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", "precious");
  EXPECT_EQ(run({"convert", "a.bvh", "-o", "b.bvh"}).code, 4);
  EXPECT_EQ(run({"corrupt", "a.bvh", "-o", "b.bvh", "--damage", "gaussian"}).code, 4);
  EXPECT_EQ(run({"synth", "walk", "-o", "b.bvh"}).code, 4);
  EXPECT_EQ(run({"clean", "a.bvh", "-o", "c.bvh", "--report", "b.bvh"}).code, 4);
  EXPECT_EQ(contents(folder / "b.bvh"), "precious");
  EXPECT_THAT(files(), ElementsAre("a.bvh", "b.bvh"));
}

TEST_F(Files, AnOutputMayReplaceItsInputByForce) {
  noisy("walk.bvh");
  const std::string before = contents(folder / "walk.bvh");
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "walk.bvh"}).code, 4);
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "walk.bvh", "--force"}).code, 0);
  EXPECT_NE(contents(folder / "walk.bvh"), before);
}

TEST_F(Files, OnlyTheFolderForManyResultsIsMade) {
  put(folder / "a.bvh", hand_take());
  EXPECT_EQ(run({"clean", "a.bvh", "-o", "misspelt/b.bvh"}).code, 4);
  EXPECT_FALSE(fs::exists(folder / "misspelt"));
  EXPECT_EQ(run({"clean", "a.bvh", "--output-dir", "new/deep"}).code, 0);
  EXPECT_TRUE(fs::exists(folder / "new/deep/a.bvh"));
}

TEST_F(Files, AFolderThatCannotBeMadeIsExitCode4) {
  put(folder / "a.bvh", hand_take());
  put(folder / "file", "");
  const Ran ran = run({"clean", "a.bvh", "--output-dir", "file/deeper"});
  EXPECT_EQ(ran.code, 4);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, HasSubstr("file/deeper: Not a directory"));
}

TEST_F(Files, AFolderThatMayNotBeWrittenIsExitCode4) {
  if (geteuid() == 0) {
    // The superuser can write almost everywhere, but not here.
    put(folder / "a.bvh", hand_take());
    EXPECT_EQ(run({"clean", "a.bvh", "-o", "/proc/self/out.bvh"}).code, 4);
    return;
  }
  put(folder / "a.bvh", hand_take());
  fs::create_directory(folder / "closed");
  fs::permissions(folder / "closed", fs::perms::owner_read | fs::perms::owner_exec);
  const Ran ran = run({"clean", "a.bvh", "--output-dir", "closed"});
  EXPECT_EQ(ran.code, 4);
  EXPECT_EQ(ran.err, "kinemend: closed/a.bvh: Permission denied\n");
}

TEST_F(Files, AFullDiskIsExitCode4) {
  synth("walk.bvh");
  const Ran ran = run({"convert", "walk.bvh", "-o", "-"}, {"", "/dev/full", {}});
  EXPECT_EQ(ran.code, 4);
  EXPECT_EQ(ran.err, "kinemend: standard output: No space left on device\n");
}

TEST_F(Files, ADryRunWritesNoTake) {
  noisy("walk.bvh");
  const Ran ran = run({"clean", "walk.bvh", "--dry-run", "--output-dir", "d"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("noisy: "));
  EXPECT_THAT(ran.out, HasSubstr("nothing written (--dry-run)"));
  EXPECT_THAT(files(), ElementsAre("truth.bvh", "walk.bvh"));
}

TEST_F(Files, OneBadTakeStopsNoneOfTheOthers) {
  synth("a.bvh");
  synth("c.bvh", "run");
  put(folder / "b.bvh", "HIERARCHY\nROOT a\n{\n");
  const Ran ran = run({"clean", "a.bvh", "b.bvh", "missing.bvh", "c.bvh", "--output-dir", "out"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_TRUE(fs::exists(folder / "out/a.bvh"));
  EXPECT_FALSE(fs::exists(folder / "out/b.bvh"));
  EXPECT_TRUE(fs::exists(folder / "out/c.bvh"));
  const auto errors = lines_of(ran.err);
  ASSERT_EQ(errors.size(), 3u) << ran.err;
  EXPECT_THAT(errors[0], testing::MatchesRegex("kinemend: b.bvh:[0-9]+: .*"));
  EXPECT_EQ(errors[1], "kinemend: missing.bvh: No such file or directory");
  EXPECT_EQ(errors[2], "kinemend: 2 of 4 takes failed");
  const auto told = lines_of(ran.out);
  ASSERT_EQ(told.size(), 2u) << ran.out;
  EXPECT_THAT(told[0], testing::StartsWith("a.bvh: "));
  EXPECT_THAT(told[1], testing::StartsWith("c.bvh: "));
}

TEST_F(Files, TheHighestExitCodeOfManyTakesHolds) {
  synth("a.bvh");
  synth("b.bvh");
  fs::create_directory(folder / "out");
  put(folder / "out/b.bvh", "precious");
  EXPECT_EQ(run({"clean", "a.bvh", "b.bvh", "missing.bvh", "--output-dir", "out"}).code, 4);
}

TEST_F(Files, InfoGoesOnPastABadTake) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", "nothing");
  const Ran ran = run({"info", "b.bvh", "a.bvh"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.out, testing::StartsWith("a.bvh\n"));
  EXPECT_THAT(ran.err, IsOneLine());
}

}  // namespace
}  // namespace kinemend::test
