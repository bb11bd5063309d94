// Tests of `kinemend batch`: a tree of takes, resumed runs, shards, failing takes, and inputs and
// earlier results, which it must not overwrite.
#include <signal.h>
#include <chrono>
#include <map>
#include <random>
#include <set>
#include <thread>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class Batch : public Program {
 protected:
  /// Writes raw/a.bvh, raw/deep/b.bvh, ...: `count` noisy takes, all different.
  void make_tree(int count) {
    fs::create_directories(folder / "raw/deep");
    synth("truth.bvh", "walk", "0.4");
    for (int i = 0; i < count; ++i) {
      const std::string name = std::string(i % 2 ? "raw/deep/" : "raw/") + char('a' + i) + ".bvh";
      const Ran ran = run({"corrupt", "truth.bvh", "-o", name, "--damage", "gaussian:std_deg=1.5",
                           "--seed", std::to_string(i + 1)});
      ASSERT_EQ(ran.code, 0) << ran.err;
    }
  }

  /// The bytes of each take below a folder, by path.
  std::map<std::string, std::string> takes(const std::string& name) const {
    std::map<std::string, std::string> result;
    if (!fs::exists(folder / name)) return result;
    for (const auto& entry : fs::recursive_directory_iterator(folder / name)) {
      if (entry.path().extension() == ".bvh")
        result[fs::relative(entry.path(), folder / name).string()] = contents(entry.path());
    }
    return result;
  }

  std::vector<Json> rows(const std::string& file) const {
    std::vector<Json> result;
    for (const std::string& line : lines_of(contents(folder / file)))
      result.push_back(Json::parse(line));
    return result;
  }
};

