// Help, manual page and completions list every option that the parser accepts.
#include <functional>
#include <regex>
#include <set>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Help = Program;
using testing::HasSubstr;

const std::vector<std::string> commands = {
    "clean", "batch",  "fill",    "info",    "check", "contacts",   "compare", "methods",
    "train", "models", "convert", "corrupt", "synth", "completion", "man",     "help"};

/// Collects every `--name` in a help text; `--[no-]name` gives two.
std::set<std::string> options_in(const std::string& help) {
  std::set<std::string> names;
  const std::regex entry("(?:^|\\n)  (?:-[a-zA-Z], |    )--(\\[no-\\])?([a-z][a-z0-9-]*)");
  for (std::sregex_iterator hit(help.begin(), help.end(), entry), end; hit != end; ++hit) {
    names.insert("--" + (*hit)[2].str());
    if ((*hit)[1].matched) names.insert("--no-" + (*hit)[2].str());
  }
  names.insert("--help");
  return names;
}

/// Options of a command, including those that `kinemend help NAME` explains.
std::set<std::string> options_of_command(const std::string& command,
                                         const std::function<std::string(std::string)>& help_of) {
  const std::string help = help_of(command);
  std::set<std::string> options = options_in(help);
  const std::size_t names = help.find(" NAME:\n");
  if (names == std::string::npos) return options;
  const std::string list = help.substr(names + 7, help.find(".\n", names) - names - 7);
  const std::regex word("[a-z0-9-]+");
  const bool are_flags = command == "clean" || command == "batch";
  for (std::sregex_iterator hit(list.begin(), list.end(), word), end; hit != end && are_flags;
       ++hit) {
    const std::string text = help_of(hit->str());
    options.merge(options_in(text.substr(0, text.find("Page:"))));
  }
  return options;
}

TEST_F(Help, BothLevelsExistForEveryCommand) {
  for (const std::string& command : commands) {
    const Ran brief = run({command, "-h"}), full = run({command, "--help"});
    EXPECT_EQ(brief.code, 0);
    EXPECT_EQ(full.code, 0);
    EXPECT_EQ(brief.err + full.err, "");
    EXPECT_THAT(brief.out, testing::StartsWith("kinemend " + command + ": "));
    // The brief form describes each damage or method; the long form also lists their options.
    EXPECT_GE(options_in(full.out).size(), options_in(brief.out).size()) << command;
    EXPECT_EQ(run({"help", command}).out, full.out);
  }
  const Ran program = run({"--help"});
  EXPECT_EQ(program.code, 0);
  for (const std::string& command : commands) EXPECT_THAT(program.out, HasSubstr("\n  " + command));
  EXPECT_THAT(program.out, HasSubstr("Exit codes:"));
}

TEST_F(Help, TheVersionIsPrinted) {
  for (const char* word : {"--version", "-V"})
    EXPECT_THAT(run({word}).out, testing::MatchesRegex("kinemend [0-9]+\\.[0-9]+\\.[0-9]+\n"
                                                       "built with .*, running on .*\n"
                                                       "learned models: .*wiener.*\n"
                                                       "licence: Apache 2.0\n"));
}

TEST_F(Help, TheHelpOfAMethodHoldsItsOptionsAndItsPage) {
  const Json list = Json::parse(run({"methods", "--json"}).out)["methods"];
  ASSERT_FALSE(list.empty());
  for (const Json& method : list) {
    const std::string method_name = method["name"];
    const std::string help = run({"help", method_name}).out;
    const std::set<std::string> options = options_in(help);
    for (const Json& option : method["options"]) {
      std::string name = option["name"];
      std::replace(name.begin(), name.end(), '_', '-');
      EXPECT_TRUE(options.count("--" + name)) << method_name << " " << name;
    }
    EXPECT_THAT(help, HasSubstr("Page: docs/methods/" + method_name + ".md\n"));
  }
  EXPECT_THAT(std::regex_replace(run({"help", "butterworth"}).out, std::regex("\\s+"), " "),
              HasSubstr("half of the frame rate (0.05 to 500 Hz; default 8)"));
}

TEST_F(Help, TheHelpOfACommandIsShortAndSaysHowToSeeTheOptionsOfAMethod) {
  for (const std::string command : {"clean", "batch", "fill", "stream", "corrupt", "train"}) {
    const std::string help = run({command, "--help"}).out;
    EXPECT_LT(lines_of(help).size(), 140u) << command;
    EXPECT_THAT(help, HasSubstr("type: kinemend help ")) << command;
  }
  const std::string help = run({"clean", "--help"}).out;
  EXPECT_THAT(help, HasSubstr("bilateral"));
  EXPECT_THAT(help, Not(HasSubstr("--sigma-t-s")));
}

