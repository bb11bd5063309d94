// Tests of `kinemend batch --merge`: merged shards have the rows and sums of a single run.
#include <set>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class BatchMerge : public Program {
 protected:
  /// Writes raw/t0.bvh, raw/deep/t1.bvh, ...: `count` takes of different lengths, and two that
  /// fail.
  void make_tree(int count) {
    fs::create_directories(folder / "raw/deep");
    for (int i = 0; i < count; ++i) {
      const std::string name = (i % 2 != 0 ? "raw/deep/t" : "raw/t") + std::to_string(i) + ".bvh";
      std::string text = hand_take();
      if (i % 3 == 0) text = replaced(text, "Frame Time: 0.0333333", "Frame Time: 0.0166667");
      put(folder / name, text);
    }
    put(folder / "raw/broken.bvh", "HIERARCHY\nROOT Hips\n{\n");
    put(folder / "raw/deep/empty.bvh", "");
  }

  /// Runs the whole batch into `output`, because rows name it, and renames that to "whole".
  Ran whole_run(const std::string& output) {
    const Ran ran = run({"batch", "raw", "-o", output});
    fs::rename(folder / output, folder / "whole");
    return ran;
  }

  void clean_shards(int count, const std::string& output) {
    for (int i = 1; i <= count; ++i)
      run({"batch", "raw", "-o", output, "--shard", shard(i, count)});
  }
  static std::string shard(int index, int count) {
    return std::to_string(index) + "/" + std::to_string(count);
  }

  std::vector<std::string> merge_words(int count, const std::string& from,
                                       const std::string& output) const {
    std::vector<std::string> words = {"batch", "--merge", "-o", output};
    for (int i = 1; i <= count; ++i) words.push_back(rows_of(from, i, count));
    return words;
  }
  static std::string rows_of(const std::string& from, int index, int count) {
    return from + "/rows." + std::to_string(index) + "-of-" + std::to_string(count) + ".jsonl";
  }

  /// The bytes of a file without the processing times.
  std::string timeless(const std::string& path) const {
    std::string text;
    for (const std::string& line : lines_of(contents(folder / path))) {
      const bool is_time = line.find("\"seconds\"") != std::string::npos && line.size() < 80;
      std::string row = line;
      for (const char* key : {"\"seconds\":", "\"frames_per_second\":"}) {
        const std::size_t at = row.find(key);
        if (at == std::string::npos || is_time) continue;
        row.erase(at, row.find_first_of(",}", at) - at);
      }
      if (!is_time) text += row + "\n";
    }
    return text;
  }
};

TEST_F(BatchMerge, GivesTheRowsAndTheSumsOfOneRun) {
  make_tree(9);
  const Ran whole = whole_run("parts");
  EXPECT_EQ(whole.code, 3) << "two takes are broken";
  clean_shards(4, "parts");
  const Ran merged = run(merge_words(4, "parts", "merged"));
  EXPECT_EQ(merged.code, whole.code) << merged.err;
  EXPECT_EQ(merged.err, "");
  EXPECT_EQ(timeless("merged/rows.jsonl"), timeless("whole/rows.jsonl"));
  EXPECT_EQ(timeless("merged/summary.json"), timeless("whole/summary.json"));
  EXPECT_THAT(merged.out, HasSubstr("9 cleaned, 0 done already, 2 failed"));
}

TEST_F(BatchMerge, ShardsThatShareNoFolderAddUpAsWell) {
  make_tree(6);
  whole_run("clean");
  std::vector<std::string> words = {"batch", "--merge", "-o", "merged"};
  for (int i = 3; i >= 1; --i) {
    const std::string node = "node" + std::to_string(i);
    run({"batch", "raw", "-o", "clean", "--shard", shard(i, 3)});
    fs::rename(folder / "clean", folder / node);
    words.push_back(rows_of(node, i, 3));
  }
  run(words);
  EXPECT_EQ(timeless("merged/rows.jsonl"), timeless("whole/rows.jsonl"));
  EXPECT_EQ(timeless("merged/summary.json"), timeless("whole/summary.json"));
}

