// Tests of joint gaps filled by a network of the paper, with `fill_gaps` and in the cleaner.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "papers/mall2017_recurrent/filter_support.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

constexpr std::size_t first = 60, last = 119;

Take walk_to_fill(double rate_hz = 120) {
  return synthesize({.motion = "walk", .duration_s = 2, .frame_rate_hz = rate_hz});
}

Take gapped(Take clip, const std::vector<std::string>& names) {
  std::vector<NamedGap> gaps;
  for (const std::string& name : names) gaps.push_back({name, first, last});
  mark_gaps(clip, gaps);
  return clip;
}

// A network that adds `degrees` to each channel in the middle of a gap.
std::shared_ptr<const Model> adding(const Take& clip, double degrees,
                                    std::vector<std::string> names = {}) {
  BodyLayoutBuilder builder(std::move(names));
  builder.add(clip);
  return std::make_shared<const Model>(
      constant_filter_model(builder.finish(), FilterHead::residual, degrees, {false, true}));
}

FillReport filled(Take& clip, std::shared_ptr<const Model> model) {
  FillSettings settings;
  settings.method = "recurrent";
  settings.models.recurrent = make_recurrent_fill({}, std::move(model));
  return fill_gaps(clip, settings);
}

std::size_t joint_of(const Take& clip, const char* name) {
  return static_cast<std::size_t>(clip.skeleton.find(name));
}

TEST(RecurrentFill, IsTheStraightLineAndWhatTheNetworkAddsToIt) {
  const Take truth = walk_to_fill();
  const std::size_t knee = joint_of(truth, "LeftLeg");
  Take straight = gapped(truth, {"LeftLeg"}), bent = straight;
  const FillReport report = filled(straight, adding(truth, 0));
  ASSERT_THAT(report.gaps, SizeIs(1));
  EXPECT_EQ(report.gaps[0].method, "recurrent");
  filled(bent, adding(truth, 5));
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    if (f >= first && f <= last) continue;
    EXPECT_EQ(bent.rotation(f, knee), truth.rotation(f, knee)) << f;
  }
  const auto apart_deg = [&](std::size_t f) {
    return degrees_per_radian * angle_between(straight.rotation(f, knee), bent.rotation(f, knee));
  };
  EXPECT_NEAR(apart_deg((first + last) / 2), 5 * std::sqrt(3), 2);
  EXPECT_NEAR(apart_deg(first), 0, 0.1);
  EXPECT_NEAR(apart_deg(last), 0, 0.1);
}

TEST(RecurrentFill, LeavesTheRootAndUnknownJointsToAutoAndSaysSo) {
  const Take truth = walk_to_fill();
  Take clip = gapped(truth, {"LeftLeg", "Hips", "Head"});
  std::vector<std::string> known = truth.skeleton.names;
  std::erase(known, "Head");
  Take automatic = clip;
  const FillReport report = filled(clip, adding(truth, 5, known));
  fill_gaps(automatic);
  EXPECT_THAT(report.warnings, testing::Contains(HasSubstr("(Head): the model does not know")));
  EXPECT_THAT(report.warnings,
              testing::Contains(HasSubstr("(Hips): the network sees how the root")));
  for (const char* name : {"Hips", "Head"}) {
    const std::size_t joint = joint_of(truth, name);
    for (std::size_t f = first; f <= last; ++f)
      EXPECT_EQ(clip.rotation(f, joint), automatic.rotation(f, joint)) << name << " " << f;
  }
  const std::size_t knee = joint_of(truth, "LeftLeg");
  EXPECT_GT(angle_between(clip.rotation(90, knee), automatic.rotation(90, knee)), 0.01);
}

TEST(RecurrentFill, LeavesATakeAtAnotherRateToAuto) {
  const Take truth = walk_to_fill(60);
  Take clip = gapped(truth, {"LeftLeg"}), automatic = clip;
  const FillReport report = filled(clip, adding(truth, 5));
  fill_gaps(automatic);
  EXPECT_EQ(clip.rotations, automatic.rotations);
  EXPECT_THAT(report.warnings,
              ElementsAre(HasSubstr("the network fills takes of 120 Hz, and this one has 60")));
}

TEST(RecurrentFill, RefusesAModelThatFillsNoGaps) {
  const Take clip = walk_to_fill();
  EXPECT_THROW(make_recurrent_fill({}), Error);  // the shipped model
  BodyLayoutBuilder builder;
  builder.add(clip);
  EXPECT_THROW(make_recurrent_fill({}, std::make_shared<const Model>(constant_filter_model(
                                           builder.finish(), FilterHead::gaussian, 0))),
               Error);
}

// The paper's pair of networks: EBD, then EBF.
class RecurrentPair : public testing::Test {
 protected:
  std::shared_ptr<const Model> filter(double width_frames = 1) const {
    BodyLayoutBuilder builder;
    builder.add(truth_);
    return std::make_shared<const Model>(
        constant_filter_model(builder.finish(), FilterHead::gaussian, std::log(width_frames)));
  }
  Take noisy() const {
    Take clip = truth_;
    Random random(3);
    apply_damage(clip, "gaussian", {{"std_deg", 3.0}}, random);
    return gapped(clip, {"LeftLeg"});
  }
  const Take truth_ = walk_to_fill();
};

TEST_F(RecurrentPair, FillsTheGapsThatTheFilterSees) {
  const Take damaged = noisy();
  const Take alone = clean_take(damaged, *make_recurrent({}, filter())).take;
  const Take pair = clean_take(damaged, *make_recurrent({}, filter(), adding(truth_, 10))).take;
  const std::size_t knee = joint_of(truth_, "LeftLeg");
  EXPECT_NEAR(degrees_per_radian * angle_between(alone.rotation(90, knee), pair.rotation(90, knee)),
              10 * std::sqrt(3), 4);
  for (std::size_t f = 0; f < truth_.frame_count(); ++f) {
    if (f + 20 >= first && f <= last + 20) continue;
    EXPECT_LT(angle_between(alone.rotation(f, knee), pair.rotation(f, knee)), 1e-6) << f;
  }
}

TEST_F(RecurrentPair, RefusesModelsThatDoNotGoTogether) {
  EXPECT_THROW(make_recurrent({}, filter(), filter()), Error);          // cannot fill
  EXPECT_THROW(make_recurrent({}, nullptr, adding(truth_, 0)), Error);  // another body
  EXPECT_THROW(make_recurrent({}, adding(truth_, 0)), Error);           // cannot filter
  EXPECT_THROW(make_recurrent({.live = true}, filter(), adding(truth_, 0)), Error);
  EXPECT_THROW(make_recurrent({}, filter(), adding(truth_, 0, {"Hips", "LeftUpLeg", "LeftLeg"})),
               Error);
}

}  // namespace
}  // namespace kinemend::test
