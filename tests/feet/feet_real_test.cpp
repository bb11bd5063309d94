// Tests of feet on real takes: CMU walks, and skeletons of other dialects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "kinemend/feet.hpp"
#include "kinemend/io.hpp"

namespace kinemend {
namespace {

Take real_clip(const std::string& path) {
  return read_take(std::filesystem::path(std::string(KINEMEND_DATA_FOLDER) + "/" + path)).take;
}

std::size_t count_held(const FeetReport& report) {
  return static_cast<std::size_t>(std::count(report.held.begin(), report.held.end(), 1));
}

double centimetres(const FeetReport& report) { return 100 * report.metres_per_unit; }

class CmuWalks : public testing::TestWithParam<std::string> {};

TEST_P(CmuWalks, AreHardlyTouchedByItself) {
  const Take clip = real_clip("cmu/" + GetParam());
  Take cleaned = clip;
  const FeetReport report = clean_feet(cleaned);
  EXPECT_GE(report.contacts.size(), 8u);
  std::size_t frames = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto first = report.changed.begin() + static_cast<std::ptrdiff_t>(f * clip.joint_count());
    frames += std::any_of(first, first + static_cast<std::ptrdiff_t>(clip.joint_count()),
                          [](std::uint8_t c) { return c != 0; });
  }
  EXPECT_LT(frames, clip.frame_count() * 6 / 10);
  EXPECT_LT(report.after.knee_pop_deg, 1.1 * report.before.knee_pop_deg + 0.4);
}

TEST_P(CmuWalks, StandWhereTheyShallByForce) {
  Take clip = real_clip("cmu/" + GetParam());
  const FeetReport before = clean_feet(clip, [] {
    FeetSettings settings;
    settings.mode = FeetMode::force;
    return settings;
  }());
  const double cm = centimetres(before);
  EXPECT_EQ(count_held(before), before.contacts.size());
  EXPECT_GT(before.before.most_slide * cm, 1);
  // Ankles of two channels cannot hold heel and toe at once to the last millimetre; neither can a
  // nearly straight leg without popping its knee (3 mm in 08_01).
  EXPECT_LT(before.after.most_slide * cm, 0.35);
  EXPECT_LT(before.after.slide * cm, 0.01);
  EXPECT_LT(before.after.knee_pop_deg, 1.1 * before.before.knee_pop_deg + 0.4);
}

INSTANTIATE_TEST_SUITE_P(Takes, CmuWalks,
                         testing::Values("bvh/02_01.bvh", "bvh/07_01.bvh", "bvh/08_01.bvh",
                                         "bvh/16_15.bvh", "bvh/35_01.bvh", "bvh/49_01.bvh",
                                         "amc/35/35_01.amc"),
                         [](const auto& take) {
                           std::string name = take.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

TEST(FeetOfRealTakes, SlideOnASkeletonThatIsNotTheirsUntilTheyAreHeld) {
  // Rotations and path come from one subject, the bones from another.
  for (const char* name : {"38_03", "46_01", "105_39"}) {
    const Take sliding = real_clip(std::string("cmu/bvh-rotations/") + name + ".bvh");
    Take clip = sliding;
    const FeetReport report = clean_feet(clip);
    const double cm = centimetres(report);
    EXPECT_GT(report.before.most_slide * cm, 3) << name;
    EXPECT_GT(count_held(report), 0u) << name;
    EXPECT_LT(report.after.slide, report.before.slide) << name;
    // 38_03 jitters, so standing is measured over the held contacts only.
    FeetSettings listed;
    listed.contacts.emplace();
    for (std::size_t i = 0; i < report.contacts.size(); ++i) {
      if (report.held[i] != 0) listed.contacts->push_back(report.contacts[i]);
    }
    clip = sliding;
    clean_feet(clip, listed);
    for (const FootContact& contact : *listed.contacts)
      EXPECT_LT(feet_figures(clip, {contact}).most_slide * cm, 0.6) << name;
  }
}

TEST(FeetOfRealTakes, AreHeldOnJointsOfEveryDialect) {
  for (const char* path :
       {"bvh-other/bandai-namco/dataset-1_walk_normal_001.bvh",
        "bvh-other/PyMO/AV_8Walk_Meredith_HVHA_Rep1.bvh", "bvh-other/GPmat/Swagger.bvh",
        "bvh-other/deep-motion-editing/style_transfer_demo_results_comp_3d_2_raw.bvh",
        "paired/S02-Trial-Walk-1-xsens.bvh"}) {
    Take clip = real_clip(path);
    FeetSettings settings;
    settings.mode = FeetMode::force;
    const FeetReport report = clean_feet(clip, settings);
    EXPECT_THAT(report.sides, testing::UnorderedElementsAre("left", "right")) << path;
    EXPECT_GT(report.contacts.size(), 2u) << path;
    EXPECT_LT(report.after.slide, 0.1 * report.before.slide) << path;
    EXPECT_NO_THROW(clip.validate()) << path;
  }
}

}  // namespace
}  // namespace kinemend