TEST_F(Batch, MakesTheSameTreeAsCleaningEachTake) {
  make_tree(4);
  const Ran ran = run({"batch", "raw", "-o", "clean"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("4 cleaned, 0 done already, 0 failed"));
  const auto results = takes("clean");
  ASSERT_EQ(results.size(), 4u);
  for (const auto& [name, bytes] : results) {
    ASSERT_EQ(run({"clean", "raw/" + name, "-o", "alone.bvh", "--force"}).code, 0);
    EXPECT_EQ(bytes, contents(folder / "alone.bvh")) << name;
  }
}

TEST_F(Batch, WritesARowForEachTakeAndTheSums) {
  make_tree(3);
  ASSERT_EQ(run({"batch", "raw", "-o", "clean"}).code, 0);
  const std::vector<Json> table = rows("clean/rows.jsonl");
  ASSERT_EQ(table.size(), 3u);
  for (const Json& row : table) {
    EXPECT_EQ(row.at("status"), "cleaned");
    EXPECT_EQ(row.at("frames"), 24);
    EXPECT_FALSE(row.contains("tracks"));
  }
  const Json summary = Json::parse(contents(folder / "clean/summary.json")).at("figures");
  EXPECT_EQ(summary.at("takes"), 3);
  EXPECT_EQ(summary.at("cleaned"), 3);
  EXPECT_EQ(summary.at("frames"), 72);
  EXPECT_EQ(summary.at("to_do"), 0);
}

TEST_F(Batch, DoesNothingTheSecondTime) {
  make_tree(3);
  ASSERT_EQ(run({"batch", "raw", "-o", "clean"}).code, 0);
  const auto before = fs::last_write_time(folder / "clean/a.bvh");
  const auto first_rows = contents(folder / "clean/rows.jsonl");
  const Ran ran = run({"batch", "raw", "-o", "clean", "--jobs", "2"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.out, HasSubstr("0 cleaned, 3 done already, 0 failed"));
  EXPECT_EQ(fs::last_write_time(folder / "clean/a.bvh"), before);
  EXPECT_EQ(contents(folder / "clean/rows.jsonl"), first_rows);
}

TEST_F(Batch, DoesAgainWhatIsMissingOrHasChanged) {
  make_tree(4);
  ASSERT_EQ(run({"batch", "raw", "-o", "clean"}).code, 0);
  const auto reference = takes("clean");
  fs::remove(folder / "clean/a.bvh");
  put(folder / "clean/deep/b.bvh", "half a take");
  put(folder / "raw/c.bvh", contents(folder / "raw/deep/d.bvh"));
  const Ran ran = run({"batch", "raw", "-o", "clean"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("3 cleaned, 1 done already, 0 failed"));
  EXPECT_EQ(takes("clean").at("a.bvh"), reference.at("a.bvh"));
  EXPECT_EQ(takes("clean").at("deep/b.bvh"), reference.at("deep/b.bvh"));
  EXPECT_EQ(takes("clean").at("c.bvh"), reference.at("deep/d.bvh"));
}

TEST_F(Batch, DoesEverythingAgainWithOtherSettings) {
  make_tree(2);
  ASSERT_EQ(run({"batch", "raw", "-o", "clean"}).code, 0);
  const auto settings = {"--method", "gaussian"};
  std::vector<std::string> words = {"batch", "raw", "-o", "clean"};
  words.insert(words.end(), settings.begin(), settings.end());
  EXPECT_THAT(run(words).out, HasSubstr("2 cleaned, 0 done already"));
  EXPECT_THAT(run(words).out, HasSubstr("0 cleaned, 2 done already"));
  words.insert(words.end(), {"--width-s", "0.2"});
  EXPECT_THAT(run(words).out, HasSubstr("2 cleaned, 0 done already"));
  words.insert(words.end(), {"--range", "3:9"});
  EXPECT_THAT(run(words).out, HasSubstr("2 cleaned, 0 done already"));
}

TEST_F(Batch, TreatsOptionsOfThePresetAndOfTheCommandLineAlike) {
  make_tree(1);
  put(folder / "gauss.toml", "method = \"gaussian\"\n");
  ASSERT_EQ(run({"batch", "raw", "-o", "clean", "--config", "gauss.toml"}).code, 0);
  EXPECT_THAT(run({"batch", "raw", "-o", "clean", "--method", "gaussian"}).out,
              HasSubstr("0 cleaned, 1 done already"));
}

TEST_F(Batch, OneBadTakeStopsNoOther) {
  make_tree(2);
  put(folder / "raw/broken.bvh", "HIERARCHY\nROOT Hips\n{\n");
  const Ran ran = run({"batch", "raw", "-o", "clean"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("raw/broken.bvh:"));
  EXPECT_EQ(takes("clean").size(), 2u);
  EXPECT_THAT(ran.out, HasSubstr("2 cleaned, 0 done already, 1 failed"));
  const Json summary = Json::parse(contents(folder / "clean/summary.json"));
  EXPECT_EQ(summary.at("figures").at("failed"), 1);
  EXPECT_EQ(summary.at("failures").at(0).at("name"), "broken.bvh");
  EXPECT_EQ(run({"batch", "raw", "-o", "clean"}).code, 3) << "it has not become better";
}

TEST_F(Batch, ShardsDoEachTakeOnceAndSumUpTogether) {
  make_tree(8);
  ASSERT_EQ(run({"batch", "raw", "-o", "whole"}).code, 0);
  std::multiset<std::string> done;
  for (const char* shard : {"1/3", "2/3", "3/3"}) {
    const Ran ran = run({"batch", "raw", "-o", "clean", "--shard", shard});
    ASSERT_EQ(ran.code, 0) << ran.err;
    std::string file = std::string("clean/rows.") + shard[0] + "-of-3.jsonl";
    for (const Json& row : rows(file)) done.insert(row.at("name"));
  }
  EXPECT_EQ(done.size(), 8u);
  EXPECT_EQ(std::set<std::string>(done.begin(), done.end()).size(), 8u);
  EXPECT_EQ(takes("clean"), takes("whole"));
  EXPECT_EQ(Json::parse(contents(folder / "clean/summary.json")).at("figures").at("cleaned"), 8);
  EXPECT_THAT(run({"batch", "raw", "-o", "clean"}).out, HasSubstr("0 cleaned, 8 done already"));
}

TEST_F(Batch, RefusesAShardThatIsNone) {
  make_tree(1);
  for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/3x", "1/0"}) {
    const Ran ran = run({"batch", "raw", "-o", "clean", "--shard", shard});
    EXPECT_EQ(ran.code, 2) << shard;
    EXPECT_THAT(ran.err, IsOneLine());
  }
}

TEST_F(Batch, LeavesFilesThatItDidNotMakeAlone) {
  make_tree(2);
  fs::create_directory(folder / "clean");
  put(folder / "clean/a.bvh", "dear");
  const Ran ran = run({"batch", "raw", "-o", "clean"});
  EXPECT_EQ(ran.code, 4);
  EXPECT_EQ(contents(folder / "clean/a.bvh"), "dear");
  EXPECT_EQ(takes("clean").size(), 2u);
  EXPECT_EQ(run({"batch", "raw", "-o", "clean"}).code, 4) << "asking again is not enough";
  EXPECT_EQ(contents(folder / "clean/a.bvh"), "dear");
  EXPECT_EQ(run({"batch", "raw", "-o", "clean", "--force"}).code, 0);
  EXPECT_NE(contents(folder / "clean/a.bvh"), "dear");
}

TEST_F(Batch, AnOutputFolderThatCannotBeIsExitCode4) {
  make_tree(2);
  put(folder / "file", "dear");
  for (const char* output : {"file", "file/deeper", "/proc/self/out"}) {
    const Ran ran = run({"batch", "raw", "-o", output});
    EXPECT_EQ(ran.code, 4) << output;
    EXPECT_THAT(ran.err, IsOneLine());
    EXPECT_THAT(ran.err, testing::Not(HasSubstr("internal error")));
    EXPECT_THAT(ran.err, HasSubstr(output));
  }
  EXPECT_EQ(contents(folder / "file"), "dear");
}

TEST_F(Batch, ARefusedBatchLeavesNoSums) {
  make_tree(1);
  fs::create_directory(folder / "clean");
  put(folder / "clean/a.bvh", "dear");
  EXPECT_EQ(run({"batch", "raw/a.bvh", "missing.bvh", "-o", "out"}).code, 3);
  EXPECT_TRUE(fs::exists(folder / "out/summary.json")) << "one of two was done";
  fs::create_directories(folder / "one");
  fs::copy_file(folder / "raw/a.bvh", folder / "one/a.bvh");
  EXPECT_EQ(run({"batch", "one", "-o", "clean"}).code, 4);
  EXPECT_EQ(run({"batch", "missing.bvh", "-o", "nothing/deeper"}).code, 3);
  EXPECT_FALSE(fs::exists(folder / "nothing")) << "not even a folder is left";
  for (const char* name : {"clean", "nothing"}) {
    EXPECT_FALSE(fs::exists(folder / name / "summary.json")) << name;
    EXPECT_FALSE(fs::exists(folder / name / "rows.jsonl")) << name;
    EXPECT_FALSE(fs::exists(folder / name / ".kinemend")) << name;
  }
  EXPECT_EQ(contents(folder / "clean/a.bvh"), "dear");
}

TEST_F(Batch, SeveralAtOnceDoNotDisturbEachOther) {
  make_tree(6);
  ASSERT_EQ(run({"batch", "raw", "-o", "alone"}).code, 0);
  std::vector<pid_t> children;
  for (int i = 0; i < 4; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      const int null = open("/dev/null", O_RDWR);
      for (const int stream : {0, 1, 2}) dup2(null, stream);
      execute({"batch", "raw", "-o", "clean"}, {});
    }
    children.push_back(child);
  }
  for (const pid_t child : children) EXPECT_EQ(wait_for(child).code, 0);
  ASSERT_EQ(takes("clean"), takes("alone"));
  const Ran again = run({"batch", "raw", "-o", "clean"});
  EXPECT_THAT(again.out, HasSubstr("0 cleaned, 6 done already, 0 failed"));
  EXPECT_EQ(lines_of(contents(folder / "clean/rows.jsonl")).size(), 6u);
  EXPECT_EQ(Json::parse(contents(folder / "clean/summary.json")).at("figures").at("cleaned"), 6);
}

TEST_F(Batch, TakesAListFromStandardInput) {
  make_tree(3);
  Setting setting;
  setting.in = "# two takes\nraw/a.bvh\n\nraw/deep/b.bvh\r\n";
  const Ran ran = run({"batch", "--list", "-", "-o", "clean"}, setting);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(fs::exists(folder / "clean/raw/a.bvh"));
  EXPECT_TRUE(fs::exists(folder / "clean/raw/deep/b.bvh"));
  EXPECT_EQ(takes("clean").size(), 2u);
}

TEST_F(Batch, RefusesNamesThatWouldLeaveTheOutputFolder) {
  make_tree(1);
  for (const std::string& name : {std::string("../a.bvh"), (folder / "raw/a.bvh").string()}) {
    const Ran ran = run({"batch", name, "-o", "clean"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("no place below the output folder"));
  }
}

TEST_F(Batch, MayWriteIntoAFolderBelowItsInput) {
  make_tree(2);
  ASSERT_EQ(run({"batch", "raw", "-o", "raw/clean"}).code, 0);
  EXPECT_THAT(run({"batch", "raw", "-o", "raw/clean"}).out,
              HasSubstr("0 cleaned, 2 done already, 0 failed"));
}

TEST_F(Batch, NarrowsAFolderByName) {
  make_tree(4);
  ASSERT_EQ(run({"batch", "raw", "-o", "clean", "--files", "[ab].bvh"}).code, 0);
  EXPECT_EQ(takes("clean").size(), 2u);
}

TEST_F(Batch, KilledAtAnyMomentItLeavesWholeFilesOnlyAndGoesOn) {
  make_tree(12);
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run({"batch", "raw", "-o", "whole", "--jobs", "2"}).code, 0);
  const auto whole_run = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - start);
  const auto reference = takes("whole");
  const unsigned seed = std::random_device()();
  RecordProperty("seed", static_cast<int>(seed));
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::size_t seen = 0;
  for (int attempt = 0; attempt < 25; ++attempt) {
    const pid_t child = fork();
    if (child == 0) {
      // Standard output is discarded; standard error must stay empty.
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      const int errors = open((folder / "errors").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0666);
      dup2(errors, STDERR_FILENO);
      // The leak search would report the kill as an error.
      Setting setting;
      setting.environment = {{"ASAN_OPTIONS", "detect_leaks=0"}};
      execute({"batch", "raw", "-o", "clean", "--jobs", "2"}, setting);
    }
    // Kills the run at a random moment of the duration measured on this machine.
    std::uniform_int_distribution<long> moment(0, whole_run.count());
    std::this_thread::sleep_for(std::chrono::microseconds(moment(random)));
    kill(child, SIGKILL);
    wait_for(child);
    for (const auto& [name, bytes] : takes("clean")) {
      ASSERT_EQ(bytes, reference.at(name)) << name << " after attempt " << attempt;
      ++seen;
    }
  }
  EXPECT_GT(seen, 0u) << "no run got as far as a result";
  EXPECT_THAT(contents(folder / "errors"), IsEmpty());
  // A killed run can leave a temporary file behind. Within an hour, another machine could still be
  // writing it, so the files are made older.
  for (const std::string& name : files()) {
    const fs::path path = folder / name;
    if (path.extension() == ".tmp")
      fs::last_write_time(path, fs::last_write_time(path) - std::chrono::hours(2));
  }
  const Ran ran = run({"batch", "raw", "-o", "clean"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(takes("clean"), reference);
  for (const std::string& name : files()) EXPECT_THAT(name, Not(EndsWith(".tmp")));
}

class BatchInputs : public Program {
 protected:
  // Writes NAME/t.bvh, different for each seed.
  void make_take(const std::string& name, const std::string& seed) {
    fs::create_directories(folder / name);
    synth("truth.bvh", "walk", "0.4");
    const Ran ran = run({"corrupt", "truth.bvh", "-o", name + "/t.bvh", "--damage",
                         "gaussian:std_deg=1.5", "--seed", seed});
    ASSERT_EQ(ran.code, 0) << ran.err;
    fs::remove(folder / "truth.bvh");
  }
  Ran batch(std::vector<std::string> words) {
    words.insert(words.begin(), "batch");
    return run(words);
  }
};

TEST_F(BatchInputs, AResultOfAnotherTakeIsNotOverwritten) {
  make_take("a", "1");
  make_take("b", "2");
  ASSERT_EQ(batch({"a", "-o", "out"}).code, 0);
  const std::string first = contents(folder / "out/t.bvh");
  const std::string rows = contents(folder / "out/rows.jsonl");
  const Ran refused = batch({"b", "-o", "out"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.err,
              AllOf(IsOneLine(), HasSubstr("out/t.bvh: is the result of "), HasSubstr("a/t.bvh"),
                    HasSubstr("not of b/t.bvh"), HasSubstr("--force")));
  EXPECT_EQ(contents(folder / "out/t.bvh"), first);
  EXPECT_EQ(contents(folder / "out/rows.jsonl"), rows);
  EXPECT_THAT(batch({"a", "-o", "out"}).out, HasSubstr("0 cleaned, 1 done already"));
  EXPECT_EQ(batch({"b", "-o", "out", "--force"}).code, 0);
  EXPECT_NE(contents(folder / "out/t.bvh"), first);
}

TEST_F(BatchInputs, ATakeThatHasMovedIsStillTheSameTake) {
  make_take("a", "1");
  ASSERT_EQ(batch({"a", "-o", "out"}).code, 0);
  fs::rename(folder / "a", folder / "moved");
  EXPECT_THAT(batch({"moved", "-o", "out"}).out, HasSubstr("0 cleaned, 1 done already"));
  EXPECT_THAT(batch({"moved", "-o", "out", "--method", "gaussian"}).out, HasSubstr("1 cleaned"));
  // The input also changes at its own path.
  fs::remove(folder / "moved/t.bvh");
  make_take("moved", "2");
  EXPECT_EQ(batch({"moved", "-o", "out", "--method", "gaussian"}).code, 0);
}

TEST_F(BatchInputs, ASkeletonOfAnotherTakeIsNotOverwritten) {
  make_take("a", "1");
  ASSERT_EQ(run({"convert", "a/t.bvh", "a/take.amc"}).code, 0);
  fs::remove(folder / "a/t.bvh");
  fs::create_directories(folder / "b");
  for (const char* file : {"take.asf", "take.amc"})
    fs::copy_file(folder / "a" / file, folder / "b" / file);
  put(folder / "b/take.asf", "# another one\n" + contents(folder / "b/take.asf"));
  ASSERT_EQ(batch({"a", "-o", "out"}).code, 0);
  const std::string skeleton = contents(folder / "out/take.asf");
  const Ran refused = batch({"b", "-o", "out"});
  EXPECT_EQ(refused.code, 4) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("out/take.asf: is the result of "));
  EXPECT_EQ(contents(folder / "out/take.asf"), skeleton);
  // The skeleton of a take with another name would be written over this one.
  fs::rename(folder / "b/take.amc", folder / "b/other.amc");
  EXPECT_EQ(batch({"b", "-o", "out"}).code, 4);
  EXPECT_FALSE(fs::exists(folder / "out/other.amc"));
  EXPECT_EQ(contents(folder / "out/take.asf"), skeleton);
  // A skeleton that changed at its own path is copied again and does not count as a take.
  put(folder / "a/take.asf", "# changed\n" + contents(folder / "a/take.asf"));
  ASSERT_EQ(batch({"a", "-o", "out"}).code, 0);
  EXPECT_EQ(contents(folder / "out/take.asf"), contents(folder / "a/take.asf"));
  EXPECT_EQ(Json::parse(contents(folder / "out/summary.json")).at("figures").at("takes"), 1);
}

TEST_F(BatchInputs, AnInputIsNotOverwrittenByAResult) {
  make_take("a", "1");
  const std::string take = contents(folder / "a/t.bvh");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"a", "-o", "a", "--force"}, {"a/t.bvh", "-o", ".", "--force"}}) {
    const Ran refused = batch(words);
    EXPECT_EQ(refused.code, 2);
    EXPECT_THAT(refused.err, AllOf(IsOneLine(), HasSubstr("also read by this run")));
    EXPECT_EQ(contents(folder / "a/t.bvh"), take);
  }
}

