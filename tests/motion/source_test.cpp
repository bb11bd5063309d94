// Tests of the names of sources, and of the source that a program's name implies.
#include "kinemend/take.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinemend/error.hpp"

namespace kinemend::test {
namespace {

Take written_by(const std::string& software) {
  Take take;
  take.source.facts = {{"subjects", "Xsens"}, {"software", software}};
  return take;
}

TEST(Source, EveryNameIsThatOfItsSource) {
  ASSERT_EQ(source_names().size(), 6U);
  for (const std::string& name : source_names()) EXPECT_EQ(to_string(parse_source(name)), name);
}

TEST(Source, AWrongNameIsAUsageErrorThatNamesTheNearest) {
  try {
    parse_source("vidoe");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(std::string(error.what()),
              "unknown source \"vidoe\"; did you mean video? (there are optical, suit, video, "
              "depth, keyframed, unknown)");
  }
}

TEST(Source, SlowNoiseIsLikelyOfVideoDepthCamerasAndSuits) {
  for (const Source source : {Source::video, Source::depth, Source::suit})
    EXPECT_TRUE(expects_slow_noise(source)) << to_string(source);
  for (const Source source : {Source::unknown, Source::optical, Source::keyframed})
    EXPECT_FALSE(expects_slow_noise(source)) << to_string(source);
}

TEST(Source, IsReadFromTheProgramThatRecorded) {
  for (const auto& [software, source] : std::vector<std::pair<std::string, Source>>{
           {"Vicon, Vicon Nexus 2.12.1", Source::optical},
           {"Vicon Motion Systems Limited, Vicon Workstation", Source::optical},
           {"QUALISYS, Qualisys Track Manager 2.17", Source::optical},
           {"NaturalPoint, Motive 3.0", Source::optical},
           {"Motion Analysis, EvaRT", Source::optical},
           {"Theia Markerless Inc., Theia3D 2023", Source::video},
           {"OpenCap", Source::video},
           {"Xsens, MVN Animate 2021.0", Source::suit},
           {"Noitom, Axis Studio", Source::suit},
           {"Rokoko Studio", Source::suit},
           {"Motion Workshop, Shadow 4.1.1", Source::suit},
           {"Kinect for Windows SDK", Source::depth}}) {
    const TakeSource read = source_of(written_by(software));
    EXPECT_EQ(read.source, source) << software;
    EXPECT_EQ(read.reason, "read from the file, software: " + software);
  }
}

TEST(Source, IsNotReadFromEditorsPartsOfWordsAndContradictions) {
  for (const char* software :
       {"Blender (stable FBX IO)", "Khronos glTF Blender I/O v3.3.36", "Autodesk, MotionBuilder",
        "Maya", "Kinemend 0.1.0", "viconic", "Amvn 2", "Vicon, with Theia3D", ""}) {
    EXPECT_EQ(source_of(written_by(software)), TakeSource()) << software;
  }
  EXPECT_EQ(source_of(Take()).reason, "not known");
}

TEST(Source, WhatIsGivenWinsOverTheFile) {
  const TakeSource given = source_of(written_by("Vicon Nexus"), Source::video);
  EXPECT_EQ(given.source, Source::video);
  EXPECT_EQ(given.reason, "given");
  EXPECT_EQ(source_of(written_by("Vicon Nexus"), Source::unknown).source, Source::optical);
}

}  // namespace
}  // namespace kinemend::test
