// An invalid command line gives one line on standard error, exit code 2, and no output.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Usage = Program;

struct Case {
  std::vector<std::string> words;
  std::string message;

  friend void PrintTo(const Case& one, std::ostream* out) { *out << one.message; }
};

class UsageMessage : public Program, public testing::WithParamInterface<Case> {};

TEST_P(UsageMessage, IsOneLineThatSaysWhatToDo) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", hand_take());
  put(folder / "bad.toml", "strength = 2\n");
  const Ran ran = run(GetParam().words);
  EXPECT_EQ(ran.code, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err, "kinemend: " + GetParam().message + "\n");
  EXPECT_THAT(files(), testing::ElementsAre("a.bvh", "b.bvh", "bad.toml"));
}

INSTANTIATE_TEST_SUITE_P(
    CommandLines, UsageMessage,
    testing::Values(
        Case{{}, "a command is missing (see kinemend -h)"},
        Case{{"claen"}, "unknown command claen (did you mean clean?)"},
        Case{{"xyzzy-plugh"}, "unknown command xyzzy-plugh (see kinemend -h)"},
        Case{{"--frobnicate"}, "unknown option --frobnicate (see kinemend -h)"},
        Case{{"clean"}, "clean: IN is missing (see kinemend clean -h)"},
        Case{{"clean", "a.bvh", "--strenght", "0.5"},
             "clean: unknown option --strenght (did you mean --strength?)"},
        Case{{"clean", "a.bvh", "--cutof-hz=6"},
             "clean: unknown option --cutof-hz (did you mean --cutoff-hz?)"},
        Case{{"clean", "a.bvh", "--qqqqqqqqqqqq"},
             "clean: unknown option --qqqqqqqqqqqq (see kinemend clean -h)"},
        Case{{"clean", "a.bvh", "--strength"},
             "clean: --strength needs a value (see kinemend clean -h)"},
        Case{{"clean", "a.bvh", "--strength", "2"}, "--strength: 2 is outside 0 to 1"},
        Case{{"clean", "a.bvh", "--strength", "-0.1"}, "--strength: -0.1 is outside 0 to 1"},
        Case{{"clean", "a.bvh", "--strength", "nan"}, "--strength: nan is outside 0 to 1"},
        Case{{"clean", "a.bvh", "--strength", "half"}, "--strength: \"half\" is not a number"},
        Case{{"clean", "a.bvh", "--strength", "0,5"}, "--strength: \"0,5\" is not a number"},
        Case{{"clean", "a.bvh", "--max-change-deg", "181"},
             "--max-change-deg: 181 is outside 0 to 180 deg"},
        Case{{"clean", "a.bvh", "--source", "vidoe"},
             "--source: unknown name vidoe (did you mean video?)"},
        Case{{"check", "a.bvh", "--source", "vidoe"},
             "--source: unknown name vidoe (did you mean video?)"},
        Case{{"clean", "a.bvh", "--source", "satellite"},
             "--source: \"satellite\" is not one of optical, suit, video, depth, keyframed, "
             "unknown"},
        Case{{"clean", "a.bvh", "--jobs", "2.5"}, "--jobs: \"2.5\" is not a whole number"},
        Case{{"clean", "a.bvh", "-m", "butterworth", "--cutoff-hz", "900"},
             "--cutoff-hz: 900 is outside 0.05 to 500 Hz"},
        Case{{"clean", "a.bvh", "--cutoff-hz", "6"},
             "--cutoff-hz is an option of butterworth, not of learned (choose with --method)"},
        Case{{"clean", "a.bvh", "--preset", "gym"},
             "--preset: \"gym\" is not one of live, biomech"},
        Case{{"clean", "a.bvh", "--range", "5"},
             "--range: 5 is neither a range of frames (121:240) nor of seconds (1s:2.5s)"},
        Case{{"clean", "a.bvh", "--range", "0:5"}, "a.bvh: --range: frame 0 is outside 1 to 10"},
        Case{{"clean", "a.bvh", "--range", "1s:5"},
             "--range: 1s:5 is neither a range of frames (121:240) nor of seconds (1s:2.5s)"},
        Case{{"clean", "a.bvh", "--range", "7:5"}, "--range: 7:5 ends before it begins"},
        Case{{"clean", "a.bvh", "--range", "3:11"}, "a.bvh: --range: frame 11 is outside 1 to 10"},
        Case{{"clean", "a.bvh", "--range", "11:"}, "a.bvh: --range: frame 11 is outside 1 to 10"},
        Case{{"clean", "a.bvh", "b.bvh", "-o", "c.bvh"},
             "clean: --output c.bvh is a file for one take, and there are 2; --output-dir c.bvh "
             "writes them into a folder"},
        Case{{"clean", "a.bvh", "-o", "c.bvh", "--output-dir", "d"},
             "clean: --output and --output-dir cannot be combined"},
        Case{{"clean", "a.bvh", "./a.bvh", "--output-dir", "d"},
             "clean: a.bvh and ./a.bvh would both be written to d/a.bvh"},
        Case{{"clean", "-", "--output-dir", "d"},
             "clean: standard input has no name for --output-dir"},
        Case{{"clean", "-", "--json"},
             "standard output holds one thing: a take, a report or --json, not several"},
        Case{{"clean", "a.bvh", "--config", "bad.toml"},
             "bad.toml:1: strength: 2 is outside 0 to 1"},
        Case{{"compare", "a.bvh"}, "compare: OTHER is missing (see kinemend compare -h)"},
        Case{{"compare", "a.bvh", "b.bvh", "c.bvh"},
             "compare: unexpected argument c.bvh (see kinemend compare -h)"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh"},
             "corrupt: --damage is missing (see kinemend corrupt -h)"},
        Case{{"corrupt", "a.bvh", "--damage", "gaussian"},
             "corrupt: --output is missing (see kinemend corrupt -h)"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "gausian"},
             "--damage: unknown damage gausian (did you mean gaussian?)"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "gaussian:std_deg=200"},
             "--damage gaussian: std_deg: 200 is outside 0 to 180 deg"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "gaussian:std_deg"},
             "--damage: std_deg needs a value"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "gaussian:sigma=1"},
             "--damage: gaussian has no option sigma; it has std_deg, joints, root"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "system:kind=radar"},
             "--damage system: kind: \"radar\" is not one of video, triangulated, depth, inertial, "
             "optical"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "system:fc_hz=0"},
             "fc_hz: must be above 0 Hz"},
        Case{{"corrupt", "a.bvh", "-o", "c.bvh", "--damage", "held:rate_hz=0"},
             "--damage held: rate_hz: 0 is outside 0.1 to 100000 Hz"},
        Case{{"convert", "a.bvh", "-o", "c.xyz"},
             "c.xyz: .xyz files are not written; the endings that are written: .bvh, .amc, .asf, "
             ".c3d, "
             ".trc, .tsv, .csv, .glb, .vrm, .vrma, .gltf, .fbx, .npz. A name without an ending "
             "keeps the "
             "format "
             "of "
             "the input"},
        Case{{"synth", "walk", "-o", "c.bvh", "--duration-s", "0"},
             "--duration-s: 0 is outside 0.1 to 600 s"},
        Case{{"completion", "tcsh"},
             "completion: unknown shell tcsh; known are bash, zsh and fish"}));

