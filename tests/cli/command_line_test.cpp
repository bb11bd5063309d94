// Tests of the command line: words are understood as meant, or refused with a reason. An option has
// the same name and letter in every command, and its earlier names still work.
#include <map>
#include <set>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using CommandLine = Program;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

TEST_F(CommandLine, ConvertTakesItsOutputAsASecondWordToo) {
  put(folder / "a.bvh", hand_take());
  ASSERT_EQ(run({"convert", "a.bvh", "word.csv"}).code, 0);
  ASSERT_EQ(run({"convert", "a.bvh", "-o", "option.csv"}).code, 0);
  EXPECT_EQ(contents(folder / "word.csv"), contents(folder / "option.csv"));
  EXPECT_EQ(run({"convert", "a.bvh", "word.csv"}).code, 4) << "what exists stays";
  const Ran both = run({"convert", "a.bvh", "x.csv", "-o", "y.csv"});
  EXPECT_EQ(both.code, 2);
  EXPECT_EQ(both.err, "kinemend: convert: x.csv and --output y.csv are two outputs; give one\n");
  const Ran none = run({"convert", "a.bvh"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err, "kinemend: convert: OUT is missing (see kinemend convert -h)\n");
}

TEST_F(CommandLine, TwoDashesEndTheOptionsOfEveryCommand) {
  put(folder / "-a.bvh", hand_take());
  put(folder / "--json", hand_take());
  for (const std::vector<std::string>& words : {std::vector<std::string>{"info", "--", "-a.bvh"},
                                                {"info", "--tree", "--", "-a.bvh", "--json"},
                                                {"check", "--", "-a.bvh"},
                                                {"clean", "--dry-run", "--", "-a.bvh"},
                                                {"fill", "--dry-run", "--", "-a.bvh"},
                                                {"compare", "--", "-a.bvh", "--json"},
                                                {"contacts", "--", "-a.bvh"},
                                                {"convert", "-o", "-", "--", "-a.bvh"},
                                                {"methods", "--", "auto"},
                                                {"batch", "-o", "out", "--", "-a.bvh"}}) {
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << words[0] << ": " << ran.err;
  }
  EXPECT_TRUE(fs::exists(folder / "out/-a.bvh"));
  EXPECT_THAT(run({"info", "--", "-o"}).err, HasSubstr("-o: No such file"));
}

TEST_F(CommandLine, HelpTellsOfEveryCommandMethodDamageAndTopic) {
  const Json methods = Json::parse(run({"methods", "--json"}).out)["methods"];
  for (const Json& method : methods) {
    const Ran ran = run({"help", method["name"]});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr(" --method " + method["name"].get<std::string>()));
    for (const Json& option : method["options"]) {
      std::string name = option["name"];
      std::replace(name.begin(), name.end(), '_', '-');
      EXPECT_THAT(ran.out, HasSubstr(name)) << method["name"];
    }
  }
  for (const char* topic : {"frames", "names", "formats", "presets", "gaps", "exit-codes"}) {
    EXPECT_THAT(run({"help", topic}).out, HasSubstr("kinemend, " + std::string(topic) + ": "));
    EXPECT_THAT(run({"help"}).out, HasSubstr("\n  " + std::string(topic)));
    EXPECT_THAT(run({"man"}).out, HasSubstr("TOPICS"));
  }
  EXPECT_THAT(run({"help", "rigid-body"}).out, HasSubstr("kinemend fill --method rigid-body"));
  EXPECT_THAT(run({"help", "outliers"}).out, HasSubstr("kinemend corrupt --damage outliers"));
  const std::string gaussian = run({"help", "gaussian"}).out;
  EXPECT_THAT(gaussian, HasSubstr("kinemend clean, batch, stream --method gaussian"));
  EXPECT_THAT(gaussian, HasSubstr("kinemend corrupt --damage gaussian"));
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
}