TEST_F(Help, EveryHeadingAppearsOnce) {
  for (const std::string& command : commands) {
    for (const char* level : {"-h", "--help"}) {
      std::set<std::string> headings;
      for (const std::string& line : lines_of(run({command, level}).out)) {
        if (line.empty() || line.front() == ' ' || line.back() != ':') continue;
        EXPECT_TRUE(headings.insert(line).second) << command << " " << level << ": " << line;
      }
    }
  }
}

TEST_F(Help, NoOptionOfAMethodIsAnOptionOfCleanItself) {
  const std::set<std::string> own = options_in(run({"clean", "-h"}).out);
  const Json list = Json::parse(run({"methods", "--json"}).out)["methods"];
  ASSERT_FALSE(own.empty());
  ASSERT_FALSE(list.empty());
  for (const Json& method : list) {
    for (const Json& option : method["options"]) {
      std::string name = option["name"];
      std::replace(name.begin(), name.end(), '_', '-');
      EXPECT_TRUE(name == "seed" || !own.count("--" + name)) << name;
    }
  }
}

TEST_F(Help, NoLineIsWiderThanATerminal) {
  for (const std::string& command : commands) {
    const std::vector<std::string> lines = lines_of(run({command, "-h"}).out);
    EXPECT_GT(lines.size(), 5u) << command;
    for (const std::string& line : lines) EXPECT_LE(line.size(), 100u) << command << ": " << line;
  }
}

TEST_F(Help, TheManualPageHoldsEveryOption) {
  const std::string page = replaced(run({"man"}).out, "\\-", "-");
  const auto help_of = [&](const std::string& name) { return run({"help", name}).out; };
  EXPECT_THAT(page, testing::StartsWith(".TH KINEMEND 1"));
  for (const std::string& command : commands) {
    EXPECT_THAT(page, HasSubstr(".SH \"KINEMEND " + command + "\""));
    for (const std::string& name : options_of_command(command, help_of)) {
      const bool is_no = name.rfind("--no-", 0) == 0;
      if (name == "--help") continue;
      const std::string shown = is_no ? "--[no-]" + name.substr(5) : name;
      EXPECT_TRUE(page.find(shown) != std::string::npos ||
                  page.find("--[no-]" + name.substr(2)) != std::string::npos)
          << command << " " << name;
    }
  }
  EXPECT_THAT(run({"help", "gaussian"}).out, HasSubstr("std_deg=X"));
  EXPECT_THAT(page, HasSubstr("std_deg=X"));
}

TEST_F(Help, EveryCompletionHoldsEveryOption) {
  const auto help_of = [&](const std::string& name) { return run({"help", name}).out; };
  for (const std::string shell : {"bash", "zsh", "fish"}) {
    const Ran script = run({"completion", shell});
    ASSERT_EQ(script.code, 0);
    for (const std::string& command : commands) {
      for (const std::string& name : options_of_command(command, help_of)) {
        const std::string as_written = shell == "fish" ? "-l " + name.substr(2) : name;
        EXPECT_THAT(script.out, HasSubstr(as_written)) << shell << " " << command;
      }
    }
  }
}

TEST_F(Help, BashCompletesOptionsAndTheirValues) {
  put(folder / "kinemend.bash", run({"completion", "bash"}).out);
  put(folder / "try.bash",
      ". ./kinemend.bash\n"
      "complete_words() { COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _kinemend; "
      "echo \"${COMPREPLY[*]}\"; }\n"
      "complete_words kinemend cl\n"
      "complete_words kinemend clean --cutoff\n"
      "complete_words kinemend clean --method butter\n"
      "complete_words kinemend clean -m one\n"
      "complete_words kinemend clean --preset bio\n"
      "complete_words kinemend methods wei\n"
      "complete_words kinemend synth pun\n"
      "complete_words kinemend clean --config kinemend.b\n"
      "complete_words kinemend clean --model kinemend.b\n"
      "complete_words kinemend clean --model velo\n"
      "complete_words kinemend train wien\n"
      "complete_words kinemend train wiener kinemend.b\n");
  const fs::path out = folder / "said";
  const std::string command = "cd '" + folder.string() + "' && bash --norc try.bash > said 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(contents(out),
            "clean\n--cutoff-hz\nbutterworth\none-euro\nbiomech\nweighted-mean\npunch\n"
            "kinemend.bash\nkinemend.bash\nvelocity\nwiener\nkinemend.bash\n");
}

}  // namespace
}  // namespace kinemend::test