TEST_F(Usage, AnUnknownMethodIsAnsweredWithTheOneMeant) {
  put(folder / "a.bvh", hand_take());
  for (const char* command : {"clean", "methods"}) {
    const Ran ran = std::string(command) == "clean"
                        ? run({"clean", "a.bvh", "--method", "butterwort"})
                        : run({"methods", "butterwort"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, IsOneLine());
    EXPECT_THAT(ran.err, testing::HasSubstr("butterwort"));
    EXPECT_THAT(ran.err, testing::HasSubstr("did you mean butterworth?"));
  }
}

TEST_F(Usage, AJointThatIsNotThereIsNamedWithItsTake) {
  put(folder / "a.bvh", hand_take());
  const Ran ran = run({"clean", "a.bvh", "--joints", "Left*,Tail"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, testing::StartsWith("kinemend: a.bvh: no joint matches \"Tail\""));
  EXPECT_THAT(files(), testing::ElementsAre("a.bvh"));
}

TEST_F(Usage, TheLastOfSeveralValuesHolds) {
  noisy("a.bvh");
  ASSERT_EQ(run({"clean", "a.bvh", "-o", "b.bvh", "--strength", "0.5", "--strength", "0"}).code, 0);
  EXPECT_EQ(contents(folder / "a.bvh"), contents(folder / "b.bvh"));
}

}  // namespace
}  // namespace kinemend::test
