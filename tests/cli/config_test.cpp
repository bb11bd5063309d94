// Tests of presets and configuration files, and of the precedence of settings.
#include <fmt/format.h>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Config = Program;
using testing::HasSubstr;

const std::vector<std::string> presets = {"live", "biomech"};

Json options_of(const Ran& ran) { return Json::parse(ran.out)["takes"][0]["options"]; }

TEST_F(Config, WhatIsPrintedReadsBackAsTheSame) {
  for (const std::string& preset : presets) {
    const Ran first = run({"clean", "--preset", preset, "--print-config"});
    ASSERT_EQ(first.code, 0) << first.err;
    put(folder / "lab.toml", first.out);
    const Ran again = run({"clean", "--config", "lab.toml", "--print-config"});
    ASSERT_EQ(again.code, 0) << again.err;
    // The comment at the top names the preset, so it differs.
    const auto body = [](const std::string& text) { return text.substr(text.find("\n\n")); };
    EXPECT_EQ(body(again.out), body(first.out)) << preset;
  }
}

TEST_F(Config, APresetAndItsPrintedFileCleanAlike) {
  noisy("walk.bvh", "1");
  for (const std::string& preset : presets) {
    put(folder / "lab.toml", run({"clean", "--preset", preset, "--print-config"}).out);
    ASSERT_EQ(run({"clean", "walk.bvh", "-o", "a.bvh", "--force", "--preset", preset}).code, 0);
    ASSERT_EQ(run({"clean", "walk.bvh", "-o", "b.bvh", "--force", "--config", "lab.toml"}).code, 0);
    EXPECT_EQ(contents(folder / "a.bvh"), contents(folder / "b.bvh")) << preset;
  }
}

TEST_F(Config, APresetThatNamesAnotherMethodSaysSo) {
  noisy("walk.bvh", "1");
  EXPECT_THAT(run({"clean", "walk.bvh", "--dry-run", "--preset", "biomech"}).out,
              HasSubstr("method butterworth is the choice of --preset biomech, in place of "
                        "learned, the default"));
  EXPECT_THAT(run({"clean", "walk.bvh", "--dry-run", "--preset", "live"}).out,
              HasSubstr("method one-euro is the choice of --preset live"));
  EXPECT_THAT(run({"clean", "walk.bvh", "--dry-run", "--preset", "biomech", "-m", "median"}).out,
              Not(HasSubstr("is the choice of")));
}

TEST_F(Config, EverySettingIsPrintedWithItsUnitAndRange) {
  const Ran ran = run({"clean", "--preset", "biomech", "--print-config"});
  EXPECT_THAT(ran.out, HasSubstr("method = \"butterworth\""));
  EXPECT_THAT(ran.out, HasSubstr("frame rate (0.05 to 500 Hz; default\n# 8)\ncutoff_hz = 7.48\n"));
  EXPECT_THAT(ran.out, HasSubstr("Typical: "));
  for (const char* name : {"strength", "max_change_deg", "peak_loss_limit", "joints", "exclude",
                           "root_position", "strict"})
    EXPECT_THAT(ran.out, HasSubstr(fmt::format("\n{} = ", name))) << name;
}

TEST_F(Config, TheCommandLineGoesOverTheFileAndTheFileOverThePreset) {
  put(folder / "walk.bvh", hand_take());
  put(folder / "lab.toml", "[butterworth]\ncutoff_hz = 5\n");
  const std::vector<std::string> words = {"clean",  "walk.bvh", "--dry-run",
                                          "--json", "--preset", "biomech"};
  auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return options_of(run(more));
  };
  EXPECT_EQ(with({})["cutoff_hz"], 7.48);
  EXPECT_EQ(with({})["order"], 2);
  EXPECT_EQ(with({"--config", "lab.toml"})["cutoff_hz"], 5);
  EXPECT_EQ(with({"--config", "lab.toml"})["order"], 2);
  EXPECT_EQ(with({"--config", "lab.toml", "--cutoff-hz", "4"})["cutoff_hz"], 4);
  EXPECT_TRUE(with({"--method", "median"}).contains("window_s"));
}

