// Tests of a batch that skips cleaning, converts, or only prints its plan.
#include <sstream>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

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
