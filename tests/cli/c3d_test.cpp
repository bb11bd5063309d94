// Tests of C3D files on the command line: kept data, reported losses, and repairs.
#include "cli/c3d_law.hpp"
#include "long_tests.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using C3dFiles = C3dLaw;

TEST_F(C3dFiles, KeepWhatAnOptionDoesNotConcernOrNameIt) {
  KINEMEND_LONG_WHEN_SANITIZED();
  for (const char* const name : {"laboratory", "laboratory_integer", "plates_only", "analog_only",
                                 "rotation_section", "origin"})
    expect_lawful_in_every_option(c3d_fixture(name));
}

TEST_F(C3dFiles, AreTheSameInTheirOwnUnitRateAndAxes) {
  const std::string take = c3d_fixture("laboratory"), bytes = contents(folder / take);
  const std::vector<std::vector<std::string>> options{
      {}, {"--unit", "mm"}, {"--fps", "50"}, {"--up", "z", "--from-up", "z"}};
  for (const auto& option : options) {
    std::vector<std::string> words{"convert", take, "-o", "same.c3d", "--force", "--strict"};
    words.insert(words.end(), option.begin(), option.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.err, "");
    EXPECT_EQ(contents(folder / "same.c3d"), bytes);
  }
}

TEST_F(C3dFiles, StayWholeWhenTheyArePutOnTheFloor) {
  const std::string take = c3d_fixture("laboratory");
  const Ran ran =
      run({"convert", take, "--up", "z", "--floor-at-zero", "-o", "floor.c3d", "--strict"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, AllOf(HasSubstr("the feet stand at 0"), Not(HasSubstr("left out"))));
  EXPECT_EQ(info("floor.c3d").at("facts"), info(take).at("facts"));
}

TEST_F(C3dFiles, ARateThatAnalogChannelsCannotFollowIsNamed) {
  const std::string take = c3d_fixture("laboratory");
  const Ran ran = run({"convert", take, "--fps", "60", "-o", "out.c3d"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("laboratory.c3d: 3 analog channels at 200 Hz are left out: their "
                                 "rate is not a multiple of 60 Hz"));
  EXPECT_THAT(ran.err, HasSubstr("2 force plates are left out with the analog channels"));
  const Ran strict = run({"convert", take, "--fps", "60", "-o", "strict.c3d", "--strict"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, IsOneLine());
  EXPECT_FALSE(fs::exists(folder / "strict.c3d"));
}

TEST_F(C3dFiles, WhatAnotherFormatCannotHoldIsNamed) {
  const std::string take = c3d_fixture("laboratory");
  const std::vector<std::vector<std::string>> commands{
      {"convert", take}, {"clean", take, "--quiet"}, {"fill", take}};
  for (std::vector<std::string> words : commands) {
    SCOPED_TRACE(words[0]);
    words.insert(words.end(), {"-o", words[0] + ".trc"});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, AllOf(HasSubstr("trc files cannot hold 3 analog channels at 200 Hz; 2 "
                                         "force plates; the parameters of SUBJECTS"),
                               HasSubstr("2 events"), IsOneLine()));
    words.insert(words.end(), {"--force", "--strict"});
    EXPECT_EQ(run(words).code, 1);
  }
}

TEST_F(C3dFiles, WithoutPointsAreToldAsSuch) {
  const std::string take = c3d_fixture("plates_only"), bytes = contents(folder / take);
  const std::string what = "36 analog frames, no points";
  EXPECT_THAT(run({"info", take}).out, AllOf(HasSubstr(what), Not(HasSubstr("0 frames"))));
  EXPECT_THAT(run({"check", take}).out, HasSubstr(what + ": nothing to check"));
  const Ran cleaned = run({"clean", take, "-o", "clean.c3d"});
  EXPECT_THAT(cleaned.out, AllOf(HasSubstr(what + ": nothing to clean; written to"),
                                 Not(HasSubstr("0 frames"))));
  EXPECT_EQ(contents(folder / "clean.c3d"), bytes);
  EXPECT_THAT(run({"fill", take, "-o", "fill.c3d"}).out, HasSubstr(what + ": nothing to fill"));
  EXPECT_EQ(contents(folder / "fill.c3d"), bytes);
  EXPECT_THAT(run({"convert", take, "--fps", "25", "-o", "fps.c3d"}).err, HasSubstr(what));
  EXPECT_EQ(contents(folder / "fps.c3d"), bytes);
  const Ran plain = run({"convert", take, "--plain", "-o", "plain.c3d"});
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_THAT(run({"info", "plain.c3d"}).out, HasSubstr(what));
  const Ran table = run({"convert", take, "-o", "out.trc"});
  EXPECT_EQ(table.code, 2);
  EXPECT_THAT(table.err, AllOf(HasSubstr("plates_only.c3d: " + what), IsOneLine()));
}

// Places in a C3D file are byte offsets; places in text files are line numbers.
TEST_F(C3dFiles, NameTheByteOfWhatWasRepaired) {
  const std::string take = c3d_fixture("header_scale");
  const std::string place = "header_scale.c3d: byte 12: the scale of the header is 0.5";
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"clean", take, "-o", "a.c3d"},
        {"fill", take, "-o", "b.c3d"},
        {"convert", take, "c.c3d"}}) {
    EXPECT_THAT(run(words).err, HasSubstr(place)) << words[0];
  }
  for (const char* const command : {"info", "check"}) {
    EXPECT_THAT(run({command, take}).out,
                AllOf(HasSubstr(" byte 12: the scale of the header"), Not(HasSubstr("line"))))
        << command;
    const Json json = Json::parse(run({command, take, "--json"}).out);
    const Json& repair = json["takes"][0]["diagnostics"][0];
    EXPECT_EQ(repair["first_byte"], 12);
    EXPECT_FALSE(repair.contains("first_line"));
  }
  EXPECT_THAT(run({"clean", take, "--strict", "-o", "d.c3d"}).err, HasSubstr(": byte 12: "));
  put(folder / "cut.bvh",
      std::string(hand_take())
          .replace(std::string(hand_take()).find("Frames: 10"), 10, "Frames: 12"));
  EXPECT_THAT(run({"info", "cut.bvh"}).out, testing::ContainsRegex("repaired +line [0-9]+: "));
  EXPECT_THAT(run({"convert", "cut.bvh", "out.bvh"}).err, HasSubstr("cut.bvh:"));
}

// Tests a marker on a force plate's corner, in every command and format.
TEST_F(C3dFiles, AMarkerAtTheOriginComesBack) {
  const std::string take = c3d_fixture("laboratory");
  const auto expect_there = [&](const std::string& name) {
    SCOPED_TRACE(name);
    EXPECT_EQ(info(name).at("markers").at(1).at("missing_frames"), 0);
  };
  expect_there(take);
  for (const char* const out : {"out.c3d", "out.trc", "out.csv"}) {
    run({"convert", take, "-o", out});
    expect_there(out);
    run({"convert", out, "-o", "back.c3d", "--force"});
    expect_there("back.c3d");
    run({"clean", out, "-o", std::string("clean-") + out});
    expect_there(std::string("clean-") + out);
  }
}

}  // namespace
}  // namespace kinemend::test