TEST_F(BatchInputs, TakesNamesOf255Bytes) {
  make_take("a", "1");
  // Each letter has two bytes, so a careless cut would split one.
  std::string long_name;
  while (long_name.size() < 250) long_name += "\xC3\xA9";
  for (const std::string& name : {long_name + "x.bvh", std::string(251, 'n') + ".bvh"}) {
    SCOPED_TRACE(name);
    ASSERT_EQ(name.size(), 255u);
    fs::create_directories(folder / "raw");
    fs::copy_file(folder / "a/t.bvh", folder / "raw" / name);
    const Ran ran = batch({"raw", "-o", "out", "--report", "index.html"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_TRUE(fs::exists(folder / "out" / name));
    EXPECT_THAT(batch({"raw", "-o", "out", "--report", "index.html"}).out,
                HasSubstr("0 cleaned, 1 done already"));
    fs::remove_all(folder / "raw");
  }
  // Takes of earlier batches are counted by their full names.
  EXPECT_EQ(Json::parse(contents(folder / "out/summary.json")).at("figures").at("takes"), 2);
}

TEST_F(BatchInputs, AListThatIsNoTextInUtf8IsRefusedWithTheReason) {
  make_take("a", "1");
  const std::string list = "a/t.bvh\n";
  std::string wide = "\xFF\xFE";
  for (const char c : list) wide += {c, '\0'};
  put(folder / "wide.txt", wide);
  put(folder / "nul.txt", list + std::string("a/t.bvh\0b.bvh\0", 14));
  const Ran utf16 = batch({"--list", "wide.txt", "-o", "out"});
  EXPECT_EQ(utf16.code, 3);
  EXPECT_EQ(utf16.err, "kinemend: wide.txt: the list is in UTF-16; save it as UTF-8\n");
  const Ran nul = batch({"--list", "nul.txt", "-o", "out"});
  EXPECT_EQ(nul.code, 3);
  EXPECT_THAT(nul.err, AllOf(IsOneLine(), HasSubstr("nul.txt:2: found a NUL byte")));
  EXPECT_FALSE(fs::exists(folder / "out"));
  // A byte order mark is not part of the first name.
  put(folder / "marked.txt", "\xEF\xBB\xBF" + list);
  EXPECT_EQ(batch({"--list", "marked.txt", "-o", "out"}).code, 0);
}

}  // namespace
}  // namespace kinemend::test
