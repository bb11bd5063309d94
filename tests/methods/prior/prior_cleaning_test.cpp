// Tests how the learned methods pass a take through the pipeline, with filters of known effect.
#include "methods/prior/prior_cleaning.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "kinemend/clean.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/methods.hpp"
#include "methods/prior/prior_fall_backs.hpp"
#include "registry/marker_takes.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

Take noisy_walk(double noise_deg = 0) {
  SynthOptions options;
  options.motion = "walk";
  options.duration_s = 2;
  options.frame_rate_hz = 60;
  Take clip = synthesize(options);
  if (noise_deg > 0) add_noise(clip, noise_deg, 0.2, 3);
  return clip;
}

BodyLayout layout_of(const Take& clip, std::vector<std::string> names = {}) {
  BodyLayoutBuilder builder(std::move(names));
  builder.add(clip);
  return builder.finish();
}

void keep(PriorWork&) {}
void flatten(PriorWork& work) {
  std::fill(work.channels.poses.values.begin(), work.channels.poses.values.end(), 0.0);
}

std::size_t part_called(const BodyLayout& layout, const std::string& name) {
  const auto found = std::find(layout.names.begin(), layout.names.end(), name);
  return static_cast<std::size_t>(found - layout.names.begin());
}

std::ptrdiff_t count_of(const InPlaceTrace& trace, Action action) {
  std::ptrdiff_t count = 0;
  for (const auto& actions : trace.actions)
    count += std::count(actions.begin(), actions.end(), action);
  return count;
}

// A cleaner that applies the given filter.
class Filtering final : public Cleaner {
 public:
  Filtering(BodyLayout layout, bool fill, PriorFilter filter, NameMap names = {},
            PriorHold hold = PriorHold::noise)
      : layout_(std::move(layout)),
        names_(std::move(names)),
        fill_(fill),
        hold_(hold),
        filter_(std::move(filter)) {}
  std::string_view name() const override { return "filtering"; }
  CleanTrace clean(const TakeView& take, const TrackSink& sink,
                   const std::function<void(double)>&) const override {
    return clean_with_prior(take, sink, layout_, names_, fill_, hold_, filter_);
  }

 private:
  BodyLayout layout_;
  NameMap names_;
  bool fill_;
  PriorHold hold_;
  PriorFilter filter_;
};

// Lets a filter's result differ from that of `auto` by any amount.
PriorFilter unlimited(PriorFilter filter) {
  return [filter](PriorWork& work) {
    filter(work);
    work.is_whole = true;
  };
}

TEST(PriorCleaning, BringsATakeBackThatTheFilterLeftAlone) {
  const Take before = noisy_walk(1.5);
  Take after = before;
  const InPlaceTrace trace =
      clean_in_place(Filtering(layout_of(before), true, unlimited(keep)), after);
  EXPECT_LT(max_angle_deg(before, after), 1e-6);
  for (std::size_t f = 0; f < before.frame_count(); ++f)
    EXPECT_LT(norm(before.root_position(f) - after.root_position(f)), 1e-9);
  EXPECT_EQ(count_of(trace, Action::despiked) + count_of(trace, Action::filled), 0);
}

TEST(PriorCleaning, PutsTheMeanPoseWhereTheFilterAnswersZero) {
  const Take before = noisy_walk(2);
  Take after = before;
  const BodyLayout layout = layout_of(before);
  clean_in_place(Filtering(layout, true, unlimited(flatten)), after);
  const auto arm = static_cast<std::size_t>(before.skeleton.find("LeftArm"));
  for (std::size_t f = 1; f < after.frame_count(); ++f)
    EXPECT_LT(angle_between(after.rotation(f, arm), after.rotation(0, arm)), 1e-9);
  EXPECT_GT(angle_between(before.rotation(0, arm), before.rotation(30, arm)), 0.01);
}

TEST(PriorCleaning, KeepsItsHandsOffACleanTakeToTheLastDigit) {
  const Take before = noisy_walk();
  Take after = before;
  const InPlaceTrace trace = clean_in_place(Filtering(layout_of(before), true, flatten), after);
  EXPECT_EQ(after.rotations, before.rotations);
  EXPECT_EQ(after.positions, before.positions);
  EXPECT_EQ(count_of(trace, Action::despiked) + count_of(trace, Action::filled), 0);

  const Take markers = marker_take("walk", 2, 60);
  Take kept = markers;
  clean_in_place(Filtering(layout_of(markers), true, flatten), kept);
  EXPECT_EQ(kept.positions, markers.positions);
}