TEST_F(BatchMerge, IntoTheFolderOfTheShardsAndAgain) {
  make_tree(5);
  clean_shards(2, "clean");
  ASSERT_EQ(run(merge_words(2, "clean", "clean")).code, 3);
  const std::string once = contents(folder / "clean/rows.jsonl");
  ASSERT_EQ(run(merge_words(2, "clean", "clean")).code, 3);
  EXPECT_EQ(contents(folder / "clean/rows.jsonl"), once);
  const std::string merged = timeless("clean/rows.jsonl");
  run({"batch", "raw", "-o", "clean"});
  EXPECT_EQ(timeless("clean/rows.jsonl"), merged) << "a run over all agrees";
}

TEST_F(BatchMerge, NamesShardsThatAreMissingAndTakesThatAreToDo) {
  make_tree(8);
  fs::remove(folder / "raw/broken.bvh");
  fs::remove(folder / "raw/deep/empty.bvh");
  run({"batch", "raw", "-o", "parts", "--shard", "1/4"});
  run({"batch", "raw", "-o", "parts", "--shard", "3/4"});
  const Ran merged =
      run({"batch", "--merge", "-o", "merged", rows_of("parts", 1, 4), rows_of("parts", 3, 4)});
  EXPECT_EQ(merged.code, 3);
  EXPECT_THAT(merged.err, HasSubstr("no rows of 2 shards: 2/4, 4/4"));
  EXPECT_THAT(merged.err, HasSubstr("not done yet"));
  const Json figures = Json::parse(contents(folder / "merged/summary.json")).at("figures");
  EXPECT_EQ(figures.at("takes"), 8);
  EXPECT_EQ(figures.at("cleaned").get<int>() + figures.at("to_do").get<int>(), 8);
}

TEST_F(BatchMerge, AShardWithoutTakesIsNotMissing) {
  fs::create_directories(folder / "raw");
  put(folder / "raw/one.bvh", hand_take());
  clean_shards(3, "parts");
  const Ran merged = run(merge_words(3, "parts", "merged"));
  EXPECT_EQ(merged.code, 0) << merged.err;
  EXPECT_EQ(merged.err, "");
  EXPECT_THAT(merged.out, HasSubstr("1 cleaned"));
}

TEST_F(BatchMerge, ALineThatWasCutCountsAsNone) {
  make_tree(4);
  clean_shards(1, "a");
  fs::create_directories(folder / "b");
  const std::string rows = contents(folder / "a/rows.jsonl");
  put(folder / "b/rows.jsonl", rows + rows.substr(0, rows.find('\n') / 2));
  const Ran merged = run({"batch", "--merge", "b/rows.jsonl", "-o", "merged"});
  EXPECT_THAT(merged.err, HasSubstr("b/rows.jsonl: ignored 1 malformed line"));
  EXPECT_EQ(contents(folder / "merged/rows.jsonl"), rows);
}

TEST_F(BatchMerge, OfSeveralRowsOfATakeTheLastCounts) {
  make_tree(3);
  run({"batch", "raw", "-o", "a"});
  const std::string rows = contents(folder / "a/rows.jsonl");
  const std::string first = rows.substr(0, rows.find('\n') + 1);
  put(folder / "a/rows.jsonl", replaced(first, "\"failed\"", "\"begun\"") + rows);
  run({"batch", "--merge", "a/rows.jsonl", "-o", "merged"});
  EXPECT_EQ(contents(folder / "merged/rows.jsonl"), rows);
}

