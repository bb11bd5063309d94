// Tests of `check --robot` and of `convert --floor-at-zero --face-forward`.
#include <set>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Robot : public Program {
 protected:
  Json report(const std::vector<std::string>& words) {
    std::vector<std::string> all = {"check", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = run(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out).at("takes").at(0);
  }
  static std::size_t count_of(const Json& take, const std::string& kind) {
    std::size_t count = 0;
    for (const Json& finding : take.at("findings")) count += finding.at("kind") == kind;
    return count;
  }
};

TEST_F(Robot, SaysWhatARobotCannotFollow) {
  synth("jump.bvh", "jump", "3");
  const Ran ran = run({"check", "jump.bvh", "--robot"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("times in the air"));
  EXPECT_THAT(ran.out, HasSubstr("no foot touches the floor"));
  const Ran plain = run({"check", "jump.bvh"});
  EXPECT_THAT(plain.out, Not(HasSubstr("times in the air")));
}

TEST_F(Robot, ItsJsonHasHeelsAndToesAndThePeaksOfJoints) {
  synth("walk.bvh", "walk", "3");
  const Json take = report({"walk.bvh", "--robot"});
  ASSERT_GT(take.at("robot").at("contacts").size(), 4u);
  std::set<std::string> parts;
  for (const Json& contact : take.at("robot").at("contacts")) {
    parts.insert(contact.at("side").get<std::string>() + " " +
                 contact.at("part").get<std::string>());
    EXPECT_GE(contact.at("first_frame"), 1) << "as the file counts";
  }
  EXPECT_EQ(parts.size(), 4u);
  EXPECT_TRUE(take.at("tracks").at(1).contains("peak_speed_deg_s"));
  EXPECT_EQ(take.at("figures").at("jumps"), 0);
  const Json plain = report({"walk.bvh"});
  EXPECT_FALSE(plain.contains("robot"));
  EXPECT_FALSE(plain.at("figures").contains("jumps"));
  EXPECT_FALSE(plain.at("tracks").at(1).contains("peak_speed_deg_s"));
}

TEST_F(Robot, AnOptionThatOnlyConcernsRobotsImpliesIt) {
  synth("jump.bvh", "jump", "3");
  const Ran limit = run({"check", "jump.bvh", "--max-flights", "0"});
  EXPECT_EQ(limit.code, 1);
  EXPECT_THAT(limit.err, HasSubstr("times in the air: 1 is above the limit 0"));
  EXPECT_EQ(run({"check", "jump.bvh", "--max-flights", "1"}).code, 0);
}

TEST_F(Robot, LimitsComeFromAFile) {
  synth("walk.bvh", "walk", "3");
  EXPECT_EQ(count_of(report({"walk.bvh", "--robot"}), "joint_speed"), 0u);
  put(folder / "limits.toml",
      "# of our robot\nspeed_deg_s = 5000\n\n[joints.\"*Leg\"]\nspeed_deg_s = 100\n"
      "[joints.LeftLeg]\nspeed_deg_s = 9000\nacceleration_deg_s2 = 1e6\n");
  const Json take = report({"walk.bvh", "--limits", "limits.toml"});
  EXPECT_GT(count_of(take, "joint_speed"), 0u);
  for (const Json& finding : take.at("findings")) {
    if (finding.at("kind") == "joint_speed") {
      EXPECT_THAT(finding.at("track").get<std::string>(), testing::EndsWith("Leg"));
      EXPECT_NE(finding.at("track"), "LeftLeg");
    }
  }
}

TEST_F(Robot, RefusesLimitsThatAreNoneWithTheLine) {
  synth("walk.bvh", "walk", "0.5");
  const auto refused = [&](const std::string& text, int code, const std::string& says) {
    put(folder / "limits.toml", text);
    const Ran ran = run({"check", "walk.bvh", "--limits", "limits.toml"});
    EXPECT_EQ(ran.code, code) << text;
    EXPECT_THAT(ran.err, HasSubstr(says)) << text;
    EXPECT_THAT(ran.err, IsOneLine());
  };
  refused("speed_deg_s = 0\n", 2, "limits.toml:1: speed_deg_s");
  refused("\nspeed_deg_s = \"fast\"\n", 2, "limits.toml:2: speed_deg_s");
  refused("speed = 3\n", 2, "did you mean speed_deg_s");
  refused("joints = 3\n", 2, "limits.toml:1: joints");
  refused("[joints]\nKnee = 3\n", 2, "limits.toml:2: Knee");
  refused("[joints.Knee]\nspeeds = 3\n", 2, "limits.toml:2: unknown limit speeds");
  refused("speed_deg_s = = 3\n", 3, "limits.toml:1");
  EXPECT_EQ(run({"check", "walk.bvh", "--limits", "none.toml"}).code, 3);
}

TEST_F(Robot, ConvertPutsTheFeetAtZeroAndSaysByHowMuch) {
  synth("walk.bvh", "walk", "2");
  const Ran up = run({"convert", "walk.bvh", "up.bvh", "--floor-at-zero", "--face-forward"});
  ASSERT_EQ(up.code, 0) << up.err;
  EXPECT_THAT(up.err, HasSubstr("the feet stand at 0"));
  EXPECT_THAT(up.err, HasSubstr("faces z"));
  EXPECT_NEAR(report({"up.bvh", "--robot"}).at("figures").at("floor_cm").get<double>(), 0, 1e-4);
  // Unchanged values keep their digits; here all joints except the root are unchanged.
  const std::vector<std::string> before = lines_of(contents(folder / "walk.bvh"));
  const std::vector<std::string> after = lines_of(contents(folder / "up.bvh"));
  ASSERT_EQ(before.size(), after.size());
  const auto without_root = [](std::string line) {
    for (int i = 0; i < 6; ++i) line.erase(0, line.find(' ') + 1);
    return line;
  };
  EXPECT_EQ(without_root(before.back()), without_root(after.back()));
  EXPECT_NE(before.back(), after.back());
}

TEST_F(Robot, ConvertNormalisesInTheAxesItWrites) {
  synth("walk.bvh", "walk", "2");
  const Ran ran =
      run({"convert", "walk.bvh", "z.bvh", "--up", "z", "--floor-at-zero", "--face-forward"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("along z"));
  EXPECT_THAT(ran.err, HasSubstr("faces x"));
}

TEST_F(Robot, ConvertRefusesATakeWithoutFeet) {
  synth("chain.bvh", "spin", "1");
  const Ran ran = run({"convert", "chain.bvh", "out.bvh", "--floor-at-zero"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("no feet found"));
  EXPECT_FALSE(fs::exists(folder / "out.bvh"));
}

}  // namespace
}  // namespace kinemend::test