TEST(PriorCleaning, GoesAsFarAsTheNoiseAsksFor) {
  const Take truth = noisy_walk();
  const auto arm = static_cast<std::size_t>(truth.skeleton.find("LeftArm"));
  double before = 0;
  for (const double noise_deg : {0.3, 0.5, 0.6, 0.7, 0.9}) {
    const Take noisy = noisy_walk(noise_deg);
    Take after = noisy;
    clean_in_place(Filtering(layout_of(truth), true, unlimited(flatten)), after);
    const double change = geodesic_rms_deg_per_joint(noisy, after)[arm];
    EXPECT_GE(change, before - 0.1) << noise_deg;
    before = change;
  }
  EXPECT_GT(before, 5);
}

TEST(PriorCleaning, AFilterOfWhiteNoiseLeavesNoiseWithAColourToAuto) {
  Take noisy = synthesize({.motion = "walk", .duration_s = 6});
  Random random(3);
  apply_damage(noisy, "ar1", {{"std_deg", 1.5}, {"correlation", 0.8}}, random);
  Take by_auto = noisy;
  clean_in_place(*make_auto(), by_auto);
  bool is_white = true, has_run = false;
  const auto note = [&](PriorWork& work) {
    flatten(work);
    is_white = work.is_white;
    has_run = true;
  };
  Take filtered = noisy;
  clean_in_place(Filtering(layout_of(noisy), true, note), filtered);
  EXPECT_FALSE(is_white);
  filtered = noisy;
  has_run = false;
  const InPlaceTrace trace =
      clean_in_place(Filtering(layout_of(noisy), true, note, {}, PriorHold::white_noise), filtered);
  EXPECT_FALSE(has_run) << "nothing is left to it";
  EXPECT_EQ(filtered.rotations, by_auto.rotations);
  ASSERT_FALSE(trace.fall_backs.empty());
  EXPECT_THAT(trace.fall_backs[0].reason, HasSubstr("takes noise for white"));

  const auto arm = static_cast<std::size_t>(noisy.skeleton.find("LeftArm"));
  noisy.observed.assign(noisy.rotations.size(), 1);
  for (std::size_t f = 100; f < 160; ++f) noisy.observed[f * noisy.joint_count() + arm] = 0;
  clean_in_place(Filtering(layout_of(noisy), true, note, {}, PriorHold::white_noise), noisy);
  EXPECT_TRUE(has_run) << "gaps are";
}

// The filling of a gap joins the samples beside it, which the filter must not change.
TEST(PriorCleaning, WhatIsFilledInACleanTakeMeetsTheSamplesBesideIt) {
  const Take truth = noisy_walk();
  const auto arm = static_cast<std::size_t>(truth.skeleton.find("LeftArm"));
  Take clip = truth;
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 40; f < 60; ++f) clip.observed[f * clip.joint_count() + arm] = 0;
  Take after = clip;
  clean_in_place(Filtering(layout_of(truth), true, flatten), after);
  double usual = 0;
  for (std::size_t f = 1; f < truth.frame_count(); ++f)
    usual = std::max(usual, angle_between(truth.rotation(f, arm), truth.rotation(f - 1, arm)));
  for (std::size_t f = 38; f < 63; ++f)
    EXPECT_LT(angle_between(after.rotation(f, arm), after.rotation(f - 1, arm)), 1.5 * usual) << f;
}

TEST(PriorCleaning, ChangesWhatIsSelectedOnly) {
  const Take before = noisy_walk(1.5);
  const auto arm = static_cast<std::size_t>(before.skeleton.find("LeftArm"));
  CleanSettings settings;
  settings.joints = {"LeftArm"};
  const Filtering cleaner(layout_of(before), true, flatten);
  const Take after = clean_take(before, cleaner, settings).take;
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    EXPECT_EQ(after.root_position(f), before.root_position(f));
    for (std::size_t j = 0; j < before.joint_count(); ++j) {
      if (j == arm) continue;
      EXPECT_EQ(after.rotation(f, j), before.rotation(f, j));
    }
  }
  EXPECT_GT(angle_between(after.rotation(0, arm), before.rotation(0, arm)), 0.01);
}