TEST_F(BatchMerge, RefusesRowsThatDoNotBelongTogether) {
  make_tree(4);
  run({"batch", "raw", "-o", "a"});
  run({"batch", "raw", "-o", "b", "--method", "gaussian"});
  const Ran settings = run({"batch", "--merge", "a/rows.jsonl", "b/rows.jsonl", "-o", "merged"});
  EXPECT_EQ(settings.code, 3);
  EXPECT_THAT(settings.err, IsOneLine());
  fs::create_directories(folder / "c");
  put(folder / "c/rows.jsonl",
      replaced(contents(folder / "a/rows.jsonl"), "\"frames\":10", "\"frames\":11"));
  const Ran rows = run({"batch", "--merge", "a/rows.jsonl", "c/rows.jsonl", "-o", "merged"});
  EXPECT_EQ(rows.code, 3);
  EXPECT_THAT(rows.err, HasSubstr("differently"));
  fs::remove(folder / "b/rows.jsonl");
  for (const char* text : {"", "dear\n"}) {
    put(folder / "b/rows.jsonl", text);
    EXPECT_EQ(run({"batch", "--merge", "b/rows.jsonl", "-o", "merged"}).code, 3) << text;
  }
  put(folder / "b/summary.json", "[]");
  fs::copy_file(folder / "a/rows.jsonl", folder / "b/rows.1-of-1.jsonl");
  const Ran odd = run({"batch", "--merge", "b/rows.1-of-1.jsonl", "-o", "merged"});
  EXPECT_EQ(odd.code, 3);
  EXPECT_THAT(odd.err, HasSubstr("b/summary.json"));
  EXPECT_FALSE(fs::exists(folder / "merged"));
}

TEST_F(BatchMerge, OverwritesRowsButNoOtherFileAndNoInput) {
  make_tree(3);
  clean_shards(2, "parts");
  fs::create_directories(folder / "out");
  put(folder / "out/rows.jsonl", "dear\n");
  EXPECT_EQ(run(merge_words(2, "parts", "out")).code, 4);
  EXPECT_EQ(contents(folder / "out/rows.jsonl"), "dear\n");
  std::vector<std::string> forced = merge_words(2, "parts", "out");
  forced.push_back("--force");
  EXPECT_EQ(run(forced).code, 3);
  EXPECT_EQ(run({"batch", "--merge", "out/rows.jsonl", "-o", "out"}).code, 2);
}

TEST_F(BatchMerge, RefusesOptionsThatWouldHaveNoEffect) {
  make_tree(1);
  run({"batch", "raw", "-o", "a"});
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"--shard", "1/2"},
                                             {"--method", "gaussian"},
                                             {"--files", "*.bvh"},
                                             {"--jobs", "2"},
                                             {"--report", "r.html"}}) {
    std::vector<std::string> all = {"batch", "--merge", "a/rows.jsonl", "-o", "merged"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = run(all);
    EXPECT_EQ(ran.code, 2) << words.front();
    EXPECT_THAT(ran.err, HasSubstr(words.front()));
  }
  EXPECT_EQ(run({"batch", "--merge", "-o", "merged"}).code, 2);
}

TEST_F(BatchMerge, ATakeThatIsAddedMovesNoOther) {
  make_tree(12);
  std::vector<std::set<std::string>> before(3), after(3);
  const auto names = [&](std::vector<std::set<std::string>>& parts, const std::string& output) {
    clean_shards(3, output);
    for (int i = 1; i <= 3; ++i) {
      const fs::path path = folder / rows_of(output, i, 3);
      if (!fs::exists(path)) continue;
      for (const std::string& line : lines_of(contents(path)))
        parts[static_cast<std::size_t>(i - 1)].insert(Json::parse(line).at("name"));
    }
  };
  names(before, "first");
  put(folder / "raw/a_new.bvh", hand_take());
  names(after, "second");
  for (std::size_t i = 0; i < 3; ++i) {
    after[i].erase("a_new.bvh");
    EXPECT_EQ(before[i], after[i]) << i;
  }
}

}  // namespace
}  // namespace kinemend::test
