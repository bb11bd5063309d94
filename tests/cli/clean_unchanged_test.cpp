// Tests of the reasons that `clean` gives for leaving a take unchanged, and of flags without
// effect.
#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Unchanged = Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Moves the root of the take to and fro by 15 cm, so that standing feet slide.
std::string with_sliding_root(const std::string& bvh) {
  std::istringstream lines(bvh);
  std::string text;
  int frame = -1;
  for (std::string line; std::getline(lines, line);) {
    if (frame >= 0) {
      const std::size_t end = line.find(' ');
      const double x = std::stod(line.substr(0, end)) + 15 * std::sin(0.05 * frame);
      line = fmt::format("{:.6f}{}", x, line.substr(end));
      ++frame;
    }
    if (line.starts_with("Frame Time:")) frame = 0;
    text += line + "\n";
  }
  return text;
}

TEST_F(Unchanged, SlidingFeetAreSaidWithWhatHoldsThem) {
  synth("walk.bvh", "walk", "4");
  put(folder / "slide.bvh", with_sliding_root(contents(folder / "walk.bvh")));
  ASSERT_THAT(run({"check", "slide.bvh"}).out, HasSubstr("slide"));
  const Ran ran = run({"clean", "slide.bvh"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("of standing feet left"), HasSubstr(" cm at most"),
                             HasSubstr("(--feet auto holds the feet)"),
                             Not(HasSubstr("clean: nothing changed"))));
}

