// Tests of reports as findings, JSON and text, and of the rows of a batch and their sums.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cmath>
#include <limits>

#include "kinemend/extend/pages.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/report.hpp"
#include "report/json_schema.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using Json = nlohmann::json;

TakeFacts joints_take() {
  TakeFacts take;
  take.input = "walk.bvh";
  take.output = "out.bvh";
  take.format = "bvh";
  take.tracks = {"Hips", "Spine", "Arm"};
  take.frames = 100;
  take.first_frame = 11;
  take.frame_rate_hz = 50;
  return take;
}

CleanReport cleaned() {
  CleanReport report;
  report.method = "auto";
  report.unit = "deg";
  report.frames = 100;
  report.frame_rate_hz = 50;
  report.tracks = {{.name = "Hips"}, {.name = "Spine"}, {.name = "Arm"}};
  report.tracks[1].noise = 1.5;
  report.tracks[1].frames_changed = 90;
  report.tracks[2].frames_changed = 4;
  report.tracks[2].frames_repaired = 4;
  report.spans = {{-1, 0, 99, Action::denoised, 0.5, 0.1},
                  {1, 5, 94, Action::denoised, 2, 1},
                  {2, 20, 20, Action::despiked, 40, 40},
                  {2, 30, 32, Action::filled, 10, 8}};
  report.root_max_change = 0.5;
  return report;
}

GapOutcome gap(std::size_t track, std::size_t first, std::size_t last, bool filled) {
  GapOutcome outcome;
  outcome.gap = {track, first, last};
  outcome.filled = filled;
  outcome.method = "spline";
  if (!filled) outcome.reason = "is too long";
  return outcome;
}

Json entry(const Report& report, bool with_spans = true) {
  const Json json = Json::parse(to_json(report, with_spans));
  EXPECT_THAT(report_schema_file().problems(json, "take"), IsEmpty());
  return json;
}

double figure_of(const Report& report, std::string_view name) {
  for (const ReportFigure& figure : figures_of(report)) {
    if (figure.name == name) return figure.value.value_or(-1);
  }
  ADD_FAILURE() << name;
  return 0;
}

TEST(Report, NamesWhatWasWrongAlikeForEveryCommand) {
  CheckReport check;
  check.findings = {
      {FindingKind::spike, Severity::warning, "Arm", 20, 20, 40, "deg", "is a spike"}};
  const auto found = findings_of({joints_take(), check}),
             done = findings_of({joints_take(), cleaned()});
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_THAT(done, SizeIs(4));
  EXPECT_EQ(found[0].verdict, "warning");
  EXPECT_EQ(done[2].verdict, "despiked");
  EXPECT_EQ(found[0].kind, done[2].kind);
  EXPECT_EQ(found[0].track, done[2].track);
  EXPECT_EQ(found[0].amount, done[2].amount);
}

TEST(Report, TellsTheRootPositionFromTheRotationOfTheRoot) {
  const auto findings = findings_of({joints_take(), cleaned()});
  EXPECT_EQ(findings[0].track, "Hips");
  EXPECT_EQ(findings[0].quantity, "position");
  EXPECT_EQ(findings[0].unit, "");
  EXPECT_EQ(findings[1].quantity, "rotation");
  EXPECT_EQ(findings[1].unit, "deg");
}

TEST(Report, AGapThatWasFilledIsOneFinding) {
  CleanReport clean = cleaned();
  clean.fill.gaps = {gap(2, 30, 32, true), gap(2, 50, 70, false)};
  const Report report{joints_take(), clean};
  const auto findings = findings_of(report);
  ASSERT_THAT(findings, SizeIs(5));
  EXPECT_EQ(findings[0].method, "spline");
  EXPECT_EQ(findings[0].amount, 10);
  EXPECT_EQ(findings[1].verdict, "refused");
  EXPECT_EQ(findings[1].reason, "is too long");
  EXPECT_THAT(findings_of(report, false), SizeIs(2)) << "without spans";
  EXPECT_EQ(figure_of(report, "gaps"), 1);
  EXPECT_EQ(figure_of(report, "gaps_refused"), 1);
}

TEST(Report, CountsFramesAsTheFileDoes) {
  const Json json = entry({joints_take(), cleaned()});
  EXPECT_EQ(json["first_frame"], 11);
  EXPECT_EQ(json["findings"][2]["first_frame"], 31);
  EXPECT_EQ(json["findings"][3]["last_frame"], 43);
}

