// Tests of the inputs of a batch and of earlier results, which it must not overwrite.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

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
