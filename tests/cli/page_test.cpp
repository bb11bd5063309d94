// Tests of reports that are pages, `--report FILE.html` for each command, and of the pictures of
// `kinemend plot`.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class PageReport : public Program {
 protected:
  /// Returns whether the build has the page; a build without it must say so.
  bool has_page() {
    synth("probe.bvh", "walk", "0.2");
    const Ran ran = run({"check", "probe.bvh", "--report", "probe.html"});
    if (ran.code == 0) return true;
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err,
                AllOf(IsOneLine(), HasSubstr("without its report page"), HasSubstr("FILE.json")));
    EXPECT_FALSE(fs::exists(folder / "probe.html"));
    return false;
  }

  void expect_page(const std::string& name) {
    const std::string page = contents(folder / name);
    EXPECT_THAT(page, StartsWith("<!doctype html>")) << name;
    EXPECT_THAT(page, HasSubstr("id=\"data-report\"")) << name;
    EXPECT_THAT(page, HasSubstr("</html>\n")) << name;
  }
};

TEST_F(PageReport, IsWrittenByEveryCommandThatLooksAtATake) {
  if (!has_page()) GTEST_SKIP() << "built without the page";
  noisy("noisy.bvh", "1");
  put(folder / "gaps.csv", "LeftArm,20,26\n");
  EXPECT_EQ(run({"clean", "noisy.bvh", "--report", "clean.html"}).code, 0);
  EXPECT_EQ(run({"clean", "noisy.bvh", "--dry-run", "--report", "dry.HTM"}).code, 0);
  EXPECT_EQ(run({"check", "noisy.bvh", "--report", "check.html"}).code, 0);
  EXPECT_EQ(run({"fill", "noisy.bvh", "--gaps", "gaps.csv", "--report", "fill.html"}).code, 0);
  EXPECT_EQ(run({"compare", "truth.bvh", "noisy.bvh", "--report", "compare.html"}).code, 0);
  for (const char* name : {"clean.html", "dry.HTM", "check.html", "fill.html", "compare.html"})
    expect_page(name);
  const std::string markers = c3d_fixture("intel_real");
  EXPECT_EQ(run({"clean", markers, "--report", "markers.html"}).code, 0);
  expect_page("markers.html");
}

TEST_F(PageReport, GoesToStandardOutputNever) {
  if (!has_page()) GTEST_SKIP() << "built without the page";
  noisy("noisy.bvh", "1");
  // Standard output has no extension, so its report is JSON.
  const Ran ran = run({"check", "noisy.bvh", "--report", "-"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out)["command"], "check");
}

TEST_F(PageReport, IsOfOneTake) {
  if (!has_page()) GTEST_SKIP() << "built without the page";
  synth("a.bvh");
  synth("b.bvh");
  for (const char* command : {"clean", "check"}) {
    const Ran ran = run({command, "a.bvh", "b.bvh", "--report", "both.html"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, AllOf(IsOneLine(), HasSubstr("one take")));
  }
  EXPECT_FALSE(fs::exists(folder / "both.html"));
}

TEST_F(PageReport, ReplacesNoTakeAndNoFileUnasked) {
  if (!has_page()) GTEST_SKIP() << "built without the page";
  synth("walk.bvh");
  fs::rename(folder / "walk.bvh", folder / "walk.html");
  const std::string take = contents(folder / "walk.html");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", "walk.html", "--report", "walk.html", "--force"},
        {"check", "walk.html", "--report", "./walk.html", "--force"},
        {"compare", "walk.html", "walk.html", "--report", "walk.html", "--force"},
        {"fill", "walk.html", "-o", "o.bvh", "--report", "walk.html", "--force"},
        {"clean", "walk.html", "-o", "o.html", "--report", "o.html", "--force"},
        {"clean", "walk.html", "-o", "o.bvh", "--report", "walk.html", "--force"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 2) << ran.err;
    EXPECT_THAT(ran.err, AllOf(IsOneLine(), HasSubstr("--report")));
    EXPECT_EQ(contents(folder / "walk.html"), take);
  }
  put(folder / "mine.html", "mine");
  EXPECT_EQ(run({"check", "walk.html", "--report", "mine.html"}).code, 4);
  EXPECT_EQ(contents(folder / "mine.html"), "mine");
}

TEST_F(PageReport, OfBadInputIsNone) {
  put(folder / "bad.bvh", "bad");
  for (const char* command : {"clean", "check", "fill"}) {
    EXPECT_NE(run({command, "bad.bvh", "--report", "bad.html"}).code, 0);
    EXPECT_FALSE(fs::exists(folder / "bad.html")) << command;
  }
}