TEST(Report, AnEntryHoldsFactsFiguresAndTracks) {
  const Json json = entry({joints_take(), cleaned()});
  EXPECT_EQ(json["kind"], "joints");
  EXPECT_EQ(json["track_unit"], "deg");
  EXPECT_TRUE(json["unit"].is_null());
  EXPECT_EQ(json["method"], "auto");
  EXPECT_EQ(json["figures"]["tracks_changed"], 2);
  EXPECT_EQ(json["figures"]["frames_repaired"], 4);
  EXPECT_TRUE(json["figures"]["gaps_left"].is_null());
  ASSERT_THAT(json["tracks"], SizeIs(3));
  EXPECT_EQ(json["tracks"][1]["noise"], 1.5);
  EXPECT_FALSE(json["tracks"][1].contains("gaps_left")) << "of markers only";
  EXPECT_THAT(json["verdict"], HasSubstr("noisy: 1.50 deg jitter on 1 joint, 1 spike, 1 gap"));
}

TEST(Report, AdviceNamesThePathOfTheTake) {
  CleanReport clean = cleaned();
  clean.leftovers = {
      {"2 frozen or bridged spans left", "kinemend check TAKE; kinemend clean TAKE"}};
  TakeFacts take = joints_take();
  take.input = "TAKE 1.bvh";
  const Report report{take, clean};
  EXPECT_EQ(entry(report)["leftovers"][0]["mend"],
            "kinemend check TAKE 1.bvh; kinemend clean TAKE 1.bvh");
  EXPECT_THAT(to_text(report), HasSubstr("left (kinemend check TAKE 1.bvh; kinemend clean TAKE 1"));
}

TEST(Report, MarkersAreToldInTheUnitOfTheFile) {
  TakeFacts take = joints_take();
  take.kind = TakeKind::markers;
  take.unit = "mm";
  CleanReport clean = cleaned();
  clean.kind = TakeKind::markers;
  clean.unit = "mm";
  clean.body_height = 1750;
  clean.spans.erase(clean.spans.begin());
  clean.tracks[0].gaps_left = 2;
  clean.swaps = {{0, 1, 3, 8}};
  const Json json = entry({take, clean});
  EXPECT_EQ(json["kind"], "markers");
  EXPECT_EQ(json["track_unit"], "mm");
  EXPECT_EQ(json["tracks"][0]["gaps_left"], 2);
  EXPECT_EQ(json["figures"]["gaps_left"], 2);
  EXPECT_TRUE(json["figures"]["root_max_change"].is_null());
  EXPECT_EQ(json["findings"][0]["kind"], "swap");
  EXPECT_EQ(json["findings"][0]["track"], "Hips, Spine");
  EXPECT_EQ(json["findings"][1]["unit"], "mm");
  EXPECT_EQ(json["findings"][1]["quantity"], "position");
}

TEST(Report, WhatIsNotFiniteIsNullAndCountsAreWhole) {
  Comparison comparison;
  comparison.frames = 100;
  comparison.psnr_db = std::numeric_limits<double>::infinity();
  comparison.joints.resize(3);
  const Json json = entry({joints_take(), CompareOutcome{"truth.bvh", comparison}});
  EXPECT_TRUE(json["figures"]["psnr_db"].is_null());
  EXPECT_TRUE(json["figures"]["foot_slide"].is_null());
  EXPECT_TRUE(json["figures"]["frames_compared"].is_number_integer());
  EXPECT_TRUE(json["tracks"][0]["peak_frames"].is_number_integer());
  EXPECT_TRUE(json["tracks"][0]["geodesic_rms_deg"].is_number_float());
}

TEST(Report, BytesThatAreNoTextAreReplaced) {
  TakeFacts take = joints_take();
  take.tracks[2] = "A\xE7m";
  CheckReport check;
  check.tracks = {{.name = take.tracks[2]}};
  EXPECT_EQ(entry({take, check})["tracks"][0]["name"], "A\uFFFDm");
}

