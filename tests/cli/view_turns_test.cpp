// Tests which runs of the `kinemend view` page a newer run stops.
#include "cli/view_turns.hpp"

#include <gtest/gtest.h>

#include "kinemend/error.hpp"

namespace kinemend::cli {
namespace {

TEST(ViewTurns, ARunOvertakesTheRunsAndTheCurvesOfItsTab) {
  ViewTurns turns;
  const auto first = turns.begin("a", ViewTurn::run);
  const auto curves = turns.begin("a", ViewTurn::curves);
  EXPECT_FALSE(first.is_overtaken()) << "curves are asked for beside a run";
  EXPECT_FALSE(curves.is_overtaken());
  const auto second = turns.begin("a", ViewTurn::run);
  EXPECT_TRUE(first.is_overtaken());
  EXPECT_TRUE(curves.is_overtaken());
  EXPECT_FALSE(second.is_overtaken());
  EXPECT_THROW(first.check(), Error);
  EXPECT_NO_THROW(second.check());
}

TEST(ViewTurns, CurvesOvertakeCurvesAlone) {
  ViewTurns turns;
  const auto run = turns.begin("a", ViewTurn::run);
  const auto first = turns.begin("a", ViewTurn::curves);
  const auto second = turns.begin("a", ViewTurn::curves);
  EXPECT_TRUE(first.is_overtaken());
  EXPECT_FALSE(second.is_overtaken());
  EXPECT_FALSE(run.is_overtaken());
}

TEST(ViewTurns, TabsLeaveEachOtherAlone) {
  ViewTurns turns;
  const auto one = turns.begin("a", ViewTurn::run);
  const auto other = turns.begin("b", ViewTurn::run);
  EXPECT_FALSE(one.is_overtaken());
  turns.leave("b");
  EXPECT_TRUE(other.is_overtaken());
  EXPECT_FALSE(one.is_overtaken());
  turns.leave("never there");
  EXPECT_FALSE(turns.begin("b", ViewTurn::run).is_overtaken()) << "a page that is gone back to";
}

TEST(ViewTurns, TheEndOfTheProgramGivesUpAll) {
  ViewTurns turns;
  const auto one = turns.begin("a", ViewTurn::run);
  turns.stop();
  EXPECT_TRUE(one.is_overtaken());
  EXPECT_TRUE(turns.begin("b", ViewTurn::run).is_overtaken());
}

}  // namespace
}  // namespace kinemend::cli
