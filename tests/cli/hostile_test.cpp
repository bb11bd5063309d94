// Bad input gives one line with file and line, exit code 3, little memory, and no output. External
// JSON that is nested deeply enough to exhaust the stack is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include "cli/program.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::test {
namespace {

using testing::HasSubstr;

// Sanitizers need memory of their own.
#if defined(KINEMEND_SANITIZED)
constexpr long memory_limit_kilobytes = 800 * 1024;
#else
constexpr long memory_limit_kilobytes = 50 * 1024;
#endif

class Hostile : public Program {
 protected:
  void expect_refused(const std::string& name) {
    const Ran ran = run({"clean", name, "--output-dir", "out", "--report", "report.json"});
    EXPECT_EQ(ran.code, 3) << name << ": " << ran.err;
    EXPECT_EQ(ran.out, "") << name;
    EXPECT_THAT(ran.err, IsOneLine()) << name;
    EXPECT_THAT(ran.err, testing::MatchesRegex("kinemend: " + name + ":[0-9]+: .*\n"));
    EXPECT_LT(ran.err.size(), 400u) << name;
    EXPECT_LT(ran.peak_kilobytes, memory_limit_kilobytes) << name;
    EXPECT_THAT(files(), testing::ElementsAre(name)) << name;
    fs::remove(folder / name);
  }
};

std::string header(const std::string& frames) {
  return "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n}\nMOTION\n"
         "Frames: " +
         frames + "\nFrame Time: 0.01\n";
}

TEST_F(Hostile, TruncatedFilesAreRefused) {
  const std::string whole = hand_take();
  for (const std::size_t length : {1, 9, 40, 200, 500}) {
    put(folder / "cut.bvh", whole.substr(0, length));
    expect_refused("cut.bvh");
  }
}

TEST_F(Hostile, BinaryFilesAreRefused) {
  Random random(1);
  std::string noise(8 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.next() & 0xFF);
  put(folder / "noise.bvh", noise);
  expect_refused("noise.bvh");
  put(folder / "zeros.bvh", std::string(8 << 20, '\0'));
  expect_refused("zeros.bvh");
}

TEST_F(Hostile, AnEmptyFileIsRefused) {
  put(folder / "empty.bvh", "");
  expect_refused("empty.bvh");
}

TEST_F(Hostile, AHugeCountAllocatesNothing) {
  for (const char* count : {"2000000000", "9007199254740991"}) {
    put(folder / "huge.bvh", header(count) + "1 2 3\n");
    expect_refused("huge.bvh");
  }
}

TEST_F(Hostile, FilesWithoutANumberAreRefused) {
  std::string text = header("50000");
  for (int f = 0; f < 50000; ++f) text += "nan nan nan\n";
  put(folder / "nan.bvh", text);
  expect_refused("nan.bvh");
}

TEST_F(Hostile, DeepNestingIsRefused) {
  std::string text = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 0\n";
  for (int i = 0; i < 200000; ++i) text += "JOINT j\n{\nOFFSET 0 0 0\nCHANNELS 0\n";
  put(folder / "deep.bvh", text);
  expect_refused("deep.bvh");
}

TEST_F(Hostile, MismatchedColumnsAreRefused) {
  put(folder / "columns.bvh", header("3") + "1 2 3\n4 5\n6 7 8\n");
  expect_refused("columns.bvh");
}

TEST_F(Hostile, EveryBadFixtureIsRefused) {
  const fs::path fixtures = fs::path(KINEMEND_TEST_FIXTURES) / "bvh/bad";
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fixtures)) {
    names.push_back(entry.path().filename().string());
    fs::copy_file(entry.path(), folder / names.back());
  }
  ASSERT_GT(names.size(), 20u);
  std::vector<std::string> words = {"clean"};
  words.insert(words.end(), names.begin(), names.end());
  words.insert(words.end(), {"--output-dir", "out"});
  const Ran ran = run(words);
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(lines_of(ran.err).size(), names.size() + 1) << ran.err;
  EXPECT_LT(ran.peak_kilobytes, memory_limit_kilobytes);
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(Hostile, EveryOddButUsableFixtureIsCleaned) {
  const fs::path fixtures = fs::path(KINEMEND_TEST_FIXTURES) / "bvh/good";
  std::vector<std::string> words = {"clean", "--output-dir", "out"};
  for (const auto& entry : fs::directory_iterator(fixtures)) words.push_back(entry.path().string());
  ASSERT_GT(words.size(), 20u);
  const Ran ran = run(words);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(files().size(), words.size() - 2);
}

