// Tests of the feet flags and of files of contacts, from the command line.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Feet = Program;
using testing::HasSubstr;
using testing::Not;

TEST_F(Feet, AreHeldWhenAskedFor) {
  synth("walk.bvh", "walk", "3");
  const Ran plain = run({"clean", "walk.bvh", "-o", "plain.bvh", "--method", "gaussian"});
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_THAT(plain.out, Not(HasSubstr("feet:")));
  const Ran ran =
      run({"clean", "walk.bvh", "-o", "held.bvh", "--method", "gaussian", "--feet", "force"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("  feet: "));
  EXPECT_THAT(ran.out, testing::ContainsRegex(" contacts held, [0-9]+ frames adjusted; slide "));
  // Legs are reported like other joints: none was repaired, and they changed.
  EXPECT_THAT(ran.out, HasSubstr("changed, 0 frames repaired"));
  EXPECT_THAT(ran.out, Not(testing::ContainsRegex("Leg.* 0 +0\n")));
  EXPECT_THAT(ran.out, HasSubstr("knee pop "));
}

TEST_F(Feet, AreToldToPrograms) {
  synth("walk.bvh", "walk", "3");
  const Ran ran = run({"clean", "walk.bvh", "-o", "out.bvh", "--method", "gaussian", "--feet",
                       "force", "--report", "report.json", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json take = Json::parse(ran.out)["takes"][0];
  const Json feet = take["feet"];
  EXPECT_GT(feet["held"], 4);
  EXPECT_GT(feet["frames_adjusted"], 100);
  EXPECT_EQ(take["figures"]["frames_repaired"], 0);
  EXPECT_LT(feet["after"]["most_slide"], 0.1);
  EXPECT_EQ(feet["contacts"][0]["side"], "left");
  EXPECT_EQ(feet["contacts"][0]["held"], true);
  const Json spans = Json::parse(contents(folder / "report.json"))["takes"][0]["findings"];
  bool adjusted = false;
  for (const Json& span : spans) adjusted = adjusted || span["verdict"] == "foot_adjusted";
  EXPECT_TRUE(adjusted);
}

TEST_F(Feet, CanBeListedEditedAndHeldAsListed) {
  synth("walk.bvh", "walk", "3");
  const Ran listed = run({"contacts", "walk.bvh", "-o", "walk.contacts"});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(contents(folder / "walk.contacts"), HasSubstr("# Times in which a foot stands"));
  EXPECT_THAT(contents(folder / "walk.contacts"), HasSubstr("\nleft heel "));
  EXPECT_EQ(run({"contacts", "walk.bvh"}).out, contents(folder / "walk.contacts"));
  put(folder / "mine.contacts", "left toe 100 130\n");
  const Ran ran = run({"clean", "walk.bvh", "-o", "held.bvh", "--contacts", "mine.contacts"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("feet: 1 of 1 contact held"));
}

TEST_F(Feet, RefuseFilesOfContactsThatDoNotFit) {
  synth("walk.bvh", "walk", "2");
  put(folder / "bad.contacts", "left heel 1 10\nleft toe 900 910\n");
  const Ran ran = run({"clean", "walk.bvh", "-o", "held.bvh", "--contacts", "bad.contacts"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("bad.contacts:2: expected a first frame of 1 to 120"));
  EXPECT_FALSE(fs::exists(folder / "held.bvh"));
  EXPECT_EQ(run({"clean", "walk.bvh", "--contacts", "none.contacts", "-o", "held.bvh"}).code, 3);
  EXPECT_EQ(
      run({"clean", "walk.bvh", "walk.bvh", "--output-dir", "o", "--contacts", "bad.contacts"})
          .code,
      2);
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "held.bvh", "--feet", "sometimes"}).code, 2);
}

TEST_F(Feet, MayBeAskedForInAConfigurationFileAndABatch) {
  fs::create_directory(folder / "raw");
  synth("raw/walk.bvh", "walk", "2");
  put(folder / "lab.toml", "method = \"gaussian\"\nfeet = \"force\"\n");
  const Ran ran = run({"batch", "raw", "-o", "clean", "--config", "lab.toml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json row = Json::parse(lines_of(contents(folder / "clean/rows.jsonl"))[0]);
  EXPECT_GT(row["feet"]["held"], 2);
  EXPECT_FALSE(row["feet"].contains("contacts"));
}

}  // namespace
}  // namespace kinemend::test
