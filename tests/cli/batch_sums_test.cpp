// Tests of a batch that skips cleaning, converts, or only prints its plan; of its sums and rows,
// and of the takes that it lists for review.
#include <signal.h>
#include <sys/stat.h>
#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::UnorderedElementsAre;

class BatchSums : public Program {
 protected:
  /// Writes `name`/t0.bvh, t1.bvh, ...: short takes.
  void make_folder(const std::string& name, int count) {
    fs::create_directories(folder / name);
    for (int i = 0; i < count; ++i)
      put(folder / name / ("t" + std::to_string(i) + ".bvh"), hand_take());
  }

  std::vector<std::string> row_names(const std::string& file) const {
    std::vector<std::string> names;
    for (const std::string& line : lines_of(contents(folder / file)))
      names.push_back(Json::parse(line).at("name"));
    return names;
  }
  Json summary() const { return Json::parse(contents(folder / "out/summary.json")).at("figures"); }
};

// Limits the size of every file that this process and its children write, during its lifetime.
class LimitOfFiles {
 public:
  explicit LimitOfFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~LimitOfFiles() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  LimitOfFiles(const LimitOfFiles&) = delete;
  LimitOfFiles& operator=(const LimitOfFiles&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(BatchSums, ARowThatCannotBeWrittenIsAnErrorWithItsReason) {
  make_folder("raw", 1);
  fs::create_directories(folder / "out");
  fs::create_symlink("/dev/full", folder / "out/rows.jsonl");
  const Ran full = run({"batch", "raw", "-o", "out"});
  EXPECT_EQ(full.code, 4);
  EXPECT_THAT(full.err, HasSubstr("rows.jsonl: No space left on device"));
}

TEST_F(BatchSums, ARowThatIsWrittenInPartIsAnErrorWithItsReason) {
  make_folder("raw", 1);
  fs::create_directories(folder / "out");
  const std::size_t before = 1 << 20, room = 10;
  put(folder / "out/rows.jsonl", std::string(before - 1, ' ') + "\n");
  const LimitOfFiles limit(before + room);
  const Ran ran = run({"batch", "raw", "-o", "out"});
  EXPECT_EQ(ran.code, 4);
  EXPECT_THAT(ran.err, HasSubstr("rows.jsonl: File too large"));
}

TEST_F(BatchSums, ManyTakesAreSummedUpInFewLines) {
  make_folder("raw", 40);
  // Reading each of these takes gives a warning.
  for (int i = 0; i < 40; ++i) {
    const fs::path path = folder / ("raw/t" + std::to_string(i) + ".bvh");
    std::string text = contents(path);
    text.replace(text.find("Frames: 10"), 10, "Frames: 12");
    put(path, text);
  }
  for (int i = 0; i < 30; ++i)
    put(folder / ("raw/broken" + std::to_string(i) + ".bvh"), "HIERARCHY\nROOT Hips\n{\n");
  const Ran ran = run({"batch", "raw", "-o", "out"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.out, HasSubstr("40 cleaned, 0 done already, 30 failed, 40 with warnings\n"));
  EXPECT_LE(lines_of(ran.out).size(), 13u);
  const std::vector<std::string> errors = lines_of(ran.err);
  ASSERT_EQ(errors.size(), 11u) << ran.err;
  EXPECT_EQ(errors.back(), "kinemend: 20 more failed; see the rows in out");
  const Ran verbose = run({"batch", "raw", "-o", "loud", "--verbose"});
  EXPECT_EQ(lines_of(verbose.err).size(), 70u);
  EXPECT_EQ(run({"batch", "raw", "-o", "still", "--quiet"}).out, "");
}

TEST_F(BatchSums, TheWorstTenAreNamedWorstFirst) {
  make_folder("raw", 12);
  fs::create_directories(folder / "raw/deep");
  synth("truth.bvh", "walk", "1");
  const Ran bad = run({"corrupt", "truth.bvh", "-o", "raw/deep/bad.bvh", "--damage",
                       "outliers:share=0.05,std_deg=40", "--seed", "3"});
  ASSERT_EQ(bad.code, 0) << bad.err;
  std::string odd = hand_take();
  odd.replace(odd.find("Frames: 10"), 10, "Frames: 12");
  put(folder / "raw/odd.bvh", odd);
  const Ran ran = run({"batch", "raw", "-o", "out"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  const std::size_t heading = ran.out.find("needs review, worst first:\n");
  ASSERT_NE(heading, std::string::npos) << ran.out;
  const std::vector<std::string> lines = lines_of(ran.out.substr(heading));
  ASSERT_GE(lines.size(), 3u);
  EXPECT_LE(lines.size(), 11u);
  // The list names the take with a warning, then the most repaired take.
  std::vector<std::string> named;
  for (const std::string& line : lines) {
    if (line.rfind("  odd.bvh: ", 0) == 0 || line.rfind("  deep/bad.bvh: ", 0) == 0)
      named.push_back(line.substr(2, line.find(':') - 2));
  }
  EXPECT_THAT(named, testing::UnorderedElementsAre("odd.bvh", "deep/bad.bvh"));
}

TEST_F(BatchSums, InputsThatHoldNothingFail) {
  make_folder("raw", 1);
  fs::create_directories(folder / "empty/deeper");
  put(folder / "empty/notes.txt", "nothing");
  put(folder / "none.txt", "# nothing\n\n");
  const Ran empty = run({"batch", "empty", "-o", "out"});
  EXPECT_EQ(empty.code, 3);
  EXPECT_EQ(empty.err, "kinemend: empty: holds no take\n");
  const Ran pattern = run({"batch", "raw", "-o", "out", "--files", "*.c3d"});
  EXPECT_EQ(pattern.code, 3);
  EXPECT_EQ(pattern.err, "kinemend: raw: holds no take that matches *.c3d\n");
  const Ran list = run({"batch", "--list", "none.txt", "-o", "out"});
  EXPECT_EQ(list.code, 3);
  EXPECT_EQ(list.err, "kinemend: none.txt: lists no take\n");
  const Ran missing = run({"batch", (folder / "missing").string(), "-o", "out"});
  EXPECT_EQ(missing.code, 3);
  EXPECT_THAT(missing.err, HasSubstr("missing: No such file or directory"));
  EXPECT_FALSE(fs::exists(folder / "out"));
  const Ran mixed = run({"batch", "empty", "raw", "-o", "out"});
  EXPECT_EQ(mixed.code, 3);
  EXPECT_EQ(mixed.err, "kinemend: empty: holds no take\n");
  EXPECT_TRUE(fs::exists(folder / "out/t0.bvh")) << "the other one is done";
}

TEST_F(BatchSums, TwoInputsIntoOneFolderAddUp) {
  make_folder("one", 2);
  make_folder("two/deep", 3);
  ASSERT_EQ(run({"batch", "one", "-o", "out"}).code, 0);
  ASSERT_EQ(run({"batch", "two", "-o", "out", "--method", "gaussian"}).code, 0);
  EXPECT_EQ(summary().at("takes"), 5);
  EXPECT_EQ(summary().at("cleaned"), 5);
  EXPECT_EQ(summary().at("frames"), 50);
  EXPECT_EQ(summary().at("to_do"), 0);
  EXPECT_THAT(row_names("out/rows.jsonl"),
              ElementsAre("deep/t0.bvh", "deep/t1.bvh", "deep/t2.bvh", "t0.bvh", "t1.bvh"));
  // Each batch may run again, and no take is lost or counted twice.
  ASSERT_EQ(run({"batch", "one", "-o", "out"}).code, 0);
  EXPECT_EQ(summary().at("cleaned"), 5);
  EXPECT_EQ(row_names("out/rows.jsonl").size(), 5u);
  // A deleted take is no longer counted.
  fs::remove(folder / "out/deep/t1.bvh");
  ASSERT_EQ(run({"batch", "one", "-o", "out"}).code, 0);
  EXPECT_EQ(summary().at("takes"), 4);
  EXPECT_EQ(row_names("out/rows.jsonl").size(), 4u);
}

TEST_F(BatchSums, ATakeThatFailedAndIsGoneFailsNoLonger) {
  make_folder("raw", 1);
  put(folder / "raw/broken.bvh", "HIERARCHY\n");
  EXPECT_EQ(run({"batch", "raw", "-o", "out"}).code, 3);
  EXPECT_EQ(summary().at("failed"), 1);
  fs::remove(folder / "raw/broken.bvh");
  EXPECT_EQ(run({"batch", "raw", "-o", "out"}).code, 0);
  EXPECT_EQ(summary().at("failed"), 0);
  EXPECT_THAT(row_names("out/rows.jsonl"), ElementsAre("t0.bvh"));
}

TEST_F(BatchSums, AnInterruptedBatchKeepsTheRowsOfWhatIsDone) {
  put(folder / "a.bvh", hand_take());
  put(folder / "b.bvh", hand_take());
  // Reading this FIFO blocks for ever.
  ASSERT_EQ(mkfifo((folder / "c.bvh").c_str(), 0600), 0);
  const pid_t child = fork();
  if (child == 0) {
    const int null = open("/dev/null", O_RDWR);
    for (const int stream : {0, 1, 2}) dup2(null, stream);
    Setting setting;
    setting.environment = {{"ASAN_OPTIONS", "detect_leaks=0"}};
    execute({"batch", "a.bvh", "b.bvh", "c.bvh", "-o", "out", "--jobs", "1"}, setting);
  }
  const auto rows = [&] {
    return fs::exists(folder / "out/rows.jsonl") ? row_names("out/rows.jsonl")
                                                 : std::vector<std::string>();
  };
  for (int i = 0; i < 500 && rows().size() < 2; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kill(child, SIGKILL);
  wait_for(child);
  EXPECT_THAT(rows(), UnorderedElementsAre("a.bvh", "b.bvh"));
  fs::remove(folder / "c.bvh");
  put(folder / "c.bvh", hand_take());
  const Ran ran = run({"batch", "a.bvh", "b.bvh", "c.bvh", "-o", "out"});
  EXPECT_THAT(ran.out, HasSubstr("1 cleaned, 2 done already, 0 failed"));
  EXPECT_THAT(rows(), ElementsAre("a.bvh", "b.bvh", "c.bvh"));
}

TEST_F(BatchSums, AnotherGapFileMakesTheTakesAnew) {
  make_folder("raw", 1);
  put(folder / "gaps.csv", "LeftArm,4,5\n");
  const std::vector<std::string> words = {"batch", "raw", "-o", "out", "--gaps", "gaps.csv"};
  EXPECT_THAT(run(words).out, HasSubstr("1 cleaned, 0 done already"));
  EXPECT_THAT(run(words).out, HasSubstr("0 cleaned, 1 done already"));
  put(folder / "gaps.csv", "LeftArm,4,6\n");
  EXPECT_THAT(run(words).out, HasSubstr("1 cleaned, 0 done already"));
}

class BatchSteps : public Program {
 protected:
  BatchSteps() {
    fs::create_directories(folder / "raw/deep");
    put(folder / "raw/a.bvh", hand_take());
    put(folder / "raw/deep/b.bvh", hand_take());
  }
};

TEST_F(BatchSteps, FillWithoutCleaningChangesNothingButGaps) {
  put(folder / "gaps.csv", "LeftArm,4,5\n");
  const Ran ran =
      run({"batch", "raw", "-o", "out", "--no-clean", "--fill", "auto", "--gaps", "gaps.csv"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 filled, 0 done already"));
  ASSERT_EQ(run({"fill", "raw/a.bvh", "--gaps", "gaps.csv", "-o", "filled.bvh"}).code, 0);
  EXPECT_EQ(contents(folder / "out/a.bvh"), contents(folder / "filled.bvh"));
  EXPECT_NE(contents(folder / "out/a.bvh"), hand_take());
}

TEST_F(BatchSteps, ConvertsATree) {
  const Ran ran = run({"batch", "raw", "-o", "out", "--no-clean", "--to", "trc"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("2 converted, 0 done already"));
  EXPECT_THAT(contents(folder / "out/rows.jsonl"), HasSubstr("\"status\":\"cleaned\""));
  ASSERT_EQ(run({"convert", "raw/a.bvh", "a.trc"}).code, 0);
  EXPECT_EQ(contents(folder / "out/a.trc"), contents(folder / "a.trc"));
  EXPECT_TRUE(fs::exists(folder / "out/deep/b.trc"));
  EXPECT_THAT(run({"batch", "raw", "-o", "out", "--no-clean", "--to", "trc"}).out,
              HasSubstr("0 converted, 2 done already"));
  put(folder / "raw/a.csv", contents(folder / "a.trc"));
  fs::copy_file(folder / "a.trc", folder / "raw/a.trc");
  const Ran both = run({"batch", "raw", "-o", "other", "--no-clean", "--to", "trc"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("would both be written to a.trc"));
}

TEST_F(BatchSteps, CleansAndConvertsInOneRun) {
  fs::remove(folder / "raw/a.bvh");
  noisy("raw/a.bvh", "2");
  const Ran ran = run({"batch", "raw", "-o", "out", "--to", "trc"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  ASSERT_EQ(run({"clean", "raw/a.bvh", "-o", "clean.bvh"}).code, 0);
  ASSERT_EQ(run({"convert", "clean.bvh", "a.trc"}).code, 0);
  // The first line holds the name of the input file, so only the last lines are compared.
  const std::string one = contents(folder / "out/a.trc"), two = contents(folder / "a.trc");
  std::istringstream in_one_run(lines_of(one).back()), in_two(lines_of(two).back());
  // The file between the two steps has rounded angles.
  double a = 0, b = 0;
  std::size_t numbers = 0;
  for (; in_one_run >> a && in_two >> b; ++numbers) EXPECT_NEAR(a, b, 1e-4);
  EXPECT_GT(numbers, 60U);
}

TEST_F(BatchSteps, ABatchWithNothingToDoIsRefused) {
  EXPECT_THAT(run({"batch", "raw", "-o", "out", "--no-clean"}).err,
              HasSubstr("--no-clean leaves nothing to do"));
  const Ran both = run({"batch", "raw", "-o", "out", "--no-clean", "--to", "trc", "-m", "median"});
  EXPECT_EQ(both.code, 2);
  EXPECT_THAT(both.err, HasSubstr("cannot be combined with --method"));
}

TEST_F(BatchSteps, ADryRunListsWhatWouldBeDoneAndWritesNothing) {
  const auto before = files();
  const Ran first = run({"batch", "raw", "-o", "out", "--dry-run"});
  EXPECT_EQ(first.code, 0) << first.err;
  EXPECT_EQ(first.out,
            "clean    raw/a.bvh -> out/a.bvh\n"
            "clean    raw/deep/b.bvh -> out/deep/b.bvh\n"
            "2 takes to do, 0 done already, 0 refused; nothing written (--dry-run)\n");
  EXPECT_EQ(files(), before);
  fs::create_directory(folder / "out");
  put(folder / "out/a.bvh", "precious");
  const Ran refused = run({"batch", "raw", "-o", "out", "--dry-run"});
  EXPECT_EQ(refused.code, 4);
  EXPECT_THAT(refused.out, AllOf(HasSubstr("refuse   raw/a.bvh ("), HasSubstr("1 refused")));
  ASSERT_EQ(run({"batch", "raw", "-o", "out", "--force", "-q"}).code, 0);
  EXPECT_THAT(run({"batch", "raw", "-o", "out", "--dry-run"}).out,
              HasSubstr("done     raw/a.bvh -> out/a.bvh\n"));
}

TEST_F(BatchSteps, TotalsNameTheirPartsOnlyWhereThereAreParts) {
  EXPECT_THAT(run({"batch", "raw", "-o", "out"}).out,
              AllOf(HasSubstr("in total: 2 of 2 takes done"), Not(HasSubstr("all parts"))));
  EXPECT_THAT(run({"batch", "raw", "-o", "parts", "--shard", "1/2"}).out, HasSubstr("all parts: "));
}

}  // namespace
}  // namespace kinemend::test