TEST_F(CommandLine, HelpForAnUnknownNameFailsWithTheNearest) {
  const Ran near = run({"help", "buterworth"});
  EXPECT_EQ(near.code, 2);
  EXPECT_EQ(near.out, "");
  EXPECT_EQ(near.err,
            "kinemend: help: unknown command, method or topic buterworth (did you mean "
            "butterworth?)\n");
  const Ran far = run({"help", "xyzzy-plugh"});
  EXPECT_EQ(far.code, 2);
  EXPECT_EQ(far.err,
            "kinemend: help: unknown command, method or topic xyzzy-plugh (see kinemend help)\n");
  EXPECT_EQ(run({"help", "clean", "twice"}).code, 2);
}

TEST_F(CommandLine, NamesBehindAListAreToldFromInputs) {
  put(folder / "a.bvh", hand_take());
  put(folder / "LeftFinger1", hand_take());
  const auto message = [](const std::string& command, const std::string& flag) {
    return "kinemend: " + command + ": LeftFinger2 after " + flag +
           " is neither a file nor part of the list; separate names by commas, as in " + flag +
           " LeftArm,LeftFinger2 (see kinemend " + command + " -h)\n";
  };
  for (const auto& [command, flag] :
       std::vector<std::pair<std::string, std::string>>{{"clean", "--joints"},
                                                        {"clean", "--exclude"},
                                                        {"clean", "--markers"},
                                                        {"fill", "--joints"},
                                                        {"batch", "--joints"},
                                                        {"train", "--joints"}}) {
    const Ran ran = run({command, "a.bvh", flag, "LeftArm", "LeftFinger2"});
    EXPECT_EQ(ran.code, 2) << command;
    EXPECT_EQ(ran.err, message(command, flag));
    EXPECT_EQ(run({command, "a.bvh", flag + "=LeftArm", "LeftFinger2"}).err,
              message(command, flag));
  }
  EXPECT_EQ(run({"clean", "--dry-run", "--joints", "LeftArm", "LeftFinger1"}).code, 0)
      << "a file of such a name is an input";
  EXPECT_THAT(run({"clean", "--joints", "LeftArm", "b.bvh"}).err, HasSubstr("b.bvh: No such file"));
}

TEST_F(CommandLine, NamesOfListsAreKnownInAnyCapitals) {
  put(folder / "a.bvh", hand_take());
  EXPECT_EQ(run({"clean", "a.bvh", "--dry-run", "--method", "Butterworth"}).code, 0);
  EXPECT_EQ(run({"methods", "AUTO"}).out, run({"methods", "auto"}).out);
  EXPECT_EQ(run({"help", "Frames"}).out, run({"help", "frames"}).out);
  EXPECT_EQ(run({"info", "a.bvh", "--from", "BVH"}).code, 0);
}

/// Tests every option of a command that names an output file beside `-o`.
TEST_F(CommandLine, NoTwoOutputsAreOneFileUnderAnyOfItsNames) {
  noisy("a.bvh", "1");
  synth("b.bvh", "walk", "2");
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  fs::create_directory(folder / "deep");
  const auto before = files();
  const std::vector<std::vector<std::string>> commands = {
      {"clean", "a.bvh", "-o", "x", "--report"},
      {"clean", "a.bvh", "-o", "x", "--dry-run", "--report"},
      {"fill", "a.bvh", "--gaps", "gaps.csv", "-o", "x", "--report"},
      {"fill", "a.bvh", "--gaps", "gaps.csv", "-o", "x", "--dry-run", "--report"},
      {"train", "wiener", "b.bvh", "-o", "x", "--card"}};
  for (const std::vector<std::string>& command : commands) {
    for (const std::string& name : {std::string("x"), std::string("./x"), std::string("deep/../x"),
                                    (folder / "x").string()}) {
      std::vector<std::string> words = command;
      words.push_back(name);
      words.push_back("--force");
      const Ran ran = run(words);
      EXPECT_EQ(ran.code, 2) << command[0] << " " << name << ": " << ran.err;
      EXPECT_THAT(ran.err, HasSubstr("would be lost")) << command[0] << " " << name;
      EXPECT_EQ(files(), before) << command[0] << " " << name;
    }
  }
}