TEST(PriorCleaning, LeavesJointsThatTheModelDoesNotKnowToAuto) {
  const Take before = noisy_walk(1.5);
  const BodyLayout layout = layout_of(before, {"Hips", "*Leg", "*UpLeg"});
  Take after = before, by_auto = before;
  clean_in_place(Filtering(layout, true, unlimited(keep)), after);
  clean_in_place(*make_auto(), by_auto);
  const auto arm = static_cast<std::size_t>(before.skeleton.find("LeftArm"));
  const auto leg = static_cast<std::size_t>(before.skeleton.find("LeftLeg"));
  for (std::size_t f = 0; f < before.frame_count(); ++f) {
    EXPECT_EQ(after.rotation(f, arm), by_auto.rotation(f, arm));
    EXPECT_LT(angle_between(after.rotation(f, leg), before.rotation(f, leg)), 1e-8);
  }
}

TEST(PriorCleaning, TellsTheFilterWhatIsMissingWhatIsSuspectAndHowLoudTheNoiseIs) {
  Take clip = noisy_walk(2);
  const auto arm = static_cast<std::size_t>(clip.skeleton.find("LeftArm"));
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 20; f < 30; ++f) clip.observed[f * clip.joint_count() + arm] = 0;
  clip.rotation(60, arm) = clip.rotation(60, arm) * exp({0, 0.9, 0});
  const BodyLayout layout = layout_of(noisy_walk());
  const std::size_t part = part_called(layout, "LeftArm");
  const PriorFilter filter = [&](PriorWork& work) {
    const std::size_t channels = work.channels.poses.channels;
    ASSERT_EQ(channels, layout.channel_count());
    for (std::size_t f = 0; f < work.channels.poses.frames; ++f)
      EXPECT_EQ(work.channels.observed[f * channels + 3 * part] == 0, f >= 20 && f < 30) << f;
    EXPECT_EQ(work.suspect[60 * channels + 3 * part], 1);
    EXPECT_NEAR(work.noise[3 * part], 2, 0.4);
    EXPECT_EQ(work.fallback.frames, work.channels.poses.frames);
  };
  clean_in_place(Filtering(layout, true, filter), clip);
}

TEST(PriorCleaning, FillsGapsOfJointsOrBridgesThem) {
  Take clip = noisy_walk();
  const auto arm = static_cast<std::size_t>(clip.skeleton.find("LeftArm"));
  const Take truth = clip;
  const BodyLayout layout = layout_of(truth);
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 20; f < 40; ++f) {
    clip.observed[f * clip.joint_count() + arm] = 0;
    clip.rotation(f, arm) = exp({1, 2, 0});
  }
  // This filter knows the ground truth.
  const PriorFilter oracle = [&](PriorWork& work) {
    work.channels.poses =
        encode_body(truth, layout, match_body(layout, truth), work.channels).poses;
  };
  Take filled = clip, bridged = clip;
  const InPlaceTrace trace = clean_in_place(Filtering(layout, true, oracle), filled);
  EXPECT_LT(max_angle_deg(filled, truth), 1e-6);
  EXPECT_EQ(trace.actions[arm][25], Action::filled);
  clean_in_place(Filtering(layout, false, oracle), bridged);
  EXPECT_GT(angle_between(bridged.rotation(30, arm), truth.rotation(30, arm)), 0.001);
  EXPECT_LT(angle_between(bridged.rotation(30, arm), truth.rotation(30, arm)), 0.3);
}

TEST(PriorCleaning, LeavesJointsThatFlipToAutoButNotThoseThatAreMissing) {
  const Take truth = noisy_walk();
  const BodyLayout layout = layout_of(truth);
  Take clip = truth;
  const auto left = static_cast<std::size_t>(clip.skeleton.find("LeftHand"));
  const auto right = static_cast<std::size_t>(clip.skeleton.find("RightHand"));
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const bool flipped = f / 30 % 2 == 1;
    if (flipped) clip.rotation(f, left) = clip.rotation(f, left) * exp({0, 0, 3.0});
    clip.observed[f * clip.joint_count() + right] = 0;
    clip.rotation(f, right) = exp({3, 0, 0});
  }
  Take after = clip, by_auto = clip;
  clean_in_place(*make_auto(), by_auto);
  clean_in_place(Filtering(layout, true, flatten), after);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    EXPECT_EQ(after.rotation(f, left), by_auto.rotation(f, left));
    EXPECT_LT(angle_between(after.rotation(f, right), after.rotation(0, right)), 1e-9);
    EXPECT_GT(angle_between(after.rotation(f, right), clip.rotation(f, right)), 1);
  }
}

