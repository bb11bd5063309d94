// Tests of the rows of a batch and of their sums.
#include "kinemend/extend/pages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/json_schema.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Json = nlohmann::json;

BatchRow cleaned(const std::string& name, std::size_t repaired,
                 const std::vector<std::string>& warnings = {}) {
  CleanReport report;
  report.frames = 100;
  report.tracks = {{.name = "Hips"}};
  if (repaired > 0) report.spans = {{0, 0, repaired - 1, Action::despiked, 9, 9}};
  TakeFacts take;
  take.input = "raw/" + name;
  take.tracks = {"Hips"};
  take.frames = 100;
  take.frame_rate_hz = 50;
  return cleaned_row(name, {take, report}, warnings);
}

TEST(BatchRows, ReadBackAsTheyWereWritten) {
  const BatchRow row = cleaned("a.bvh", 3, {"a warning"});
  EXPECT_THAT(report_schema_file().problems(Json::parse(row.json)), IsEmpty());
  EXPECT_THAT(row.json, Not(HasSubstr("\n")));
  const auto read = parse_row(row.json);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->json, row.json);
  EXPECT_EQ(read->name, "a.bvh");
  EXPECT_EQ(read->status, "cleaned");
  EXPECT_EQ(read->frames, 100U);
  EXPECT_EQ(read->frames_repaired, 3U);
  EXPECT_EQ(read->spikes, 1U);
  EXPECT_EQ(read->frame_rate_hz, 50);
  EXPECT_THAT(read->warnings, SizeIs(1));
}

TEST(BatchRows, OfAnythingAreReadWithoutHarm) {
  EXPECT_FALSE(parse_row("[1]"));
  EXPECT_FALSE(parse_row("{\"name\": \"cut"));
  const auto odd =
      parse_row("{\"name\": 3, \"frames\": -1, \"figures\": 7, \"warnings\": [1, \"w\"]}");
  ASSERT_TRUE(odd);
  EXPECT_EQ(odd->name, "");
  EXPECT_EQ(odd->frames, 0U);
  EXPECT_THAT(odd->warnings, SizeIs(1));
}

TEST(BatchRows, TheWorstHaveWarningsOrManyRepairs) {
  const std::vector<BatchRow> rows = {cleaned("good.bvh", 0), cleaned("few.bvh", 2),
                                      cleaned("many.bvh", 50), cleaned("warned.bvh", 1, {"w"}),
                                      failed_row("bad.bvh", "raw/bad.bvh", "no", 3)};
  const std::vector<BatchRow> worst = worst_rows(rows);
  ASSERT_THAT(worst, SizeIs(3));
  EXPECT_EQ(worst[0].name, "warned.bvh");
  EXPECT_EQ(worst[1].name, "many.bvh");
  EXPECT_EQ(worst[2].name, "few.bvh");
  EXPECT_THAT(worst_rows(rows, 2), SizeIs(2));
}

TEST(BatchRows, AddUp) {
  const BatchRow done = cleaned("a.bvh", 3), failed = failed_row("b.bvh", "raw/b.bvh", "no", 3);
  BatchSums sums;
  sums.add("a.bvh", &done);
  sums.add("b.bvh", &failed);
  sums.add("c.bvh", nullptr);
  EXPECT_EQ(sums.takes, 3U);
  EXPECT_EQ(sums.duration_s, 2);
  const Json json = Json::parse(to_json(sums, "abc"));
  EXPECT_THAT(report_schema_file().problems(json), IsEmpty());
  EXPECT_EQ(json["figures"]["to_do"], 1);
  EXPECT_EQ(json["failures"][0]["name"], "b.bvh");
  BatchCounts counts;
  counts.add(done, true, 0);
  counts.add(failed, true, 3);
  counts.add(plain_row("d.asf", "copied"), true, 0);
  EXPECT_EQ(counts.exit_code, 3);
  EXPECT_THAT(to_text(counts, sums, {}),
              HasSubstr("1 cleaned, 0 done already, 1 failed, 1 skeleton copied\nin total: 1 of 3 "
                        "takes done, 1 failed, 1 to do; 0.0 minutes of motion\n"));
}

}  // namespace
}  // namespace kinemend::test