TEST_F(CommandLine, ADryRunWritesItsReportAndNothingElse) {
  noisy("a.bvh");
  put(folder / "gaps.csv", "LeftArm,20,22\n");
  ASSERT_EQ(run({"clean", "a.bvh", "--dry-run", "--report", "clean.json"}).code, 0);
  ASSERT_EQ(run({"fill", "a.bvh", "--gaps", "gaps.csv", "--dry-run", "--report", "fill.json"}).code,
            0);
  EXPECT_THAT(files(), ElementsAre("a.bvh", "clean.json", "fill.json", "gaps.csv", "truth.bvh"));
  const Json clean = Json::parse(contents(folder / "clean.json"))["takes"][0];
  EXPECT_TRUE(clean["output"].is_null());
  EXPECT_FALSE(clean["findings"].empty());
  const Json fill = Json::parse(contents(folder / "fill.json"))["takes"][0];
  EXPECT_TRUE(fill["output"].is_null());
  EXPECT_EQ(fill["findings"].size(), 1u);
  EXPECT_EQ(run({"clean", "a.bvh", "--dry-run", "--report", "clean.json"}).code, 4) << "exists";
  EXPECT_EQ(run({"clean", "a.bvh", "--dry-run", "--report", "a.bvh", "--force"}).code, 2);
}

TEST_F(CommandLine, FromOffersOnlyWhatIsReadAndToOnlyWhatIsWritten) {
  put(folder / "a.bvh", hand_take());
  const auto choices = [&](const std::string& option) {
    const Ran ran = run({"convert", "a.bvh", "b.bvh", option, "zzzzzzzz"});
    EXPECT_EQ(ran.code, 2);
    return ran.err;
  };
  EXPECT_THAT(choices("--from"), HasSubstr("glb"));
  EXPECT_THAT(choices("--to"), HasSubstr("glb"));
  const std::string help = run({"info", "-h"}).out;
  EXPECT_THAT(help, HasSubstr("--from bvh|"));
  EXPECT_THAT(help, HasSubstr("|glb|gltf"));
}

TEST_F(CommandLine, BashCompletesValuesBehindAnEqualsSignAndNamesOfHelp) {
  put(folder / "kinemend.bash", run({"completion", "bash"}).out);
  put(folder / "try.bash",
      ". ./kinemend.bash\n"
      "complete_words() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _kinemend; "
      "echo \"${COMPREPLY[*]}\"; }\n"
      // The first form is how bash splits words; the second is without = in COMP_WORDBREAKS.
      "complete_words kinemend clean --method = butter\n"
      "complete_words kinemend clean --method=butter\n"
      "complete_words kinemend clean --preset =\n"
      "complete_words kinemend clean --config = try\n"
      "complete_words kinemend help butter\n"
      "complete_words kinemend help fra\n"
      "complete_words kinemend help corr\n"
      "complete_words kinemend he\n"
      "complete_words kinemend info --from gl\n"
      "complete_words kinemend convert --to gl\n");
  const std::string command = "cd '" + folder.string() + "' && bash --norc try.bash > said 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(contents(folder / "said"),
            "butterworth\n--method=butterworth\nlive biomech\ntry.bash\n"
            "butterworth\nframes\ncorrupt\nhelp\nglb gltf\nglb gltf\n");
}

TEST_F(CommandLine, OtherShellsCompleteValuesBehindAnEqualsSignToo) {
  const std::string zsh = run({"completion", "zsh"}).out;
  EXPECT_THAT(zsh, HasSubstr("'*--method=["));
  EXPECT_THAT(zsh, HasSubstr("    help)\n"));
  const std::string fish = run({"completion", "fish"}).out;
  EXPECT_THAT(fish, testing::ContainsRegex("__fish_seen_subcommand_from help' -a '[^\n]*frames"));
}

using OptionNames = Program;

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
            "kinemend: --feet: \"on\" is not one of by-source, off, auto, force\n");
  EXPECT_EQ(run({"undo"}).err, "kinemend: unknown command undo (see kinemend -h)\n");
  EXPECT_THAT(run({"clean", "a.bvh", "--feet=of"}).err, HasSubstr("did you mean off?"));
  EXPECT_THAT(run({"celan"}).err, HasSubstr("did you mean clean?"));
}

}  // namespace
}  // namespace kinemend::test
