// Tests of feet as the last step of the pipeline, after every method.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"

namespace kinemend::test {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// A cleaner that changes nothing.
class Idle final : public Cleaner {
 public:
  std::string_view name() const override { return "idle"; }
  CleanTrace clean(const TakeView&, const TrackSink&,
                   const std::function<void(double)>&) const override {
    return {};
  }
};

Take sliding_walk(bool t_pose_first = false) {
  Take clip = synthesize({"walk", 5, 120, 1, t_pose_first});
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    clip.root_position(f).x += 5 * std::sin(0.02 * static_cast<double>(f));
  return clip;
}

CleanSettings with_feet(FeetMode mode = FeetMode::force) {
  CleanSettings settings;
  settings.feet.emplace();
  settings.feet->mode = mode;
  return settings;
}

TEST(FeetStep, HoldsFeetAndSaysWhere) {
  const Take clip = sliding_walk();
  const CleanResult result = clean_take(clip, Idle(), with_feet());
  ASSERT_TRUE(result.report.feet);
  const FeetReport& feet = *result.report.feet;
  EXPECT_GT(feet.before.most_slide, 2);
  EXPECT_LT(feet.after.most_slide, 0.05);
  EXPECT_NEAR(feet_figures(result.take, feet.contacts).most_slide, feet.after.most_slide, 0.3);
  std::size_t adjusted = 0;
  for (const ReportSpan& span : result.report.spans) {
    EXPECT_EQ(span.action, Action::foot_adjusted);
    adjusted += span.last_frame - span.first_frame + 1;
  }
  EXPECT_GT(adjusted, clip.frame_count());
  const auto head = static_cast<std::size_t>(clip.skeleton.find("Head"));
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    EXPECT_EQ(result.take.rotation(f, head), clip.rotation(f, head));
}

TEST(FeetStep, IsNotTakenUnasked) {
  const Take clip = sliding_walk();
  const CleanResult plain = clean_take(clip, Idle());
  EXPECT_FALSE(plain.report.feet);
  EXPECT_EQ(plain.take.rotations, clip.rotations);
  const CleanResult off = clean_take(clip, Idle(), with_feet(FeetMode::off));
  EXPECT_EQ(off.take.rotations, clip.rotations);
}

// Learned methods use models of synthetic walks, and the noise that they are trained for.
class FeetAfter : public testing::TestWithParam<std::string> {};

std::unique_ptr<Cleaner> made(const Method& method) {
  const bool has_network = method.name == "recurrent" || method.name == "learned";
  if (!method.learned || has_network) return make_cleaner(method.name);
  const auto model = std::make_shared<const Model>(
      train_model(method.name, {2, [](std::size_t i) {
                                  return Take(synthesize({"walk", 3, 60, i + 2}));
                                }}));
  return method.name == "example"  ? make_example({}, model)
         : method.name == "wiener" ? make_wiener({}, model)
         : method.name == "sparse" ? make_sparse({}, model)
                                   : make_kalman_learned({}, model);
}

TEST_P(FeetAfter, AreHeldAndTheRestIsTheMethods) {
  const Method& method = find_method(GetParam());
  Take clip = sliding_walk();
  if (method.learned) {
    clip = resample(clip, 60);
    Random random(3);
    apply_damage(clip, "gaussian", {{"std_deg", 1.5}}, random);
  }
  const std::unique_ptr<Cleaner> cleaner = made(method);
  CleanSettings settings = with_feet();
  settings.feet->contacts = find_contacts(sliding_walk());
  if (method.learned) {
    for (FootContact& contact : *settings.feet->contacts)
      contact.first_frame /= 2, contact.last_frame /= 2;
  }
  const CleanResult plain = clean_take(clip, *cleaner), held = clean_take(clip, *cleaner, settings);
  ASSERT_TRUE(held.report.feet);
  EXPECT_GT(held.report.feet->contacts.size(), 4u);
  EXPECT_GT(held.report.feet->before.most_slide, 1);
  EXPECT_LT(held.report.feet->after.most_slide, 0.05);
  if (method.learned) {
    EXPECT_NE(plain.take.rotations, clip.rotations);
  }
  for (const char* name : {"Head", "LeftArm", "RightForeArm", "Spine"}) {
    const auto j = static_cast<std::size_t>(clip.skeleton.find(name));
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      ASSERT_EQ(held.take.rotation(f, j), plain.take.rotation(f, j)) << name << ", frame " << f;
  }
}

std::vector<std::string> names_of_methods() {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
#if defined(KINEMEND_SANITIZED)
    if (method.learned) continue;  // training takes long in instrumented code
#endif
    names.push_back(method.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(EveryMethod, FeetAfter, testing::ValuesIn(names_of_methods()),
                         [](const auto& method) {
                           std::string name = method.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(FeetStep, LeavesLegsThatAreNotSelectedAndTheOthersToo) {
  const Take clip = sliding_walk();
  CleanSettings settings = with_feet();
  settings.exclude = {"LeftLeg"};
  const CleanResult result = clean_take(clip, Idle(), settings);
  const FeetReport& feet = *result.report.feet;
  for (std::size_t i = 0; i < feet.contacts.size(); ++i) {
    EXPECT_EQ(feet.held[i], feet.contacts[i].leg == 1);
    if (feet.held[i] != 0) continue;
    EXPECT_THAT(feet.reasons[i], HasSubstr("may not all turn"));
  }
  for (const char* name : {"LeftUpLeg", "LeftLeg", "LeftFoot"}) {
    const auto j = static_cast<std::size_t>(clip.skeleton.find(name));
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      EXPECT_EQ(result.take.rotation(f, j), clip.rotation(f, j));
  }
  EXPECT_EQ(result.take.positions, clip.positions);
}

TEST(FeetStep, LeavesTheRootWhereItMayNotMove) {
  const Take clip = sliding_walk();
  CleanSettings settings = with_feet();
  settings.root_position = false;
  const CleanResult result = clean_take(clip, Idle(), settings);
  EXPECT_EQ(result.take.positions, clip.positions);
  EXPECT_LT(result.report.feet->after.slide, 0.5 * result.report.feet->before.slide);
}

TEST(FeetStep, StaysWithinTheRangeAndGoesAsFarAsTheStrength) {
  const Take clip = sliding_walk(true);
  CleanSettings settings = with_feet();
  settings.range = {200, 399};
  const CleanResult part = clean_take(clip, Idle(), settings);
  std::size_t changed = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      const bool same = part.take.rotation(f, j) == clip.rotation(f, j);
      EXPECT_TRUE(same || (f >= 200 && f <= 399)) << "frame " << f;
      changed += same ? 0 : 1;
    }
  }
  EXPECT_GT(changed, 200u);
  settings = with_feet();
  settings.strength = 0.5;
  const CleanResult half = clean_take(clip, Idle(), settings);
  const FeetReport& feet = *half.report.feet;
  EXPECT_GT(feet.after.slide, 0.3 * feet.before.slide);
  EXPECT_LT(feet.after.slide, 0.7 * feet.before.slide);
  EXPECT_EQ(half.take.rotation(0, 2), clip.rotation(0, 2));
}

// The report of a leg does not depend on whether feet are held, except for the distance moved.
TEST(FeetStep, LeavesTheReportOfTheLegsTrue) {
  const Take clip = sliding_walk();
  const auto strong = make_butterworth({.cutoff_hz = 1});
  const CleanResult plain = clean_take(clip, *strong),
                    held = clean_take(clip, *strong, with_feet());
  for (const char* name : {"LeftUpLeg", "LeftLeg", "LeftFoot", "RightUpLeg", "RightLeg"}) {
    const auto j = static_cast<std::size_t>(clip.skeleton.find(name));
    const TrackSummary &without = plain.report.tracks[j], &with = held.report.tracks[j];
    EXPECT_EQ(with.frames_repaired, 0u) << name;
    EXPECT_EQ(with.peak_speed_before, without.peak_speed_before) << name;
    EXPECT_GT(with.peak_speed_after, 0.3 * without.peak_speed_after) << name;
    EXPECT_LT(without.peak_speed_after, 0.9 * without.peak_speed_before) << name;
  }
  const auto foot = static_cast<std::size_t>(clip.skeleton.find("LeftFoot"));
  EXPECT_LT(held.report.tracks[foot].peak_speed_after,
            0.9 * held.report.tracks[foot].peak_speed_before);
}

TEST(FeetStep, CountsContactsByTheTakesFrames) {
  const Take clip = sliding_walk(true);
  CleanSettings settings = with_feet();
  const std::vector<FootContact> found = find_contacts(clip);
  settings.feet->contacts = found;
  const CleanResult result = clean_take(clip, Idle(), settings);
  EXPECT_EQ(result.report.feet->contacts, found);
  EXPECT_LT(result.report.feet->after.most_slide, 0.05);
  settings.feet->contacts = {{{0, FootPart::heel, 0, 5}}};  // the T-pose
  EXPECT_THROW(clean_take(clip, Idle(), settings), Error);
}

TEST(FeetStep, KeepsMarkersWhereTheyWereMeasured) {
  Take markers = make_marker_take({"LTOE", "LHEE"}, 60, 100);
  markers.observed.assign(markers.positions.size(), 1);
  const CleanResult result = clean_take(markers, *make_cleaner("gaussian"), with_feet());
  EXPECT_THAT(result.report.warnings, Contains(HasSubstr("markers are measured points")));
}

}  // namespace
}  // namespace kinemend::test