TEST_F(Config, AFileMayHoldOptionsOfMethodsThatAreNotChosen) {
  put(folder / "walk.bvh", hand_take());
  put(folder / "lab.toml",
      "method = \"median\"\n[median]\nwindow_s = 0.2\n[kalman]\nagility = 2\n");
  const std::vector<std::string> words = {"clean",  "walk.bvh", "--dry-run",
                                          "--json", "--config", "lab.toml"};
  EXPECT_EQ(options_of(run(words))["window_s"], 0.2);
  std::vector<std::string> other = words;
  other.insert(other.end(), {"-m", "kalman"});
  EXPECT_EQ(options_of(run(other))["agility"], 2);
}

TEST_F(Config, SwitchesOfMethodsTurnOnAndOff) {
  put(folder / "walk.bvh", hand_take());
  const auto smoother = [&](const std::string& word) {
    return options_of(
        run({"clean", "walk.bvh", "--dry-run", "--json", "-m", "kalman", word}))["smoother"];
  };
  EXPECT_EQ(smoother("--smoother"), true);
  EXPECT_EQ(smoother("--no-smoother"), false);
}

TEST_F(Config, AnUnknownMethodIsAnsweredWithThoseThereAre) {
  put(folder / "lab.toml", "method = \"magic\"\n");
  const Ran ran = run({"clean", "--config", "lab.toml", "--print-config"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err,
              testing::StartsWith("kinemend: lab.toml:1: method: \"magic\" is not one of auto, "));
}

TEST_F(Config, ListsComeFromTheFileToo) {
  put(folder / "hand.bvh", hand_take());
  put(folder / "lab.toml",
      "method = \"weighted-mean\"\njoints = [\"Left*\"]\nexclude = [\"*1\"]\n");
  const Ran ran = run({"clean", "hand.bvh", "--json", "--config", "lab.toml"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json joints = Json::parse(ran.out)["takes"][0]["tracks"];
  EXPECT_EQ(joints[0]["frames_changed"], 0);
  EXPECT_GT(joints[1]["frames_changed"], 0);
  EXPECT_EQ(joints[2]["frames_changed"], 0);
  EXPECT_GT(joints[3]["frames_changed"], 0);
}

struct Fault {
  std::string toml;
  int code;
  std::string message;

  friend void PrintTo(const Fault& one, std::ostream* out) { *out << one.message; }
};

class ConfigFault : public Program, public testing::WithParamInterface<Fault> {};

TEST_P(ConfigFault, IsReportedWithItsLine) {
  put(folder / "hand.bvh", hand_take());
  put(folder / "lab.toml", GetParam().toml);
  const Ran ran = run({"clean", "hand.bvh", "--config", "lab.toml"});
  EXPECT_EQ(ran.code, GetParam().code);
  EXPECT_EQ(ran.err, "kinemend: lab.toml:" + GetParam().message + "\n");
  EXPECT_EQ(files().size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(
    Files, ConfigFault,
    testing::Values(Fault{"\nstrenght = 1\n", 2,
                          "2: unknown setting strenght (did you mean strength?)"},
                    Fault{"strength = 1.5\n", 2, "1: strength: 1.5 is outside 0 to 1"},
                    Fault{"strength = \"much\"\n", 2, "1: strength: much is not a number"},
                    Fault{"joints = \"Left*\"\n", 2, "1: joints: is not a list"},
                    Fault{"joints = [\n\"a\",\n3]\n", 2, "3: joints: expected texts in quotes"},
                    Fault{"strength = 1979-05-27\n", 2, "1: strength: has the wrong type"},
                    Fault{"[butterwort]\norder = 2\n", 2,
                          "1: unknown method butterwort (did you mean butterworth?)"},
                    Fault{"[butterworth]\ncutof_hz = 2\n", 2,
                          "2: unknown option of butterworth cutof_hz (did you mean cutoff_hz?)"},
                    Fault{"[butterworth]\n\norder = 40\n", 2, "3: order: 40 is outside 1 to 12"},
                    Fault{"[butterworth]\norder = 2.5\n", 2, "2: order: 2.5 has the wrong type"},
                    Fault{"output = \"x\"\n", 2, "1: unknown setting output"}));

}  // namespace
}  // namespace kinemend::test
