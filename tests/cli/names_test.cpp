// Tests of the names of joints and markers as people type them.
#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Names = Program;
using testing::HasSubstr;

/// All commands that take names of joints.
std::vector<std::vector<std::string>> commands_of(const std::string& name) {
  return {{"clean", "a.bvh", "-m", "gaussian", "--joints", name, "-o", "out.bvh", "--force"},
          {"clean", "a.bvh", "-m", "gaussian", "--exclude", name, "-o", "out.bvh", "--force"},
          {"fill", "a.bvh", "--gaps", "gaps.csv", "--joints", name, "-o", "out.bvh", "--force"},
          {"corrupt", "a.bvh", "--damage", "gaussian:joints=" + name, "-o", "out.bvh", "--force"}};
}

TEST_F(Names, MatchInAnyCapitalsWhereNothingMatchesExactly) {
  put(folder / "a.bvh", hand_take());
  put(folder / "gaps.csv", "LeftArm,4,5\nLeftFinger1,7,8\n");
  const std::size_t count = commands_of("").size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto result = [&](const std::string& name) {
      const Ran ran = run(commands_of(name)[i]);
      EXPECT_EQ(ran.code, 0) << name << ": " << ran.err;
      return contents(folder / "out.bvh");
    };
    EXPECT_EQ(result("leftarm"), result("LeftArm")) << i;
    EXPECT_EQ(result("LEFTF*"), result("LeftFinger?")) << i;
    EXPECT_NE(result("leftarm"), result("LeftFinger1")) << i;
    EXPECT_EQ(run(commands_of("Tail")[i]).code, 2);
  }
}

TEST_F(Names, AnExactMatchIsTheOnlyOne) {
  std::string take = hand_take();
  take.replace(take.find("LeftFinger2"), 11, "LEFTFINGER1");
  put(folder / "a.bvh", take);
  ASSERT_EQ(run({"clean", "a.bvh", "-m", "gaussian", "--joints", "LeftFinger1", "-o", "b.bvh",
                 "--report", "r.json"})
                .code,
            0);
  const Json report = Json::parse(contents(folder / "r.json"));
  for (const Json& span : report["takes"][0]["findings"]) {
    EXPECT_TRUE(span["quantity"] == "position" || span["track"] == "LeftFinger1") << span;
  }
}

TEST_F(Names, OfSideFilesMatchInAnyCapitalsToo) {
  put(folder / "a.bvh", hand_take());
  put(folder / "gaps.csv", "leftarm,4,5\n");
  EXPECT_THAT(run({"fill", "a.bvh", "--gaps", "gaps.csv", "--dry-run"}).out, HasSubstr("1 gap: "));
  synth("walk.bvh", "walk", "2");
  put(folder / "walk.contacts", "Left Toe 20 40\n");
  EXPECT_THAT(run({"clean", "walk.bvh", "--contacts", "walk.contacts", "--dry-run"}).out,
              HasSubstr("confidence 1.00; held for 0."));
}

// Options that take names accept `LeftArm` and `Left*` for "Ann:LeftArm".
TEST_F(Names, AreKnownWithoutTheirSubjectEverywhere) {
  std::string take = hand_take();
  for (const char* const name : {"Hips", "LeftArm", "LeftFinger1", "LeftFinger2"})
    take.insert(take.find(std::string(name) + "\n"), "Ann:");
  put(folder / "a.bvh", take);
  put(folder / "gaps.csv", "LeftArm,4,5\nLeftFinger?,7,8\n");
  const std::size_t count = commands_of("").size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto result = [&](const std::string& name) {
      const Ran ran = run(commands_of(name)[i]);
      EXPECT_EQ(ran.code, 0) << name << ": " << ran.err;
      return contents(folder / "out.bvh");
    };
    EXPECT_EQ(result("LeftArm"), result("Ann:LeftArm")) << i;
    EXPECT_EQ(result("L*"), result("Ann:L*")) << i;
    EXPECT_NE(result("L*"), result("LeftArm")) << i;
  }
}

TEST_F(Names, OfMarkersAreKnownWithoutTheirSubjectEverywhere) {
  std::string take = plate_take();
  for (const char* const name : {"A", "B", "C", "D"}) {
    const std::string cell = "\t" + std::string(name) + "\t";
    take.replace(take.find(cell), 3, "\tAnn:L" + std::string(name) + "\t");
  }
  put(folder / "a.trc", take);
  put(folder / "gaps.csv", "LD,4,9\n");
  const auto result = [&](std::vector<std::string> words, const std::string& name) {
    for (std::string& word : words) word = word == "NAME" ? name : word;
    words.insert(words.end(), {"-o", "out.trc", "--force"});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << words[0] << " " << name << ": " << ran.err;
    return contents(folder / "out.trc");
  };
  const std::vector<std::vector<std::string>> commands{
      {"clean", "a.trc", "-m", "gaussian", "--markers", "NAME"},
      {"clean", "a.trc", "-m", "gaussian", "--exclude", "NAME"},
      {"fill", "a.trc", "--gaps", "gaps.csv", "--joints", "NAME"}};
  for (const auto& words : commands) {
    EXPECT_EQ(result(words, "LB"), result(words, "Ann:LB")) << words[0] << words[2];
    EXPECT_EQ(result(words, "L[AB]"), result(words, "Ann:L[AB]")) << words[0] << words[2];
    EXPECT_EQ(result(words, "L*"), result(words, "Ann:L*")) << words[0] << words[2];
    EXPECT_NE(result(words, "L*"), result(words, "LB")) << words[0] << words[2];
  }
  const std::vector<std::string> by_donor{"fill",       "a.trc",   "-m",  "pattern",
                                          "--fill-all", "--donor", "NAME"};
  EXPECT_EQ(result(by_donor, "LA"), result(by_donor, "Ann:LA"));
}

TEST_F(Names, LengthsOfTakesInMetresArePrintedInMillimetres) {
  synth("walk.bvh", "walk", "2");
  ASSERT_EQ(run({"convert", "walk.bvh", "mm.trc"}).code, 0);
  ASSERT_EQ(run({"convert", "mm.trc", "m.trc", "--unit", "m"}).code, 0);
  put(folder / "gaps.csv", "LeftHand,40,60\n");
  const auto expected_error = [&](const std::string& take) {
    const Ran ran = run({"fill", take, "--gaps", "gaps.csv", "--fill-all", "--dry-run"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    const std::string line = lines_of(ran.out).back();
    EXPECT_THAT(line, HasSubstr(" 40-60 "));
    const std::size_t unit = line.rfind(' ');
    EXPECT_EQ(line.substr(unit), " mm");
    return std::atof(line.substr(line.rfind(' ', unit - 1)).c_str());
  };
  const double in_mm = expected_error("mm.trc"), in_m = expected_error("m.trc");
  ASSERT_GT(in_mm, 0.1);
  EXPECT_NEAR(in_m, in_mm, 0.006 * in_mm) << "three digits";
}

}  // namespace
}  // namespace kinemend::test
