// Tests of `kinemend fill`: gaps of a side file, refusals, the report as JSON, and streams.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Fill = Program;
using testing::HasSubstr;

TEST_F(Fill, FillsTheGapsOfASideFile) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv",
      "name,first_frame,last_frame\nLeftArm,20,26\n# the hips too\nHips,50,53\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("walk.bvh: 3 gaps: 3 filled, 0 refused; written to filled.bvh\n"));
  EXPECT_THAT(ran.out, HasSubstr("LeftArm"));
  EXPECT_THAT(ran.out, HasSubstr("20-26"));
  EXPECT_THAT(ran.out, HasSubstr("Hips (position)"));
  const auto before = lines_of(contents(folder / "walk.bvh"));
  const auto after = lines_of(contents(folder / "filled.bvh"));
  ASSERT_EQ(before.size(), after.size());
  std::size_t changed = 0;
  for (std::size_t i = 0; i < before.size(); ++i) changed += before[i] != after[i] ? 1 : 0;
  EXPECT_EQ(changed, 11u);
}

TEST_F(Fill, FillsByTheNetworkThatShips) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,40\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "-m", "learned", "-o",
                       "filled.bvh", "--plan-out", "plan.csv"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 filled, 0 refused"));
  const Ran again =
      run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--plan", "plan.csv", "-o", "again.bvh"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(contents(folder / "again.bvh"), contents(folder / "filled.bvh"));
}

TEST_F(Fill, WritesTheSameBytesWhereThereIsNoGap) {
  put(folder / "hand.bvh", hand_take());
  const Ran ran = run({"fill", "hand.bvh", "-o", "same.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.out, "hand.bvh: no gaps; written to same.bvh\n");
  EXPECT_EQ(contents(folder / "same.bvh"), hand_take());
}

TEST_F(Fill, ListsWhatTheRulesRefuse) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nRightArm,30,33\n");
  const std::vector<std::string> words = {"fill",     "walk.bvh", "--gaps", "gaps.csv",
                                          "--method", "spline",   "-o",     "filled.bvh"};
  const Ran ran = run(words);
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("2 gaps: 1 filled, 1 refused"));
  EXPECT_THAT(ran.out, HasSubstr("\n  1 refused:\n"));
  EXPECT_THAT(ran.out, HasSubstr("1.18 s is longer than the 0.25 s that spline may fill"));

  auto all = words;
  all.insert(all.end(), {"--fill-all", "--force"});
  EXPECT_THAT(run(all).out, HasSubstr("2 filled, 0 refused"));

  auto strict = words;
  strict.back() = "strict.bvh";
  strict.push_back("--strict");
  const Ran refused = run(strict);
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("1 gap refused, which --strict does not allow"));
  EXPECT_FALSE(fs::exists(folder / "strict.bvh"));
}

TEST_F(Fill, TellsProgramsWhatWasDone) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,20,90\nHips,30,33\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--method", "spline", "-o",
                       "filled.bvh", "--json", "--report", "report.json"});
  EXPECT_EQ(ran.out, contents(folder / "report.json"));
  const Json report = Json::parse(ran.out)["takes"][0];
  EXPECT_EQ(report["figures"]["filled"], 2);
  EXPECT_EQ(report["figures"]["refused"], 1);
  EXPECT_EQ(report["output"], "filled.bvh");
  ASSERT_EQ(report["findings"].size(), 3u);
  for (const Json& gap : report["findings"]) {
    if (gap["track"] == "LeftArm") {
      EXPECT_EQ(gap["verdict"], "refused");
      EXPECT_EQ(gap["first_frame"], 20);
      EXPECT_EQ(gap["last_frame"], 90);
      EXPECT_EQ(gap["quantity"], "rotation");
      EXPECT_EQ(gap["unit"], "deg");
      EXPECT_THAT(gap["reason"], HasSubstr("is longer than"));
    } else {
      EXPECT_EQ(gap["verdict"], "filled");
      EXPECT_TRUE(gap["reason"].is_null());
    }
  }
}

TEST_F(Fill, ADryRunWritesNoTake) {
  synth("walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,26\n");
  const auto before = files();
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--dry-run"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("1 gap: 1 filled, 0 refused; nothing written (dry run)"));
  EXPECT_EQ(files(), before);
}

TEST_F(Fill, StreamsTheTake) {
  put(folder / "gaps.csv", "LeftArm,4,5\n");
  const Ran ran = run({"fill", "-", "--gaps", "gaps.csv", "--method", "pchip", "-o", "-"},
                      {hand_take(), {}, {}});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, testing::StartsWith("HIERARCHY"));
  EXPECT_THAT(ran.err, HasSubstr("standard input: 1 gap: 1 filled"));
}

TEST_F(Fill, NamesWhatIsWrong) {
  put(folder / "hand.bvh", hand_take());
  put(folder / "bad.csv", "LeftArm,1,2\nLeftArm,7,3\n");
  put(folder / "unknown.csv", "Tail,1,2\n");
  const Ran bad = run({"fill", "hand.bvh", "--gaps", "bad.csv", "-o", "out.bvh"});
  EXPECT_EQ(bad.code, 3);
  EXPECT_THAT(bad.err, HasSubstr("bad.csv:2: the last frame, 3, is before the first, 7"));
  const Ran unknown = run({"fill", "hand.bvh", "--gaps", "unknown.csv", "-o", "out.bvh"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown.csv: gap of joint \"Tail\": the take has no such"));
  const Ran method = run({"fill", "hand.bvh", "-o", "out.bvh", "--method", "rigid-body"});
  EXPECT_EQ(method.code, 2);
  EXPECT_THAT(method.err, HasSubstr("expected a method for joints"));
  EXPECT_FALSE(fs::exists(folder / "out.bvh"));
  put(folder / "out.bvh", "mine");
  EXPECT_EQ(run({"fill", "hand.bvh", "-o", "out.bvh"}).code, 4);
  EXPECT_EQ(contents(folder / "out.bvh"), "mine");
}

TEST_F(Fill, TheHelpTellsOfEveryMethod) {
  const std::string list = run({"fill", "--help"}).out;
  for (const char* method : {"auto", "spline", "quintic", "pchip", "slerp", "squad", "hermite",
                             "pattern", "rigid-body", "pca", "local-regression", "cyclic"}) {
    EXPECT_THAT(list, HasSubstr(method));
    EXPECT_THAT(run({"help", method}).out,
                HasSubstr(std::string("kinemend fill --method ") + method));
  }
}

}  // namespace
}  // namespace kinemend::test