TEST_F(Unchanged, ACutoffAboveTheNyquistFrequencyIsAWarningInEveryMethod) {
  noisy("walk.bvh", "2");
  const Ran ran =
      run({"clean", "walk.bvh", "-m", "butterworth", "--cutoff-hz", "40", "-o", "out.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("cutoff_hz: 40.0 Hz is not below the Nyquist frequency of 30.0 "
                                 "Hz (half the frame rate)"));
  EXPECT_THAT(ran.out, AllOf(HasSubstr("(a lower --cutoff-hz smooths it)"),
                             Not(HasSubstr("clean: nothing changed"))));
  const Ran euro =
      run({"clean", "walk.bvh", "-m", "one-euro", "--min-cutoff-hz", "40", "-o", "euro.bvh"});
  EXPECT_EQ(euro.code, 0);
  EXPECT_THAT(euro.err, HasSubstr("min_cutoff_hz: 40.0 Hz is not below the Nyquist frequency"));
  const Ran strict = run({"clean", "walk.bvh", "-m", "butterworth", "--cutoff-hz", "40", "-o",
                          "strict.bvh", "--strict"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_FALSE(fs::exists(folder / "strict.bvh"));
}

// Noise of 15 Hz samples joined by lines is invisible to a measure of single frames.
TEST_F(Unchanged, NoiseThatCheckFindsIsSaidWhereTheMethodMeasuresNone) {
  synth("walk.bvh", "walk", "6");
  ASSERT_EQ(run({"corrupt", "walk.bvh", "-o", "joined.bvh", "--damage", "gaussian:std_deg=1.5",
                 "--damage", "upsampled:rate_hz=15"})
                .code,
            0);
  ASSERT_THAT(run({"check", "joined.bvh"}).out, HasSubstr("jitters from frame to frame"));
  const Ran ran = run({"clean", "joined.bvh", "-m", "hampel", "--threshold", "20", "--dry-run"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("nothing changed: jitter on 31 joints left, "),
                             HasSubstr(" deg at most (hampel takes it for motion; --method "
                                       "butterworth --cutoff-hz 6 smooths it anyway)"),
                             Not(HasSubstr("clean: nothing changed"))));
}

TEST_F(Unchanged, ATakeOfTwoFramesIsTooShort) {
  put(folder / "hand.bvh", hand_take());
  std::vector<std::string> lines = lines_of(hand_take());
  std::string text;
  int frame = -1;
  for (std::string line : lines) {
    if (line.starts_with("Frames:")) line = "Frames: 2";
    if (frame < 0 || frame++ < 2) text += line + "\n";
    if (line.starts_with("Frame Time:")) frame = 0;
  }
  put(folder / "two.bvh", text);
  const Ran ran = run({"clean", "two.bvh"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, AllOf(HasSubstr("too short to tell noise from motion: 2 frames, and 4"),
                             Not(HasSubstr("clean: nothing changed"))));
}

TEST_F(Unchanged, ACleanTakeIsSaidToBeClean) {
  synth("walk.bvh", "walk", "4");
  EXPECT_THAT(run({"clean", "walk.bvh"}).out, HasSubstr("walk.bvh: clean: nothing changed"));
}

TEST_F(Unchanged, ADirectoryLeadsToBatch) {
  fs::create_directory(folder / "walk");
  const Ran ran = run({"clean", "walk"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(
      ran.err,
      "kinemend: walk: this is a directory; to clean a tree of takes use: kinemend batch walk "
      "-o OUT\n");
}

TEST_F(Unchanged, FlagsThatMeanNothingForTheKindOfTakeAreSaid) {
  noisy("walk.bvh", "1");
  put(folder / "plate.trc", plate_take());
  struct Case {
    std::string take;
    std::vector<std::string> flags;
    std::string said;
  };
  const std::vector<Case> cases = {
      {"walk.bvh", {"--fix-swaps"}, "walk.bvh: --fix-swaps has no effect on joints"},
      {"walk.bvh", {"--fill", "auto"}, "--fill has no effect: the take states no gaps"},
      {"walk.bvh", {"--max-change", "5"}, "--max-change has no effect on joints"},
      {"plate.trc", {"--max-change-deg", "5"}, "--max-change-deg has no effect on markers"}};
  for (const Case& each : cases) {
    std::vector<std::string> words = {"clean", each.take, "--dry-run"};
    words.insert(words.end(), each.flags.begin(), each.flags.end());
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << each.said;
    EXPECT_THAT(ran.err, HasSubstr(each.said));
    words.emplace_back("--strict");
    EXPECT_EQ(run(words).code, 1) << each.said;
  }
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  const Ran named = run({"clean", "walk.bvh", "--dry-run", "--fill", "auto", "--gaps", "gaps.csv"});
  EXPECT_THAT(named.err, Not(HasSubstr("no effect")));
  EXPECT_EQ(run({"clean", "plate.trc", "--dry-run", "--fill", "auto", "--fix-swaps"}).err, "");
}

TEST_F(Unchanged, PresetsAndConfigurationFilesMayHoldFlagsOfBothKinds) {
  noisy("walk.bvh", "1");
  put(folder / "lab.toml", "fix_swaps = true\nfill = \"auto\"\nmax_change = 50.0\n");
  EXPECT_EQ(run({"clean", "walk.bvh", "--dry-run", "--config", "lab.toml"}).err, "");
}

TEST_F(Unchanged, WarningsOfManyJointsAreOneLineWithTheWorstThree) {
  noisy("walk.bvh", "4");
  const Ran ran = run(
      {"clean", "walk.bvh", "-m", "butterworth", "--cutoff-hz", "1", "--report", "report.json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_LE(lines_of(ran.err).size(), 2u) << ran.err;
  EXPECT_THAT(ran.err, testing::ContainsRegex(
                           "peak speed falls by more than 10 % on [0-9]+ joints, most on "
                           "[A-Za-z0-9]+ \\(from [0-9.]+ to [0-9.]+ deg/s, [0-9]+ %\\), "));
  // A method that does not estimate noise still reports the measured noise.
  const Json take = Json::parse(contents(folder / "report.json"))["takes"][0];
  std::size_t noisy_joints = 0;
  for (const Json& track : take["tracks"]) {
    const double noise = track["noise"];
    noisy_joints += noise > 1 && noise < 2.2 ? 1 : 0;
  }
  EXPECT_GT(noisy_joints, 25u);
  EXPECT_THAT(ran.out, HasSubstr("deg jitter on "));
}

TEST_F(Unchanged, EveryMethodAndCheckReportTheSameNoiseAndPeakSpeed) {
  ASSERT_EQ(run({"synth", "walk", "-o", "clean.bvh"}).code, 0);
  for (const std::string damage : {"gaussian:std_deg=1.5", "ar1"}) {
    ASSERT_EQ(run({"corrupt", "clean.bvh", "-o", "walk.bvh", "--force", "--damage", damage,
                   "--damage", "outliers"})
                  .code,
              0);
    const auto tracks = [&](const std::vector<std::string>& words) {
      EXPECT_LE(run(words).code, 1);
      return Json::parse(contents(folder / "report.json"))["takes"][0]["tracks"];
    };
    const Json checked = tracks({"check", "walk.bvh", "--report", "report.json", "--force"});
    Json first;
    for (const std::string method : {"learned", "auto", "butterworth", "kalman", "wiener"}) {
      const Json own = tracks({"clean", "walk.bvh", "-m", method, "--dry-run", "-q", "--report",
                               "report.json", "--force"});
      if (first.is_null()) first = own;
      ASSERT_EQ(own.size(), checked.size());
      for (std::size_t t = 0; t < own.size(); ++t) {
        EXPECT_EQ(own[t]["noise"], checked[t]["noise"]) << damage << " " << method << " " << t;
        for (const char* name : {"peak_speed_before", "peak_frames"})
          EXPECT_EQ(own[t][name], first[t][name]) << damage << " " << method << " " << t;
        EXPECT_EQ(own[t].contains("expected_noise"), method == "learned") << method;
      }
    }
  }
}

TEST_F(Unchanged, CheckAndCleanCountTheSameSpikesAndNoisyJoints) {
  noisy("walk.bvh", "4");
  ASSERT_EQ(run({"check", "walk.bvh", "--report", "check.json"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.bvh", "--dry-run", "--report", "clean.json"}).code, 0);
  const auto count = [&](const char* name, const std::string& kind) {
    std::size_t found = 0;
    const Json report = Json::parse(contents(folder / name));
    for (const Json& finding : report["takes"][0]["findings"])
      found += finding["kind"] == kind ? 1 : 0;
    return found;
  };
  EXPECT_GT(count("check.json", "spike"), 5u);
  EXPECT_EQ(count("check.json", "spike"), count("clean.json", "spike"));
  EXPECT_GT(count("check.json", "noise"), 25u);
  EXPECT_LE(count("clean.json", "noise"), 32u) << "31 joints and the root position, once each";
  const auto figure = [&](const char* name) {
    return Json::parse(contents(folder / name))["takes"][0]["figures"]["spikes"];
  };
  EXPECT_EQ(figure("check.json"), figure("clean.json"));
}

TEST_F(Unchanged, PointsThatAreNoPositionsAreNotCountedAsMarkers) {
  const std::string take = c3d_fixture("laboratory");
  const Json info = Json::parse(run({"info", take, "--json"}).out)["takes"][0];
  const Ran ran = run({"clean", take, "--report", "report.json", "--report", "page.html"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json report = Json::parse(contents(folder / "report.json"))["takes"][0];
  ASSERT_EQ(run({"check", take, "--report", "check.json"}).code, 0);
  const Json check = Json::parse(contents(folder / "check.json"))["takes"][0];
  EXPECT_EQ(report["tracks"].size(), check["tracks"].size());
  EXPECT_EQ(report["figures"]["gaps_left"], check["figures"]["gaps"]);
  EXPECT_THAT(ran.out, HasSubstr(fmt::format(" of {} marker", check["tracks"].size())));
  EXPECT_LT(check["tracks"].size(), info["markers"].size());
}

}  // namespace
}  // namespace kinemend::test