TEST(Report, ADocumentHoldsItsEntriesAsTheyAre) {
  const std::vector<std::string> takes = {to_json({joints_take(), cleaned()}),
                                          failure_json("bad\n.bvh", "no", 3)};
  const std::string document = report_document("clean", takes);
  const Json json = Json::parse(document);
  EXPECT_THAT(report_schema_file().problems(json), IsEmpty());
  EXPECT_EQ(json["takes"][0], Json::parse(takes[0]));
  EXPECT_EQ(json["takes"][1]["input"], "bad\n.bvh");
  EXPECT_THAT(document, HasSubstr("\n      \"input\": \"walk.bvh\",\n"));
  EXPECT_EQ(Json::parse(report_document("check", {}))["takes"], Json::array());
}

TEST(Report, ADoubtIsNoFaultAndIsNotNothing) {
  CheckReport check;
  check.frames = 100;
  EXPECT_THAT(verdict_of({joints_take(), check}), HasSubstr("no fault found"));
  for (const FindingKind kind : {FindingKind::no_contact, FindingKind::expected_noise}) {
    CheckReport doubtful = check;
    doubtful.findings = {{kind, Severity::note, "", 0, 99, 3.4, "deg", "is expected"}};
    EXPECT_EQ(verdict_of({joints_take(), doubtful}),
              "no fault found, but the take is probably noisy: see the notes");
    doubtful.findings.push_back(
        {FindingKind::spike, Severity::warning, "Arm", 20, 20, 40, "deg", "is a spike"});
    EXPECT_EQ(verdict_of({joints_take(), doubtful}), "0 serious, 1 warning");
  }
}

TEST(Report, LimitsNameTheWorstFinding) {
  CheckReport check;
  check.figures.spikes = 3;
  check.noise_unit = "deg";
  check.figures.worst_noise = 1.25;
  check.frames = 100;
  check.findings = {
      {FindingKind::spike, Severity::warning, "Arm", 20, 20, 40, "deg", "is a spike"}};
  const Report report{joints_take(), check};
  const std::vector<FigureLimit> limits = {{"worst_noise", 1}, {"spikes", 2}, {"slide_cm", 1}};
  EXPECT_THAT(
      passed_limits(report, limits),
      ElementsAre("walk.bvh: spikes: 3 is above the limit 2; frame 31: Arm is a spike (40 deg)",
                  "walk.bvh: noise of the worst track: 1.25 deg is above the limit 1 deg"));
  EXPECT_THAT(passed_limits(report, {}), IsEmpty());
}

TEST(Report, LimitsOfAComparisonDoNotHoldWhereTheFigureIsUnknown) {
  Comparison comparison;
  comparison.psnr_db = 30;
  const Report report{joints_take(), CompareOutcome{"truth.bvh", comparison}};
  const std::vector<FigureLimit> limits = {{"psnr_db", 40}, {"foot_slide", 1}, {"rms_deg", 1}};
  EXPECT_THAT(
      passed_limits(report, limits),
      ElementsAre("psnr_db 30 is below the limit 40",
                  "foot_slide is unknown because no foot has ground contact: --max-foot-slide "
                  "cannot be checked"));
}

TEST(Report, TextIsPlainUnlessColoursAreAskedFor) {
  const Report report{joints_take(), cleaned()};
  const std::string plain = to_text(report);
  EXPECT_THAT(plain, AllOf(HasSubstr("walk.bvh: noisy: "), HasSubstr("; written to out.bvh\n"),
                           Not(HasSubstr("\033"))));
  EXPECT_THAT(to_text(report, {.details = false, .colours = true}), HasSubstr("\033[33mnoisy"));
}

TEST(Report, FactsAreThoseOfTheClip) {
  const Take clip = synthesize({.motion = "walk", .duration_s = 1, .frame_rate_hz = 60});
  const TakeFacts facts = take_facts(clip);
  EXPECT_EQ(facts.frames, clip.frame_count());
  EXPECT_EQ(facts.tracks, clip.skeleton.names);
  EXPECT_EQ(facts.first_frame, 1);
  Take markers = make_marker_take({"A", "B"}, 5, 100);
  markers.unit = "mm";
  markers.first_frame = 7;
  EXPECT_EQ(take_facts(markers).kind, TakeKind::markers);
  EXPECT_EQ(take_facts(markers).metres_per_unit, 0.001);
  EXPECT_EQ(take_facts(markers).first_frame, 7);
  EXPECT_EQ(take_facts(markers).contents, "");
  EXPECT_EQ(take_facts(Take(make_marker_take({}, 0, 100))).contents, "no points");
}

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
