// External JSON that is nested deeply enough to exhaust the stack is refused; a batch redoes such a
// record.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

class JsonDepth : public Program {
 protected:
  static std::string nested(const std::string& before) {
    return before + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
  }
};

TEST_F(JsonDepth, APlanAndAReportThatAreNestedDeeplyAreRefused) {
  synth("walk.bvh");
  put(folder / "deep.json", nested(R"({"schema": "kinemend.gap-plan/1", "gaps": )"));
  const Ran fill = run({"fill", "walk.bvh", "--plan", "deep.json", "-o", "filled.bvh"});
  EXPECT_EQ(fill.code, 3);
  EXPECT_EQ(fill.err, "kinemend: deep.json:1: JSON is nested more than 64 levels deep\n");
  put(folder / "report.json", nested(R"({"takes": )"));
  const Ran clean = run({"clean", "walk.bvh", "--noise", "report.json", "-o", "cleaned.bvh"});
  EXPECT_NE(clean.code, 0);
  EXPECT_LT(clean.code, 128) << "a signal ended it";
  EXPECT_THAT(clean.err, HasSubstr("report.json"));
}

TEST_F(JsonDepth, ARecordOfABatchThatIsNestedDeeplyIsMadeAgain) {
  fs::create_directory(folder / "raw");
  synth("raw/walk.bvh");
  ASSERT_EQ(run({"batch", "raw", "-o", "out", "--quiet"}).code, 0);
  int records = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    if (entry.path().extension() != ".json") continue;
    put(entry.path(), nested(R"({"row": )"));
    ++records;
  }
  ASSERT_GT(records, 0);
  const Ran again = run({"batch", "raw", "-o", "out", "--quiet", "--force"});
  EXPECT_EQ(again.code, 0) << again.err;
}

}  // namespace
}  // namespace kinemend::test
