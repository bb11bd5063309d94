// Tests of mirrored and reversed motion.
#include "lab/samples/motion_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "kinemend/extend/body.hpp"
#include "synthetic_walks.hpp"

namespace kinemend {
namespace {

const TrainingSequences& walk_in_forms() {
  static const TrainingSequences sequences = encoded_walks(3);
  return sequences;
}

std::vector<float> values_of_walk() {
  const std::vector<double> values = sequence_at(walk_in_forms(), 0).poses.values;
  return {values.begin(), values.end()};
}

TEST(RecurrentForms, AMirroredWalkHasTheOtherKneesBendAndTwiceMirroredIsItself) {
  const BodyLayout& layout = walk_in_forms().layout;
  const BodyMirror mirror = mirror_of(layout);
  for (std::size_t n = 0; n < mirror.partners.size(); ++n)
    EXPECT_EQ(mirror.partners[mirror.partners[n]], n);
  const std::vector<float> truth = values_of_walk();
  const std::vector<float> once = in_form(truth, {true, false}, mirror);
  EXPECT_NE(once, truth);
  EXPECT_EQ(in_form(once, {true, false}, mirror), truth);
  const auto track = [&](const char* name) {
    return static_cast<std::size_t>(std::find(layout.names.begin(), layout.names.end(), name) -
                                    layout.names.begin());
  };
  const std::size_t width = layout.channel_count(), place = width - 3;
  const std::size_t left = 3 * track("LeftLeg"), right = 3 * track("RightLeg");
  for (std::size_t row = 0; row < truth.size(); row += width) {
    EXPECT_EQ(once[row + right], truth[row + left]);
    EXPECT_EQ(once[row + right + 1], -truth[row + left + 1]);
    EXPECT_EQ(once[row + place], -truth[row + place]);
    EXPECT_EQ(once[row + place + 1], truth[row + place + 1]);
  }
}

TEST(RecurrentForms, BackwardsTheLastFrameIsTheFirst) {
  const BodyMirror mirror = mirror_of(walk_in_forms().layout);
  const std::vector<float> truth = values_of_walk();
  const std::vector<float> once = in_form(truth, {false, true}, mirror);
  const std::size_t width = walk_in_forms().layout.channel_count(), last = truth.size() - width;
  for (std::size_t c = 0; c < width; ++c) EXPECT_EQ(once[c], truth[last + c]);
  EXPECT_EQ(in_form(once, {false, true}, mirror), truth);
}

TEST(RecurrentForms, ATrackWhosePartnerHasAnotherIsItsOwn) {
  BodyLayout layout;
  layout.names = {"LeftArm", "RArm", "RightArm", "LArm", "Lamp"};
  layout.parents = {-1, 0, 0, 0, 0};
  layout.with_place = false;
  EXPECT_EQ(mirror_of(layout).partners, (std::vector<std::size_t>{2, 3, 0, 1, 4}));
}

}  // namespace
}  // namespace kinemend
