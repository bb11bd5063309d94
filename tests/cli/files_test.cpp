#include "cli/program.hpp"

// Inputs that cannot be read (3), outputs that cannot be written (4), and what stays on the disk.
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
  EXPECT_EQ(refused.err, "kinemend: walk.clean.bvh: exists already (--force replaces it)\n");
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
    // The superuser may write anywhere but here.
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

TEST_F(Files, ADryRunWritesNothing) {
  noisy("walk.bvh");
  const Ran ran =
      run({"clean", "walk.bvh", "--dry-run", "--output-dir", "d", "--report", "r.json"});
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
