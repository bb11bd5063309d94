// The extension of an output selects the format that is written.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Endings : public Program {
 protected:
  void SetUp() override { synth("walk.bvh"); }

  void expect_refused(std::vector<std::string> words, const std::string& output,
                      const std::string& written) {
    words.insert(words.end(), {"-o", output});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 2) << words[0];
    EXPECT_THAT(ran.err, IsOneLine()) << words[0];
    EXPECT_THAT(ran.err, AllOf(HasSubstr(output), HasSubstr("not written"), HasSubstr(written)));
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(files(), Not(Contains(output))) << words[0];
  }
};

TEST_F(Endings, OfFormatsThatAreNotWrittenAreRefusedByEveryCommand) {
  for (const char* output : {"out.obj", "out.png", "out.usd", "out.bvhh", "out.C3D.zip"}) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"clean", "walk.bvh"},
                                               {"fill", "walk.bvh"},
                                               {"convert", "walk.bvh"},
                                               {"corrupt", "walk.bvh", "--damage", "gaussian"},
                                               {"synth", "walk"},
                                               {"clean", "walk.bvh", "--dry-run"},
                                               {"view", "walk.bvh"}})
      expect_refused(words, output,
                     ".bvh, .amc, .asf, .c3d, .trc, .tsv, .csv, .glb, .vrm, .gltf, .fbx, .npz");
    expect_refused({"plot", "walk.bvh"}, output, "only .svg");
  }
  expect_refused({"plot", "walk.bvh"}, "out.bvh", "only .svg");
}

TEST_F(Endings, AreRefusedBeforeTheInputIsRead) {
  const Ran ran = run({"clean", "absent.bvh", "-o", "out.obj"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("out.obj"));
}

TEST_F(Endings, ThatAreAbsentKeepTheFormatOfTheInput) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"clean", "walk.bvh"},
                                             {"fill", "walk.bvh"},
                                             {"convert", "walk.bvh"},
                                             {"corrupt", "walk.bvh", "--damage", "gaussian"},
                                             {"synth", "walk"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", "out", "--force"});
    ASSERT_EQ(run(all).code, 0) << words[0];
    EXPECT_THAT(contents(folder / "out"), StartsWith("HIERARCHY")) << words[0];
  }
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "picture"}).code, 0);
  EXPECT_THAT(contents(folder / "picture"), HasSubstr("<svg"));
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "picture.SVG"}).code, 0);
}

TEST_F(Endings, OfAFormatThatIsNamedMayBeAny) {
  EXPECT_EQ(run({"convert", "walk.bvh", "-o", "walk.txt", "--to", "csv"}).code, 0);
  EXPECT_THAT(contents(folder / "walk.txt"), StartsWith("# rate_hz"));
}

TEST_F(Endings, OfAFormatThatCannotHoldTheTakeAreRefusedBeforeWork) {
  for (const char* command : {"clean", "fill"}) {
    const Ran ran = run({command, "walk.bvh", "-o", "out.c3d"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("walk.bvh: holds joints; c3d files hold markers"));
  }
}

TEST_F(Endings, ThatAreWrongAreSaidAndPutRightInTheResult) {
  const std::string bytes = contents(folder / "walk.bvh");
  fs::rename(folder / "walk.bvh", folder / "walk.c3d");
  for (const char* command : {"clean", "fill"}) {
    const Ran ran = run({command, "walk.c3d"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("walk.c3d: the name ends in .c3d, but the "
                                   "content is bvh (Biovision hierarchy): read as bvh"))
        << command;
  }
  EXPECT_THAT(contents(folder / "walk.clean.bvh"), StartsWith("HIERARCHY"));
  EXPECT_EQ(contents(folder / "walk.filled.bvh"), bytes);
  EXPECT_EQ(run({"clean", "walk.c3d", "--output-dir", "out"}).code, 0);
  EXPECT_THAT(contents(folder / "out/walk.bvh"), StartsWith("HIERARCHY"));
  EXPECT_EQ(run({"batch", "walk.c3d", "-o", "batch"}).code, 0);
  EXPECT_THAT(contents(folder / "batch/walk.bvh"), StartsWith("HIERARCHY"));
  const Ran info = run({"info", "walk.c3d"});
  EXPECT_THAT(info.out, AllOf(HasSubstr("bvh (Biovision hierarchy)"), HasSubstr("ends in .c3d")));
  const Ran strict = run({"clean", "walk.c3d", "--strict", "--force"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, HasSubstr("walk.c3d: the name ends in .c3d"));
  // An explicit --from suppresses the warning.
  EXPECT_EQ(run({"clean", "walk.c3d", "--from", "bvh", "--strict", "--force"}).err, "");
}

TEST_F(Endings, ThatAreUnknownAreReplacedInTheResult) {
  fs::copy_file(folder / "walk.bvh", folder / "walk.dat");
  fs::copy_file(folder / "walk.bvh", folder / "plain");
  ASSERT_EQ(run({"clean", "walk.dat"}).code, 0);
  ASSERT_EQ(run({"clean", "plain"}).code, 0);
  EXPECT_THAT(files(), AllOf(Contains("walk.clean.bvh"), Contains("plain.clean.bvh")));
}

TEST_F(Endings, OfMarkersSayTheGuessedUnitOnce) {
  const Ran ran = run({"convert", "walk.bvh", "out.trc"});
  ASSERT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, AllOf(IsOneLine(), HasSubstr("walk.bvh: the unit is taken to be")));
  const Ran metres = run({"convert", "walk.bvh", "metres.trc", "--unit", "m"});
  EXPECT_THAT(metres.err, IsOneLine());
}

TEST_F(Endings, DoNotMatterForAFileThatWasCutOff) {
  std::string text = contents(folder / "walk.bvh");
  put(folder / "cut.bvh", text.substr(0, text.size() - 20));
  const Ran ran = run({"clean", "cut.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("the file ends in the middle of frame 30"));
  EXPECT_EQ(run({"clean", "cut.bvh", "--strict", "--force"}).code, 1);
  const Ran again = run({"info", "cut.clean.bvh", "--json"});
  EXPECT_EQ(Json::parse(again.out)["takes"][0]["frames"], 29);
  EXPECT_TRUE(Json::parse(again.out)["takes"][0]["diagnostics"].empty());
}

}  // namespace
}  // namespace kinemend::test
