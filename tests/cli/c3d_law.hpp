// A command keeps everything in a C3D file, or names what it loses in a warning.
#pragma once

#include <set>

#include "cli/program.hpp"

namespace kinemend::test {

class C3dLaw : public Program {
 protected:
  Json info(const std::string& take) {
    const Ran ran = run({"info", take, "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out).at("takes").at(0);
  }

  /// Runs `words`, which write `out.c3d`, with and without --strict. Analog channels, force plates,
  /// events, subjects and rotations of the take are kept, or a warning names them; then --strict
  /// refuses and writes nothing.
  void expect_lawful(const std::string& take, std::vector<std::string> words) {
    SCOPED_TRACE(take + ": " + words.front() + " " + words.back());
    fs::remove(folder / "out.c3d");
    words.insert(words.begin() + 1, take);
    words.insert(words.end(), {"-o", "out.c3d"});
    const Ran ran = run(words);
    // The option does not apply, for example because the file states no unit.
    if (ran.code == 2) {
      EXPECT_FALSE(fs::exists(folder / "out.c3d"));
      return;
    }
    ASSERT_EQ(ran.code, 0) << ran.err;
    const bool named = ran.err.find(" left out") != std::string::npos ||
                       ran.err.find(" repeated") != std::string::npos;
    const Json before = info(take), after = info("out.c3d");
    bool same = before.at("events").size() == after.at("events").size();
    for (const char* const fact : {"analog", "force plates", "subjects", "rotations"})
      same = same && before.at("facts").value(fact, "") == after.at("facts").value(fact, "");
    EXPECT_TRUE(same || named) << after.at("facts");
    if (!named) return;
    words.push_back("--strict");
    fs::remove(folder / "out.c3d");
    EXPECT_EQ(run(words).code, 1);
    EXPECT_FALSE(fs::exists(folder / "out.c3d"));
  }

  void expect_lawful_in_every_option(const std::string& take) {
    const std::vector<std::vector<std::string>> all{{"convert", "--unit", "mm"},
                                                    {"convert", "--unit", "m"},
                                                    {"convert", "--up", "y"},
                                                    {"convert", "--from-up", "z", "--up", "x"},
                                                    {"convert", "--fps", "25"},
                                                    {"convert", "--fps", "100"},
                                                    {"convert", "--up", "z", "--floor-at-zero"},
                                                    {"convert", "--plain"},
                                                    {"convert", "--to", "c3d"},
                                                    {"clean"},
                                                    {"clean", "--strength", "0.5"},
                                                    {"fill"}};
    for (const auto& words : all) ASSERT_NO_FATAL_FAILURE(expect_lawful(take, words));
  }
};

}  // namespace kinemend::test