TEST_F(PageReport, AsJsonHoldsWhatCouldNotBeReadBesideWhatCould) {
  synth("walk.bvh");
  put(folder / "bad.bvh", "bad");
  EXPECT_EQ(run({"check", "walk.bvh", "bad.bvh", "--report", "both.json"}).code, 3);
  const Json takes = Json::parse(contents(folder / "both.json"))["takes"];
  ASSERT_EQ(takes.size(), 2u);
  EXPECT_EQ(takes[0]["input"], "walk.bvh");
  EXPECT_EQ(takes[1]["exit_code"], 3);
}

TEST_F(PageReport, AsJsonIsWhatCheckAndComparePrint) {
  noisy("noisy.bvh", "1");
  EXPECT_EQ(run({"check", "noisy.bvh", "--report", "check.json"}).code, 0);
  EXPECT_EQ(contents(folder / "check.json"), run({"check", "noisy.bvh", "--json"}).out);
  EXPECT_EQ(run({"compare", "truth.bvh", "noisy.bvh", "--report", "c.json"}).code, 0);
  EXPECT_EQ(contents(folder / "c.json"), run({"compare", "truth.bvh", "noisy.bvh", "--json"}).out);
}

TEST_F(PageReport, OfABatchIsAnIndexWithAPageForEachTake) {
  if (!has_page()) GTEST_SKIP() << "built without the page";
  fs::create_directories(folder / "raw/deep");
  synth("raw/a.bvh");
  synth("raw/deep/b #1.bvh");
  put(folder / "raw/bad.bvh", "bad");
  EXPECT_EQ(run({"batch", "raw", "-o", "out", "--report", "index.html"}).code, 3);
  EXPECT_THAT(contents(folder / "index.html"), HasSubstr("id=\"data-batch\""));
  expect_page("index.takes/a.bvh.html");
  expect_page("index.takes/deep/b #1.bvh.html");
  EXPECT_FALSE(fs::exists(folder / "index.takes/bad.bvh.html"));
  // A resumed batch replaces its own index and writes missing pages.
  fs::remove(folder / "index.takes/a.bvh.html");
  const Ran again = run({"batch", "raw", "-o", "out", "--report", "index.html"});
  EXPECT_EQ(again.code, 3);
  EXPECT_THAT(again.out, StartsWith("1 cleaned, 1 done already"));
  expect_page("index.takes/a.bvh.html");
  // A file that the batch did not write is kept.
  put(folder / "mine.html", "mine");
  EXPECT_EQ(run({"batch", "raw", "-o", "out", "--report", "mine.html"}).code, 4);
  EXPECT_EQ(contents(folder / "mine.html"), "mine");
}

class Plot : public Program {};

TEST_F(Plot, DrawsEveryKindOfOneTakeAndOfTwo) {
  noisy("noisy.bvh", "1");
  for (const char* what : {"curves", "strip", "spectrum"}) {
    const Ran two = run({"plot", "truth.bvh", "noisy.bvh", "--what", what, "-o", "-"});
    EXPECT_EQ(two.code, 0) << two.err;
    EXPECT_THAT(two.out, StartsWith("<svg ")) << what;
    const Ran one = run({"plot", "noisy.bvh", "--what", what, "-o", std::string(what) + ".svg"});
    EXPECT_EQ(one.code, 0) << one.err;
    EXPECT_THAT(contents(folder / (std::string(what) + ".svg")), StartsWith("<svg "));
  }
  const std::string markers = c3d_fixture("intel_real");
  EXPECT_THAT(run({"plot", markers, "--what", "strip", "-o", "-"}).out, StartsWith("<svg "));
}

TEST_F(Plot, TakesTheTrackAndTheRangeThatAreAskedFor) {
  synth("walk.bvh");
  EXPECT_THAT(run({"plot", "walk.bvh", "-o", "-", "--track", "LeftHand"}).out,
              HasSubstr(">LeftHand, deg<"));
  EXPECT_THAT(run({"plot", "walk.bvh", "-o", "-", "--root-position"}).out, HasSubstr(">Hips"));
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "-", "--range", "5:10"}).code, 0);
  const Ran nobody = run({"plot", "walk.bvh", "-o", "-", "--track", "Nobody"});
  EXPECT_EQ(nobody.code, 2);
  EXPECT_THAT(nobody.err, AllOf(IsOneLine(), HasSubstr("Nobody")));
}

TEST_F(Plot, RefusesWhatDoesNotFit) {
  synth("walk.bvh");
  synth("longer.bvh", "walk", "1");
  const std::string markers = c3d_fixture("intel_real");
  EXPECT_EQ(run({"plot", "walk.bvh"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", "longer.bvh", "-o", "x.svg"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", markers, "-o", "x.svg"}).code, 2);
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "walk.bvh", "--force"}).code, 2);
  put(folder / "x.svg", "mine");
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "x.svg"}).code, 4);
  EXPECT_EQ(contents(folder / "x.svg"), "mine");
}

}  // namespace
}  // namespace kinemend::test