TEST_F(Hostile, NamesInAFileCannotCommandTheTerminal) {
  put(folder / "a.bvh", replaced(hand_take(), "LeftArm", "Arm\x1b[2J\xE2\x80\xAE\xC3\xA4\xFF"));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"info", "a.bvh", "--tree"},
           {"check", "a.bvh", "--verbose"},
           {"clean", "a.bvh", "-o", "out.bvh", "--method", "gaussian", "--verbose"},
           {"clean", "a.bvh", "-o", "other.bvh", "--joints", "Leg"}}) {
    const Ran ran = run(words);
    const std::string said = ran.out + ran.err;
    EXPECT_THAT(said, testing::HasSubstr("Arm\\x1b[2J\\u202e\xC3\xA4\\xff")) << words[0];
    EXPECT_EQ(said.find('\x1b'), said.npos) << words[0];
    EXPECT_EQ(said.find("\xE2\x80\xAE"), said.npos) << words[0];
  }
}

TEST_F(Hostile, LongNamesInSideFilesAreCut) {
  put(folder / "a.bvh", hand_take());
  std::string blanks;
  for (int i = 0; i < 300000; ++i) blanks += "ab ";
  for (const char* flag : {"--gaps", "--map", "--noise", "--config", "--contacts"}) {
    put(folder / "side", blanks + ",1,2\n");
    const Ran ran = run({"clean", "a.bvh", "-o", "out.bvh", flag, "side", "--feet"});
    EXPECT_NE(ran.code, 0) << flag;
    EXPECT_THAT(ran.err, IsOneLine()) << flag;
    EXPECT_LT(ran.err.size(), 2100u) << flag;
  }
}

TEST_F(Hostile, ANulInANameDoesNotEndTheMessage) {
  put(folder / "a.bvh", hand_take());
  put(folder / "side", std::string("Le\0ft,1,2\n", 10));
  const Ran ran = run({"clean", "a.bvh", "-o", "out.bvh", "--gaps", "side"});
  EXPECT_NE(ran.code, 0);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, testing::HasSubstr("Le\\x00ft"));
}

TEST_F(Hostile, AHostileConfigurationIsRefused) {
  put(folder / "a.bvh", hand_take());
  put(folder / "deep.toml", "joints = " + std::string(100000, '['));
  const Ran ran = run({"clean", "a.bvh", "--config", "deep.toml"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_THAT(ran.err, testing::StartsWith("kinemend: deep.toml:1: "));
  EXPECT_LT(ran.peak_kilobytes, memory_limit_kilobytes);
}

class JsonDepth : public Program {
 protected:
  static std::string nested(const std::string& before) {
    return before + std::string(1'000'000, '[') + std::string(1'000'000, ']') + "}";
  }
};

TEST_F(JsonDepth, APlanAndAReportThatAreNestedDeeplyAreRefused) {
  synth("walk.bvh");
  put(folder / "deep.json", nested(R"({"schema": "kinemend.gap-plan/1", "gaps": )"));
  const Ran fill = run({"fill", "walk.bvh", "--plan", "deep.json", "-o", "filled.bvh"});
  EXPECT_EQ(fill.code, 3);
  EXPECT_EQ(fill.err, "kinemend: deep.json:1: JSON is nested more than 64 levels deep\n");
  put(folder / "report.json", nested(R"({"takes": )"));
  const Ran clean = run({"clean", "walk.bvh", "--noise", "report.json", "-o", "cleaned.bvh"});
  EXPECT_NE(clean.code, 0);
  EXPECT_LT(clean.code, 128) << "a signal ended it";
  EXPECT_THAT(clean.err, HasSubstr("report.json"));
}

TEST_F(JsonDepth, ARecordOfABatchThatIsNestedDeeplyIsMadeAgain) {
  fs::create_directory(folder / "raw");
  synth("raw/walk.bvh");
  ASSERT_EQ(run({"batch", "raw", "-o", "out", "--quiet"}).code, 0);
  int records = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
    if (entry.path().extension() != ".json") continue;
    put(entry.path(), nested(R"({"row": )"));
    ++records;
  }
  ASSERT_GT(records, 0);
  const Ran again = run({"batch", "raw", "-o", "out", "--quiet", "--force"});
  EXPECT_EQ(again.code, 0) << again.err;
}

}  // namespace
}  // namespace kinemend::test
