// Tests of the limits of `fill`: the expected error of a gap, and unlabelled points.
#include <fmt/format.h>

#include <cmath>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using FillLimits = Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(FillLimits, AFillAboveTheLimitIsRefusedWithBothFiguresAndTheirUnit) {
  put(folder / "plate.trc", plate_take());
  const Ran ran = run({"fill", "plate.trc", "-o", "out.trc", "--max-error-mm", "0.001"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("1 gap: 0 filled, 1 refused"),
                             testing::ContainsRegex("the expected error of [a-z-]+, [0-9.]+ mm, is "
                                                    "above the limit of 0.001 mm")));
  EXPECT_THAT(run({"fill", "plate.trc", "--dry-run", "--max-error-mm", "500"}).out,
              HasSubstr("1 filled, 0 refused"));
}

TEST_F(FillLimits, ALimitInDegreesHoldsForRotations) {
  synth("walk.bvh", "walk", "3");
  put(folder / "gaps.csv", "LeftArm,60,80\n");
  const std::vector<std::string> words = {"fill",     "walk.bvh",  "--gaps",
                                          "gaps.csv", "--dry-run", "--max-error-deg"};
  auto strict = words, wide = words;
  strict.emplace_back("0.0001");
  wide.emplace_back("90");
  EXPECT_THAT(run(strict).out, AllOf(HasSubstr("0 filled, 1 refused"), HasSubstr(" deg, is above "
                                                                                 "the limit of")));
  EXPECT_THAT(run(wide).out, HasSubstr("1 filled, 0 refused"));
  auto all = wide;
  all.emplace_back("--fill-all");
  const Ran both = run(all);
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("--fill-all fills every gap"));
}

TEST_F(FillLimits, AMethodThatCannotTellItsErrorIsRefusedUnderALimit) {
  put(folder / "plate.trc", plate_take());
  EXPECT_THAT(run({"fill", "plate.trc", "--dry-run", "-m", "spline", "--max-error-mm", "500"}).out,
              HasSubstr("spline cannot tell its error, and the limit is 500 mm"));
}

TEST_F(FillLimits, ALimitOfDegreesMeansNothingForMarkers) {
  put(folder / "plate.trc", plate_take());
  const Ran ran = run({"fill", "plate.trc", "--dry-run", "--max-error-deg", "5"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("--max-error-deg has no effect on markers"));
  EXPECT_EQ(run({"fill", "plate.trc", "--dry-run", "--max-error-deg", "5", "--strict"}).code, 1);
}

/// Renames marker B of the plate to a typical name of an unlabelled point.
std::string with_name(std::string trc, const std::string& name) {
  trc.replace(trc.find("\tB\t"), 3, "\t" + name + "\t");
  return trc;
}

TEST_F(FillLimits, UnlabelledPointsAreLeftAloneUnlessAskedFor) {
  for (const char* name : {"*52", "U_12", "Unlabeled 1234"}) {
    put(folder / "take.trc", with_name(plate_take(), name));
    const Ran left = run({"fill", "take.trc", "--dry-run", "--json"});
    ASSERT_EQ(left.code, 0) << left.err;
    const Json figures = Json::parse(left.out)["takes"][0]["figures"];
    EXPECT_EQ(figures["filled"], 0) << name;
    EXPECT_EQ(figures["unlabelled"], 1) << name;
    EXPECT_THAT(run({"fill", "take.trc", "--dry-run"}).out,
                HasSubstr("1 gap of unlabelled points left alone (--unlabelled fills them)"));
    EXPECT_THAT(run({"fill", "take.trc", "--dry-run", "--unlabelled"}).out,
                HasSubstr("1 gap: 1 filled, 0 refused"));
    EXPECT_THAT(run({"clean", "take.trc", "--dry-run", "--fill", "auto"}).out,
                AllOf(HasSubstr("1 gap left"), HasSubstr("1 gap of unlabelled points left alone")));
    EXPECT_THAT(run({"clean", "take.trc", "--dry-run", "--fill", "auto", "--unlabelled"}).out,
                Not(HasSubstr("gap left")));
  }
}

TEST_F(FillLimits, ErrorsOfATakeInMetresAreShownInMillimetres) {
  put(folder / "plate.trc", plate_take());
  ASSERT_EQ(run({"convert", "plate.trc", "-o", "metres.trc", "--unit", "m"}).code, 0);
  const Ran filled = run({"fill", "metres.trc", "--dry-run", "--max-error-mm", "0.001"});
  EXPECT_THAT(filled.out, AllOf(HasSubstr(" mm, is above the limit of 0.001 mm"),
                                Not(HasSubstr(" m,")), Not(HasSubstr("e-0"))));
  const Ran cleaned = run({"clean", "metres.trc", "--dry-run"});
  EXPECT_THAT(cleaned.out, AllOf(HasSubstr(" mm jitter on "), HasSubstr("noise mm"),
                                 HasSubstr("peak m/s before"), HasSubstr(" mm per axis")));
  EXPECT_THAT(run({"check", "metres.trc"}).out, HasSubstr(" mm)"));
}

}  // namespace
}  // namespace kinemend::test