TEST(PriorCleaning, ReportsRejectedMeasurementsAsSpikes) {
  Take clip = noisy_walk(1);
  const BodyLayout layout = layout_of(clip);
  const std::size_t part = part_called(layout, "RightArm");
  const auto joint = static_cast<std::size_t>(clip.skeleton.find("RightArm"));
  const PriorFilter rejecting = [&](PriorWork& work) {
    work.rejected.assign(work.channels.poses.values.size(), 0);
    work.rejected[7 * work.channels.poses.channels + 3 * part + 1] = 1;
    work.warnings.push_back("a word of the filter");
  };
  const InPlaceTrace trace = clean_in_place(Filtering(layout, true, rejecting), clip);
  EXPECT_EQ(trace.actions[joint][7], Action::despiked);
  EXPECT_EQ(count_of(trace, Action::despiked), 1);
  EXPECT_THAT(trace.warnings, testing::Contains("a word of the filter"));
}

TEST(PriorCleaning, NamesWhatTheTakeLacks) {
  Take clip = noisy_walk();
  const BodyLayout layout = layout_of(clip);
  const auto hand = static_cast<std::size_t>(clip.skeleton.find("LeftHand"));
  clip.skeleton.names[hand] = "Gripper";
  const InPlaceTrace trace =
      clean_in_place(Filtering(layout, true, keep, {{"LeftHand", ""}}), clip);
  ASSERT_FALSE(trace.warnings.empty());
  EXPECT_THAT(trace.warnings[0], HasSubstr("LeftHand"));

  Take other = moving_take(30, 60);
  try {
    clean_in_place(Filtering(layout, true, keep), other);
    FAIL() << "a body that the model does not know";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_THAT(error.what(), HasSubstr("RightUpLeg"));
  }
}

TEST(PriorCleaning, TakesAnyNumberOfFrames) {
  const BodyLayout layout = layout_of(noisy_walk());
  for (const std::size_t frames : {0, 1, 2, 3, 5}) {
    Take clip = slice(noisy_walk(1), 0, frames);
    clean_in_place(Filtering(layout, true, keep), clip);
    EXPECT_EQ(clip.frame_count(), frames);
  }
}

TEST(PriorCleaning, FillsMarkersThatAreNeverSeen) {
  const Take truth = marker_take("walk", 2, 60);
  const BodyLayout layout = layout_of(truth);
  Take clip = truth;
  const auto marker = static_cast<std::size_t>(clip.find("LeftHand1"));
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    clip.observed[f * clip.marker_count() + marker] = 0;
    clip.position(f, marker) = {};
  }
  const PriorFilter oracle = [&](PriorWork& work) {
    work.channels.poses =
        encode_body(truth, layout, match_body(layout, truth), work.channels).poses;
  };
  const Filtering filling(layout, true, oracle), leaving(layout, false, oracle);
  const CleanResult filled = clean_take(clip, filling);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    ASSERT_TRUE(filled.take.is_observed(f, marker));
    EXPECT_LT(norm(filled.take.position(f, marker) - truth.position(f, marker)), 1e-6);
  }
  EXPECT_EQ(filled.report.tracks[marker].frames_missing, 0u);
  EXPECT_FALSE(clean_take(clip, leaving).take.is_observed(5, marker));
}

TEST(PriorCleaning, FillsNoMarkerOutsideTheRangeOrTheSelection) {
  const Take truth = marker_take("walk", 2, 60);
  Take clip = truth;
  const auto marker = static_cast<std::size_t>(clip.find("LeftHand1"));
  const auto other = static_cast<std::size_t>(clip.find("RightHand1"));
  for (std::size_t f = 10; f < 60; ++f) {
    clip.observed[f * clip.marker_count() + marker] = 0;
    clip.observed[f * clip.marker_count() + other] = 0;
  }
  CleanSettings settings;
  settings.range = {30, 119};
  settings.exclude = {"RightHand1"};
  const Filtering cleaner(layout_of(truth), true, keep);
  const Take after = clean_take(clip, cleaner, settings).take;
  for (std::size_t f = 0; f < 60; ++f) {
    EXPECT_EQ(after.is_observed(f, marker), f < 10 || f >= 30) << f;
    EXPECT_EQ(after.is_observed(f, other), f < 10) << f;
  }
}

TEST(PriorCleaning, ReadsNamesFromAFileOrSaysThatItCannot) {
  EXPECT_TRUE(name_map_at("").empty());
  const auto path = std::filesystem::path(testing::TempDir()) / "prior_cleaning_names.txt";
  std::ofstream(path) << "LeftArm,l_upper\n";
  EXPECT_EQ(name_map_at(path.string()).at("LeftArm"), "l_upper");
  EXPECT_THROW(name_map_at(path.string() + ".none"), Error);
  EXPECT_THROW(name_map_at(testing::TempDir()), Error);
}

}  // namespace
}  // namespace kinemend::test
