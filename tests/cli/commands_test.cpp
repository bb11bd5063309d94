// Tests of `info`, `compare`, `corrupt`, `convert`, `methods` and `synth` from the command line.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Commands = Program;
using testing::HasSubstr;

TEST_F(Commands, InfoTellsWhatIsInATake) {
  put(folder / "hand.bvh", hand_take());
  const Ran ran = run({"info", "hand.bvh", "--tree"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("4 (15 channels, 2 end sites)"));
  EXPECT_THAT(ran.out, HasSubstr("10 frames at 30 Hz (0.33 s)"));
  EXPECT_THAT(ran.out, HasSubstr("      LeftArm"));
  const Json take = Json::parse(run({"info", "hand.bvh", "--json"}).out)["takes"][0];
  EXPECT_EQ(take["joint_count"], 4);
  EXPECT_EQ(take["frames"], 10);
  EXPECT_EQ(take["joints"][2]["parent"], 1);
  EXPECT_EQ(take["joints"][0]["channels"], "Xpos Ypos Zpos Zrot Xrot Yrot");
}

TEST_F(Commands, InfoFindsTheCalibrationPoseAndTheUnit) {
  ASSERT_EQ(run({"synth", "walk", "-o", "t.bvh", "--duration-s", "1", "--t-pose-first"}).code, 0);
  const Json take = Json::parse(run({"info", "t.bvh", "--json"}).out)["takes"][0];
  EXPECT_EQ(take["calibration_frames"], 1);
  EXPECT_EQ(take["unit_guess"], "cm");
  EXPECT_EQ(take["frames"], 121);
}

TEST_F(Commands, InfoEstimatesTheNoise) {
  noisy("walk.bvh");
  const Json joints =
      Json::parse(run({"info", "walk.bvh", "--noise", "--json"}).out)["takes"][0]["joints"];
  double sum = 0;
  for (const Json& joint : joints) sum += joint["noise_deg"].get<double>();
  EXPECT_NEAR(sum / static_cast<double>(joints.size()), 1.5, 0.15);
}

TEST_F(Commands, CompareFindsATakeEqualToItself) {
  synth("a.bvh");
  const Ran ran = run({"compare", "a.bvh", "a.bvh", "--json"});
  EXPECT_EQ(ran.code, 0);
  const Json json = Json::parse(ran.out)["takes"][0]["figures"];
  for (const char* name : {"rms_deg", "geodesic_rms_deg", "mpjpe", "accel_error", "mse_rad2"})
    EXPECT_EQ(json[name], 0) << name;
  EXPECT_TRUE(json["psnr_db"].is_null());
  EXPECT_THAT(run({"compare", "a.bvh", "a.bvh"}).out, HasSubstr("equal"));
}

TEST_F(Commands, CompareMeasuresAKnownDifference) {
  put(folder / "a.bvh", hand_take());
  // In every frame, all joints are rotated by 30 degrees about their own axis, so the angle is
  // known.
  ASSERT_EQ(run({"corrupt", "a.bvh", "-o", "b.bvh", "--damage", "bias:bias_deg=30,root"}).code, 0);
  const Json json =
      Json::parse(run({"compare", "a.bvh", "b.bvh", "--json"}).out)["takes"][0]["figures"];
  EXPECT_NEAR(json["geodesic_rms_deg"], 30, 1e-3);
  EXPECT_NEAR(json["geodesic_max_deg"], 30, 1e-3);
}

TEST_F(Commands, CompareHoldsLimits) {
  noisy("b.bvh");
  EXPECT_EQ(run({"compare", "truth.bvh", "b.bvh", "--max-geodesic-rms-deg", "10"}).code, 0);
  const Ran above =
      run({"compare", "truth.bvh", "b.bvh", "--max-geodesic-rms-deg", "1", "--min-psnr-db", "100"});
  EXPECT_EQ(above.code, 1);
  const auto errors = lines_of(above.err);
  ASSERT_EQ(errors.size(), 2u);
  EXPECT_THAT(errors[0],
              testing::MatchesRegex("kinemend: geodesic_rms_deg [0-9.]+ is above the limit 1"));
  EXPECT_THAT(errors[1], testing::MatchesRegex("kinemend: psnr_db [0-9.]+ is below the limit 100"));
  EXPECT_THAT(above.out, HasSubstr("geodesic_rms_deg"));
}

TEST_F(Commands, CompareRefusesTakesThatDoNotMatch) {
  put(folder / "hand.bvh", hand_take());
  synth("walk.bvh");
  const Ran ran = run({"compare", "hand.bvh", "walk.bvh"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, IsOneLine());
}

TEST_F(Commands, CorruptGivesTheSameBytesForTheSameSeed) {
  synth("a.bvh");
  const auto damage = [&](const std::string& name, const std::string& seed) {
    EXPECT_EQ(run({"corrupt", "a.bvh", "-o", name, "--damage", "gaussian:std-deg=2", "--damage",
                   "long-gap", "--seed", seed})
                  .code,
              0);
    return contents(folder / name);
  };
  const std::string first = damage("1.bvh", "5");
  EXPECT_EQ(first, damage("2.bvh", "5"));
  EXPECT_NE(first, damage("3.bvh", "6"));
  EXPECT_NE(first, contents(folder / "a.bvh"));
}

TEST_F(Commands, CorruptTellsHowMuchItDid) {
  synth("a.bvh");
  const Ran ran = run({"corrupt", "a.bvh", "-o", "b.bvh", "--json", "--damage",
                       "gaussian:std_deg=2,joints=Left*,Right*"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json done = Json::parse(ran.out)["damages"][0];
  const Json compared =
      Json::parse(run({"compare", "a.bvh", "b.bvh", "--json"}).out)["takes"][0]["figures"];
  EXPECT_NEAR(done["rms_deg"], compared["geodesic_rms_deg"].get<double>(), 1e-3);
  EXPECT_LT(done["samples_damaged"], done["samples"]);
  EXPECT_GT(done["samples_damaged"], 0);
  EXPECT_THAT(run({"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "gaussian"}).out,
              HasSubstr("rms deg"));
}

TEST_F(Commands, ConvertWithinAFormatKeepsEveryByte) {
  put(folder / "hand.bvh", hand_take());
  ASSERT_EQ(run({"convert", "hand.bvh", "-o", "same.bvh"}).code, 0);
  EXPECT_EQ(contents(folder / "same.bvh"), hand_take());
  ASSERT_EQ(run({"convert", "hand.bvh", "-o", "plain.bvh", "--plain"}).code, 0);
  EXPECT_NE(contents(folder / "plain.bvh"), hand_take());
  EXPECT_EQ(run({"compare", "hand.bvh", "plain.bvh", "--max-geodesic-max-deg", "1e-4"}).code, 0);
}

TEST_F(Commands, ConvertTakesTheFormatByNameWhereThereIsNoExtension) {
  put(folder / "hand.bvh", hand_take());
  EXPECT_EQ(run({"convert", "hand.bvh", "-o", "take", "--to", "bvh"}).code, 0);
  EXPECT_EQ(contents(folder / "take"), hand_take());
}

TEST_F(Commands, MethodsTellsOfEachWithRangesAndPaper) {
  const Ran all = run({"methods"});
  EXPECT_EQ(all.code, 0);
  EXPECT_THAT(all.out, testing::StartsWith("auto\n"));
  const Ran one = run({"methods", "butterworth"});
  EXPECT_THAT(one.out, testing::StartsWith("butterworth\n"));
  EXPECT_THAT(one.out, HasSubstr("--cutoff-hz"));
  EXPECT_THAT(one.out, HasSubstr("0.05 to 500"));
  EXPECT_THAT(one.out, HasSubstr("From: "));
  const Json method = Json::parse(run({"methods", "butterworth", "--json"}).out)["methods"][0];
  const Json& cutoff = method["options"][1];
  EXPECT_EQ(cutoff["name"], "cutoff_hz");
  EXPECT_EQ(cutoff["unit"], "Hz");
  EXPECT_EQ(cutoff["default"], 8);
  EXPECT_EQ(cutoff["maximum"], 500);
}

TEST_F(Commands, SynthWritesATakeThatIsReadBack) {
  synth("a.bvh", "run", "1");
  synth("b.bvh", "run", "1");
  EXPECT_EQ(contents(folder / "a.bvh"), contents(folder / "b.bvh"));
  const Json take = Json::parse(run({"info", "a.bvh", "--json"}).out)["takes"][0];
  EXPECT_EQ(take["frames"], 60);
  EXPECT_NEAR(take["frame_rate_hz"], 60, 1e-3);
  const Ran unknown = run({"synth", "moonwalk", "-o", "c.bvh"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("unknown motion moonwalk"));
}

TEST_F(Commands, NumbersDoNotDependOnTheLocale) {
  put(folder / "hand.bvh", hand_take());
  const Setting german = {"", {}, {{"LC_ALL", "de_DE.UTF-8"}, {"LANG", "de_DE.UTF-8"}}};
  EXPECT_EQ(run({"info", "hand.bvh"}, german).out, run({"info", "hand.bvh"}).out);
}

TEST_F(Commands, CorruptDamagesMarkersAsWell) {
  synth("walk.bvh");
  ASSERT_EQ(run({"convert", "walk.bvh", "walk.trc"}).code, 0);
  const std::vector<std::string> words = {"corrupt", "walk.trc", "--seed", "3", "--json"};
  const auto damage = [&](const std::string& what, const std::string& output) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--damage", what, "-o", output});
    return run(all);
  };
  const Ran ran = damage("gaussian:std_deg=1,joints=Left*", "noisy.trc");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const Json report = Json::parse(ran.out)["damages"][0];
  EXPECT_GT(report["samples_damaged"], 0);
  EXPECT_LT(report["samples_damaged"], report["samples"]);
  EXPECT_GT(report["rms_position"], 0);
  EXPECT_EQ(damage("gaussian:std_deg=1,joints=Left*", "again.trc").code, 0);
  EXPECT_EQ(contents(folder / "again.trc"), contents(folder / "noisy.trc"));
  EXPECT_NE(contents(folder / "walk.trc"), contents(folder / "noisy.trc"));
  const Ran refused = damage("gaussian-log", "x.trc");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, testing::HasSubstr("turns the joints of a skeleton"));
  EXPECT_FALSE(fs::exists(folder / "x.trc"));
}

TEST_F(Commands, CorruptMakesTheNoiseOfSystemsAndLeavesEveryByteAtNoStrength) {
  synth("walk.bvh");
  ASSERT_EQ(run({"convert", "walk.bvh", "walk.trc"}).code, 0);
  for (const std::string format : {"bvh", "trc"}) {
    const std::string input = "walk." + format, output = "noisy." + format;
    const auto damage = [&](const std::string& what) {
      const Ran ran = run({"corrupt", input, "-o", output, "--force", "--damage", what});
      EXPECT_EQ(ran.code, 0) << ran.err;
      return contents(folder / output);
    };
    const std::string clean = contents(folder / input);
    for (const char* kind : {"video", "triangulated", "depth", "inertial", "optical"}) {
      const std::string system = std::string("system:kind=") + kind;
      EXPECT_NE(damage(system + ",fc_hz=2.5"), clean) << kind;
      EXPECT_EQ(damage(system + ",strength=0"), clean) << kind;
    }
    EXPECT_NE(damage("held:rate_hz=10"), clean);
    EXPECT_NE(damage("upsampled:rate-hz=10"), clean);
    EXPECT_EQ(damage("held:rate_hz=1000"), clean);
  }
}

TEST_F(Commands, CorruptWritesTheFormatOfItsOutputAndNamesWhatThatLoses) {
  synth("walk.bvh");
  for (const std::string format : {"bvh", "csv", "amc"}) {
    const std::string damaged = "damaged." + format, converted = "converted." + format;
    const Ran corrupt = run({"corrupt", "walk.bvh", "-o", damaged, "--damage", "gaussian"});
    ASSERT_EQ(corrupt.code, 0) << corrupt.err;
    EXPECT_EQ(corrupt.err, run({"convert", "walk.bvh", converted}).err);
    const Ran info = run({"info", damaged, "--json"});
    ASSERT_EQ(info.code, 0) << info.err;
    EXPECT_EQ(Json::parse(info.out)["takes"][0]["format"], format);
  }
  const Ran markers = run({"corrupt", "walk.bvh", "-o", "x.trc", "--damage", "gaussian"});
  EXPECT_EQ(markers.code, 2);
  EXPECT_THAT(markers.err, testing::HasSubstr("walk.bvh: holds joints; trc files hold markers"));
  EXPECT_FALSE(fs::exists(folder / "x.trc"));
}

}  // namespace
}  // namespace kinemend::test
