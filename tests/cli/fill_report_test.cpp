// Tests of the text report of `kinemend fill`, and of gaps outside the range.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class FillReport : public Program {
 protected:
  /// Makes `count` gaps of four frames, and `count` gaps too long for a spline.
  void make_gaps(int count) {
    synth("walk.bvh", "walk", "12");
    const char* joints[] = {"LeftArm", "RightArm", "LeftForeArm", "RightForeArm", "LeftHand"};
    std::string text;
    for (int i = 0; i < count; ++i) {
      const int first = 20 + 90 * (i / 5);
      text += std::string(joints[i % 5]) + "," + std::to_string(first) + "," +
              std::to_string(first + 3 + i / 5) + "\n";
      text += std::string(joints[i % 5]) + "," + std::to_string(first + 20) + "," +
              std::to_string(first + 60) + "\n";
    }
    put(folder / "gaps.csv", text);
  }
};

TEST_F(FillReport, IsThirtyLinesAtMostWithRefusalsApart) {
  make_gaps(35);
  const std::vector<std::string> words = {"fill",     "walk.bvh", "--gaps", "gaps.csv",
                                          "--method", "spline",   "-o",     "out.bvh"};
  const Ran ran = run(words);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_LE(lines_of(ran.out).size(), 30u) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr("70 gaps: 35 filled, 35 refused; written to out.bvh\n"));
  EXPECT_THAT(ran.out, HasSubstr("35 by spline\n"));
  EXPECT_THAT(ran.out, HasSubstr("  and 25 shorter ones (--verbose lists them)\n"));
  EXPECT_THAT(ran.out, HasSubstr("    and 27 more (--verbose lists them)\n"));
  const std::size_t refused = ran.out.find("\n  35 refused:\n");
  ASSERT_NE(refused, std::string::npos);
  EXPECT_THAT(ran.out.substr(0, refused), Not(HasSubstr("longer than")));
  EXPECT_THAT(ran.out.substr(refused), HasSubstr("longer than"));

  auto verbose = words;
  verbose.insert(verbose.end(), {"--force", "-v"});
  EXPECT_GE(lines_of(run(verbose).out).size(), 70u);
  auto quiet = words;
  quiet.insert(quiet.end(), {"--force", "-q"});
  const Ran still = run(quiet);
  EXPECT_EQ(still.code, 0);
  EXPECT_EQ(still.out + still.err, "");
}

TEST_F(FillReport, GoesBesideTheTakeWhereNoOutputIsNamed) {
  fs::create_directory(folder / "deep");
  synth("deep/walk.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,26\n");
  const Ran ran = run({"fill", "deep/walk.bvh", "--gaps", "gaps.csv"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("written to deep/walk.filled.bvh"));
  EXPECT_TRUE(fs::exists(folder / "deep/walk.filled.bvh"));
  EXPECT_EQ(run({"fill", "deep/walk.bvh", "--gaps", "gaps.csv"}).code, 4) << "exists";
  const Ran stream = run({"fill", "-"}, {hand_take(), {}, {}});
  EXPECT_EQ(stream.code, 0) << stream.err;
  EXPECT_EQ(stream.out, hand_take());
}

TEST_F(FillReport, OnlyGapsWithinTheRangeAreFilled) {
  synth("walk.bvh", "walk", "4");
  put(folder / "gaps.csv", "LeftArm,20,24\nRightArm,58,63\nLeftArm,100,104\nLeftHand,150,154\n");
  const Ran ran = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--range", "60:120", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json report = Json::parse(ran.out)["takes"][0];
  ASSERT_EQ(report["findings"].size(), 1u);
  EXPECT_EQ(report["findings"][0]["first_frame"], 100);
  EXPECT_EQ(report["figures"]["not_within_range"], 3);
  const auto before = lines_of(contents(folder / "walk.bvh"));
  const auto after = lines_of(contents(folder / "walk.filled.bvh"));
  ASSERT_EQ(before.size(), after.size());
  const std::size_t frames = before.size() - 240;
  for (std::size_t f = 1; f <= 240; ++f) {
    EXPECT_EQ(before[frames + f - 1] != after[frames + f - 1], f >= 100 && f <= 104) << f;
  }
  const Ran text = run({"fill", "walk.bvh", "--gaps", "gaps.csv", "--range", "1s:2s", "--dry-run"});
  EXPECT_THAT(text.out, HasSubstr("1 gap: 1 filled, 0 refused; 3 gaps not within --range left"));
  EXPECT_EQ(run({"fill", "walk.bvh", "--range", "7:5", "--dry-run"}).code, 2);
  EXPECT_EQ(run({"fill", "walk.bvh", "--range", "7:500", "--dry-run"}).code, 2);
}

}  // namespace
}  // namespace kinemend::test
