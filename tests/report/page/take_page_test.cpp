// Tests of the parts of whole pages.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "kinemend/error.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "report/page/page_parts.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double bound_deg = 0.02;

Take walk(double duration_s = 2, double rate = 60) {
  return synthesize({.duration_s = duration_s, .frame_rate_hz = rate});
}

Take damaged(Take clip) {
  Random random(3);
  apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  apply_damage(clip, "outliers", {{"share", 0.004}, {"std_deg", 25.0}}, random);
  return clip;
}

Report report_of(const Take& take) {
  Report report{take_facts(take), CheckReport()};
  report.take.input = "walk.bvh";
  return report;
}

std::string page_of(const Take& before, const Take* after) {
  return report_page(report_of(before), before, after,
                     {.command = "clean", .command_line = "kinemend clean walk.bvh"});
}

double body_height_of(const std::string& page) {
  return json_part(page, "take")["stage"]["height"].get<double>();
}

// Expects channels in the order of `channels_of` for a clip whose joints all have three axes.
void expect_motion(const Take& clip, const std::vector<std::vector<double>>& channels,
                   double position_bound) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_NEAR(channels[0][f], clip.root_position(f).x, position_bound);
    EXPECT_NEAR(channels[1][f], clip.root_position(f).y, position_bound);
    EXPECT_NEAR(channels[2][f], clip.root_position(f).z, position_bound);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      std::array<double, 3> angles{};
      for (std::size_t a = 0; a < 3; ++a)
        angles[a] = channels[3 + 3 * j + a][f] / degrees_per_radian;
      const Quat told = from_euler(angles, clip.skeleton.rotation_order(j));
      ASSERT_LE(angle_between(told, clip.rotation(f, j)) * degrees_per_radian, 3 * bound_deg + 1e-6)
          << "frame " << f << ", joint " << j;
    }
  }
}

class Page : public testing::Test {
 protected:
  void SetUp() override {
    // A build without the page must only say so.
    if (has_report_page()) return;
    try {
      page_of(walk(), static_cast<const Take*>(nullptr));
      ADD_FAILURE() << "a page without its program";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_THAT(error.what(), HasSubstr("without its report page"));
    }
    GTEST_SKIP() << "built without the page";
  }
};

TEST_F(Page, HoldsTheMotionBeforeAndAfterWithinItsBounds) {
  const Take after = walk(), before = damaged(after);
  const std::string page = page_of(before, &after);
  const PageChannels channels = channels_in(page);
  ASSERT_EQ(channels.before.size(), 3 + 3 * after.joint_count());
  const double bound = body_height_of(page) / 34000 + 1e-9;
  expect_motion(before, channels.before, bound);
  expect_motion(after, channels.after, bound);
}

TEST_F(Page, OfAMinuteOfThirtyOneNoisyJointsIsBelowTwoMegabytes) {
  const Take after = walk(60, 120), before = damaged(after);
  ASSERT_EQ(after.joint_count(), 31u);
  EXPECT_LT(page_of(before, &after).size(), 1'950'000u);
  // The limit holds whichever take is the noisy one.
  EXPECT_LT(page_of(after, &before).size(), 1'950'000u);
}

TEST_F(Page, HoldsMarkersWithTheirGaps) {
  Take clip = make_marker_take({"A", "B", "Angle"}, 50, 100);
  clip.unit = "mm";
  clip.first_frame = 101;
  clip.is_position = {1, 1, 0};
  for (std::size_t f = 0; f < 50; ++f) {
    for (std::size_t m = 0; m < 3; ++m) {
      clip.position(f, m) = {10.0 * static_cast<double>(f), 5.5, 100.0 * static_cast<double>(m)};
      clip.observed[f * 3 + m] = m != 1 || f < 20 || f > 29 ? 1 : 0;
    }
  }
  const std::string page = page_of(clip, static_cast<const Take*>(nullptr));
  const PageJson take = json_part(page, "take");
  EXPECT_EQ(take["kind"], "markers");
  EXPECT_EQ(take["first_frame"], 101);
  EXPECT_EQ(take["gaps"]["before"]["own"], PageJson::parse("[[1, 20, 29]]"));
  EXPECT_EQ(take["gaps"]["after"], nullptr);
  EXPECT_EQ(take["shown"], PageJson::parse("[true, true, false]"));
  EXPECT_EQ(take["links"], PageJson::parse("[[0, 1]]"));
  const auto channels = channels_in(page).before;
  ASSERT_EQ(channels.size(), 9u);
  const double bound = take["quanta"][0].get<double>() / 2 + 1e-9;
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_NEAR(channels[0][f], 10.0 * static_cast<double>(f), bound);
    // Missing samples repeat the last value.
    EXPECT_NEAR(channels[3][f], f < 20 || f > 29 ? 10.0 * static_cast<double>(f) : 190, bound);
    EXPECT_NEAR(channels[6][f], 10.0 * static_cast<double>(f), bound);
  }
}

