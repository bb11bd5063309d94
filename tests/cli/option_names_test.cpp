// An option has the same name and letter in every command, and its earlier names still work.
#include <map>
#include <set>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using OptionNames = Program;
using testing::HasSubstr;
using testing::Not;

const std::vector<std::string> all_commands = {
    "clean", "batch", "fill",    "stream", "info",   "check",   "contacts", "compare",
    "view",  "plot",  "methods", "train",  "models", "convert", "corrupt",  "synth"};

TEST_F(OptionNames, LettersMeanTheSameInEveryCommand) {
  const std::map<char, std::set<std::string>> meant = {{'o', {"--output", "--output-dir"}},
                                                       {'q', {"--quiet"}},
                                                       {'v', {"--verbose"}},
                                                       {'m', {"--method"}},
                                                       {'j', {"--jobs"}},
                                                       {'h', {"--help"}}};
  for (const std::string& command : all_commands) {
    const std::string help = run({command, "-h"}).out;
    for (const std::string& line : lines_of(help)) {
      if (line.size() < 8 || line.substr(0, 3) != "  -" || line[4] != ',') continue;
      const std::string name = line.substr(6, line.find(' ', 6) - 6);
      const auto known = meant.find(line[3]);
      ASSERT_NE(known, meant.end()) << command << line;
      EXPECT_EQ(known->second.count(name), 1u) << command << line;
    }
    for (const char* name : {"--quiet", "--verbose", "--method", "--jobs"}) {
      if (help.find(std::string(" ") + name) == std::string::npos) continue;
      EXPECT_THAT(help, HasSubstr(std::string("  -") + name[2] + ", " + name)) << command;
    }
    if (help.find("--quiet ") != std::string::npos) {
      EXPECT_THAT(help, HasSubstr("print warnings and errors only")) << command;
    }
    if (help.find("--strict ") != std::string::npos) {
      EXPECT_THAT(help, HasSubstr("--strict                a repair or a warning becomes an error"))
          << command;
    }
  }
}

TEST_F(OptionNames, JointsAndMarkersAreChosenByTheSameNameEverywhere) {
  for (const char* command : {"clean", "batch", "fill", "train", "plot"}) {
    const std::string help = run({command, "-h"}).out;
    EXPECT_THAT(help, HasSubstr("--joints ")) << command;
    EXPECT_THAT(help, HasSubstr("--markers ")) << command;
    EXPECT_THAT(help, Not(HasSubstr("--names "))) << command;
  }
}

TEST_F(OptionNames, EarlierNamesStillWork) {
  put(folder / "a.bvh", hand_take());
  put(folder / "gaps.csv", "LeftArm,4,5\nLeftFinger1,7,8\n");
  std::vector<std::string> filled;
  for (const char* name : {"--names", "--joints", "--markers"}) {
    ASSERT_EQ(
        run({"fill", "a.bvh", "--gaps", "gaps.csv", name, "LeftArm", "-o", "out.bvh", "--force"})
            .code,
        0)
        << name;
    filled.push_back(contents(folder / "out.bvh"));
  }
  EXPECT_EQ(filled[0], filled[1]);
  EXPECT_EQ(filled[0], filled[2]);
  EXPECT_EQ(run({"plot", "a.bvh", "-o", "-", "--track", "LeftArm"}).out,
            run({"plot", "a.bvh", "-o", "-", "--joints", "LeftArm"}).out);
  EXPECT_THAT(run({"plot", "a.bvh", "-o", "-", "--joints", "LeftArm,Hips"}).err,
              HasSubstr("take one name"));
  EXPECT_EQ(run({"compare", "a.bvh", "a.bvh", "--per-joint"}).out,
            run({"compare", "a.bvh", "a.bvh", "-v"}).out);
  EXPECT_EQ(run({"compare", "a.bvh", "a.bvh", "-q"}).out, "");
  EXPECT_THAT(run({"fill", "a.bvh", "--names", "LeftArm", "Tail"}).err,
              HasSubstr("separate names by commas, as in --names LeftArm,Tail"));
  fs::create_directory(folder / "raw");
  put(folder / "raw/a.bvh", hand_take());
  EXPECT_EQ(run({"batch", "raw", "--output", "out", "-q"}).code, 0);
}

TEST_F(OptionNames, HelpNamesValuesAndDefaultsForPeople) {
  EXPECT_THAT(run({"stream", "-h"}).out, HasSubstr("--status PORT "));
  EXPECT_THAT(run({"view", "-h"}).out, HasSubstr("--port PORT "));
  EXPECT_THAT(run({"help", "example"}).out, HasSubstr("; default 0.667"));
}

TEST_F(OptionNames, NothingIsSuggestedThatIsNotNear) {
  put(folder / "a.bvh", hand_take());
  EXPECT_EQ(run({"clean", "a.bvh", "--feet=on"}).err,
            "kinemend: --feet: \"on\" is not one of off, auto, force\n");
  EXPECT_EQ(run({"undo"}).err, "kinemend: unknown command undo (see kinemend -h)\n");
  EXPECT_THAT(run({"clean", "a.bvh", "--feet=of"}).err, HasSubstr("did you mean off?"));
  EXPECT_THAT(run({"celan"}).err, HasSubstr("did you mean clean?"));
}

}  // namespace
}  // namespace kinemend::test
