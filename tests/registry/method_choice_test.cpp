// Tests which methods state that they can clean a take.
#include "kinemend/extend/method_options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemend/extend/model.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Take gait_at(double rate_hz) {
  return synthesize({.motion = "walk", .duration_s = 0.5, .frame_rate_hz = rate_hz});
}

std::string why_not_by(std::string_view method, const Take& take) {
  return why_not(find_method(method), take);
}

TEST(MethodChoice, ANetworkOfOneRateSaysThatATakeHasAnother) {
  EXPECT_EQ(why_not_by("recurrent", gait_at(120)), "");
  EXPECT_EQ(why_not_by("recurrent", gait_at(60)),
            "the network filters takes of 120 Hz only, and this one has 60");
}

TEST(MethodChoice, AModelSaysWhichPartsASkeletonLacks) {
  const Take prop = empty_take(60, 120);
  for (const char* method : {"example", "wiener", "sparse", "recurrent"}) {
    EXPECT_EQ(why_not_by(method, gait_at(120)), "") << method;
    EXPECT_THAT(why_not_by(method, prop), HasSubstr("the model knows")) << method;
  }
}

TEST(MethodChoice, AMethodWithoutAModelSaysThatItNeedsOne) {
  EXPECT_THAT(why_not_by("kalman-learned", gait_at(120)), HasSubstr("needs a model"));
}

TEST(MethodChoice, MethodsWithoutAModelCleanAnyTake) {
  for (const Method& method : methods()) {
    if (method.learned && method.name != "learned") continue;
    EXPECT_EQ(why_not(method, empty_take(60, 24)), "") << method.name;
    EXPECT_EQ(why_not(method, joint_markers(gait_at(60))), "") << method.name;
  }
}

}  // namespace
}  // namespace kinemend::test