TEST_F(Page, OfALongTakeComesInTwoParts) {
  Take clip = make_marker_take({"A"}, 840'001, 1000);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    clip.position(f, 0) = {static_cast<double>(f % 1000), 0, 0};
    clip.observed[f] = 1;
  }
  clip.unit = "mm";
  const std::string page = page_of(clip, static_cast<const Take*>(nullptr));
  ASSERT_EQ(json_part(page, "take")["stride"], 8);
  const auto channels = channels_in(page).before;
  ASSERT_EQ(channels[0].size(), clip.frame_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    ASSERT_NEAR(channels[0][f], static_cast<double>(f % 1000), 0.06) << f;
}

TEST_F(Page, CarriesTheReportAndTheCommand) {
  const Take clip = walk();
  Report report = report_of(clip);
  std::get<CheckReport>(report.result)
      .findings.push_back(
          {FindingKind::spike, Severity::warning, "LeftArm", 4, 5, 30, "deg", "a spike"});
  const std::string page = report_page(
      report, clip, nullptr, {.command = "check", .command_line = "kinemend check 'a b'"});
  const PageJson document = json_part(page, "report");
  EXPECT_EQ(document["schema"], report_schema);
  EXPECT_EQ(document["command"], "check");
  EXPECT_EQ(document["takes"][0]["findings"][0]["track"], "LeftArm");
  EXPECT_EQ(document["takes"][0]["findings"][0]["first_frame"], 5);
  EXPECT_EQ(json_part(page, "take")["command_line"], "kinemend check 'a b'");
}

TEST_F(Page, HasNoMarkupOfNamesInIt) {
  Take clip = walk();
  const std::string nasty = "</script><script>alert(1)</script>\"'&\xff\xc3\xa9";
  clip.skeleton.names[3] = nasty;
  Report report = report_of(clip);
  report.take.input = "dir/<img src=x>" + nasty + ".bvh";
  const std::string page = report_page(report, clip, nullptr, {.command = "check"});
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(page, Not(HasSubstr("<img")));
  EXPECT_THAT(json_part(page, "take")["names"][3].get<std::string>(),
              HasSubstr("</script><script>alert(1)</script>\"'&"));
}

TEST_F(Page, FetchesNothing) {
  const std::string page = page_of(walk(), static_cast<const Take*>(nullptr));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr(" src=\"http")));
}

TEST_F(Page, TellsTheLicencesOfWhatItIsMadeOf) {
  const std::string page = page_of(walk(), static_cast<const Take*>(nullptr));
  EXPECT_THAT(page, HasSubstr("three.js authors"));
  EXPECT_THAT(page, HasSubstr("Leon Sorokin"));
}

TEST_F(Page, IsMadeOfTakesWithNothingInThem) {
  const Take empty = slice(walk(), 0, 0);
  EXPECT_EQ(json_part(page_of(empty, &empty), "take")["told"], 0);
  const Take one = slice(walk(), 3, 4);
  EXPECT_EQ(json_part(page_of(one, &one), "take")["told"], 1);
  const Take none = make_marker_take({}, 0, 100);
  EXPECT_EQ(json_part(page_of(none, &none), "take")["names"].size(), 0u);
  const Take unseen = make_marker_take({"A", "B"}, 10, 100);
  EXPECT_EQ(json_part(page_of(unseen, &unseen), "take")["gaps"]["after"]["own"].size(), 2u);
}

TEST_F(Page, IsOfTwoTakesOfOneLengthOnly) {
  const Take before = walk(), shorter = slice(before, 0, 10);
  EXPECT_THROW(page_of(before, &shorter), Error);
  const Take a = make_marker_take({"A"}, 5, 100), b = make_marker_take({"A", "B"}, 5, 100);
  EXPECT_THROW(page_of(a, &b), Error);
}

TEST_F(Page, KnowsWhereTheFloorIsAndWhenFeetStand) {
  const PageJson stage =
      json_part(page_of(walk(4, 120), static_cast<const Take*>(nullptr)), "take")["stage"];
  EXPECT_EQ(stage["up"], "y");
  EXPECT_EQ(stage["sign"], 1.0);
  EXPECT_NEAR(stage["floor"].get<double>(), 0, 3);
  EXPECT_GE(stage["contacts"].size(), 5u);
}

}  // namespace
}  // namespace kinemend::test
