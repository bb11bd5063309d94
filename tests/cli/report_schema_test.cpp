// The JSON of every command fits docs/report.schema.json.
#include "cli/program.hpp"
#include "report/json_schema.hpp"

namespace kinemend::test {
namespace {

using testing::IsEmpty;
using testing::Not;

class ReportSchema : public Program {
 protected:
  /// Returns the printed JSON, or that of the file.
  Json document(const std::vector<std::string>& words, int code = 0, const std::string& file = "") {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, code) << words[0] << ": " << ran.err;
    const Json json = Json::parse(file.empty() ? ran.out : contents(folder / file));
    EXPECT_THAT(report_schema_file().problems(json), IsEmpty()) << words[0];
    EXPECT_EQ(json["schema"], "kinemend.report/1");
    EXPECT_EQ(json["command"], words[0]);
    return json;
  }

  void put_takes() {
    noisy("walk.bvh", "3");
    put(folder / "gaps.csv", "LeftArm,20,22\nHips,30,150\n");
    fs::copy_file(fs::path(KINEMEND_TEST_FIXTURES) / "trc/good/gaps.trc", folder / "m.trc");
  }
};

TEST_F(ReportSchema, HoldsForClean) {
  put_takes();
  put(folder / "bad.bvh", "HIERARCHY\n");
  const Json json = document(
      {"clean", "walk.bvh", "m.trc", "bad.bvh", "--output-dir", "out", "--feet", "auto", "--json"},
      3);
  ASSERT_EQ(json["takes"].size(), 3u);
  EXPECT_TRUE(json["takes"][0]["feet"].is_object());
  EXPECT_TRUE(json["takes"][2].contains("error"));
  const Json all = document({"clean", "walk.bvh", "--fill", "auto", "--gaps", "gaps.csv", "-o",
                             "c.bvh", "--report", "r.json"},
                            0, "r.json");
  EXPECT_THAT(all["takes"][0]["findings"], Not(IsEmpty()));
}

TEST_F(ReportSchema, HoldsForALearnedMethodAndForSwaps) {
#if defined(KINEMEND_SANITIZED)
  GTEST_SKIP() << "learned methods take minutes";
#endif
  put_takes();
  const Json json = document({"clean", "walk.bvh", "-m", "wiener", "--dry-run", "--json"});
  EXPECT_TRUE(json["takes"][0]["output"].is_null());
  document({"clean", "m.trc", "--fix-swaps", "--dry-run", "--report", "r.json"}, 0, "r.json");
}

TEST_F(ReportSchema, HoldsForCheck) {
  put_takes();
  const Json json = document({"check", "walk.bvh", "m.trc", "nowhere.bvh", "--json"}, 3);
  EXPECT_THAT(json["takes"][0]["findings"], Not(IsEmpty()));
  // Counts are whole numbers.
  EXPECT_TRUE(json["takes"][0]["figures"]["gaps"].is_number_integer());
  const Json robot = document({"check", "walk.bvh", "m.trc", "--robot", "--json"});
  EXPECT_THAT(robot["takes"][0]["robot"]["contacts"], Not(IsEmpty()));
  EXPECT_TRUE(robot["takes"][0]["figures"]["jumps"].is_number_integer());
}

TEST_F(ReportSchema, HoldsForFill) {
  put_takes();
  const Json json =
      document({"fill", "walk.bvh", "--gaps", "gaps.csv", "-m", "spline", "-o", "f.bvh", "--json"});
  EXPECT_THAT(json["takes"][0]["findings"], Not(IsEmpty()));
  document({"fill", "m.trc", "--dry-run", "--report", "r.json"}, 0, "r.json");
}

TEST_F(ReportSchema, HoldsForCompareAndContacts) {
  put_takes();
  const Json json = document({"compare", "truth.bvh", "walk.bvh", "--json"});
  EXPECT_EQ(json["takes"][0]["input"], "walk.bvh");
  EXPECT_EQ(json["takes"][0]["reference"], "truth.bvh");
  document({"compare", "m.trc", "m.trc", "--fit", "rigid", "--json"});
  document({"contacts", "truth.bvh", "--json"});
}

TEST_F(ReportSchema, HoldsForBatch) {
  fs::create_directory(folder / "raw");
  put_takes();
  for (const char* name : {"walk.bvh", "m.trc"})
    fs::copy_file(folder / name, folder / "raw" / name);
  put(folder / "raw/bad.bvh", "HIERARCHY\n");
  document({"batch", "raw", "-o", "out", "--feet", "auto", "--json"}, 3);
  const std::vector<std::string> rows = lines_of(contents(folder / "out/rows.jsonl"));
  EXPECT_GE(rows.size(), 3u);
  for (const std::string& line : rows) {
    EXPECT_THAT(report_schema_file().problems(Json::parse(line)), IsEmpty()) << line;
  }
}

}  // namespace
}  // namespace kinemend::test
