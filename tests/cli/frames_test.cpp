// A frame has its file's frame number wherever one is printed, written or read.
#include <fmt/format.h>

#include "cli/plate.hpp"
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Numbering {
  std::string file;
  int first;

  friend void PrintTo(const Numbering& one, std::ostream* out) {
    *out << one.file << " from " << one.first;
  }
};

class FrameNumbers : public Program, public testing::WithParamInterface<Numbering> {
 protected:
  FrameNumbers() {
    put(folder / "plate.trc", plate_take(first));
    if (take != "plate.trc") {
      EXPECT_EQ(run({"convert", "plate.trc", take}).code, 0);
    }
  }
  const std::string take = GetParam().file;
  const int first = GetParam().first;
  const int gap_first = first + 40, gap_last = first + 45, spike = first + 79;
};

TEST_P(FrameNumbers, AreTheFilesInFindingsAndReports) {
  if (first != 1) {
    EXPECT_THAT(run({"info", take}).out, HasSubstr(fmt::format("from frame {}", first)));
  }
  EXPECT_EQ(Json::parse(run({"info", take, "--json"}).out)["takes"][0]["first_frame"], first);
  EXPECT_THAT(run({"check", take}).out,
              HasSubstr(fmt::format("frames {}-{}: B is missing", gap_first, gap_last)));
  const Json check = Json::parse(run({"check", take, "--json"}).out)["takes"][0];
  EXPECT_EQ(check["first_frame"], first);
  bool has_spike = false;
  for (const Json& finding : check["findings"]) {
    if (finding["kind"] == "gap") {
      EXPECT_EQ(finding["first_frame"], gap_first);
      EXPECT_EQ(finding["last_frame"], gap_last);
    }
    has_spike = has_spike || (finding["kind"] == "spike" && finding["first_frame"] == spike);
  }
  EXPECT_TRUE(has_spike);

  const Ran fill = run({"fill", take, "--dry-run"});
  EXPECT_THAT(fill.out, HasSubstr(fmt::format(" {}-{} ", gap_first, gap_last)));
  const Json filled =
      Json::parse(run({"fill", take, "--dry-run", "--json"}).out)["takes"][0]["findings"];
  EXPECT_EQ(filled[0]["first_frame"], gap_first);
  EXPECT_EQ(filled[0]["last_frame"], gap_last);

  ASSERT_EQ(run({"clean", take, "--fill", "auto", "--dry-run", "--report", "r.json"}).code, 0);
  const Json clean = Json::parse(contents(folder / "r.json"))["takes"][0];
  bool has_filled = false, has_despiked = false;
  for (const Json& span : clean["findings"]) {
    has_filled = has_filled || (span["verdict"] == "filled" && span["first_frame"] == gap_first &&
                                span["last_frame"] == gap_last);
    has_despiked = has_despiked || (span["verdict"] == "despiked" && span["first_frame"] == spike);
  }
  EXPECT_TRUE(has_filled && has_despiked);
}

TEST_P(FrameNumbers, AreTheFilesWhereTheyAreTyped) {
  const std::string range = fmt::format("--range={}:{}", first + 30, first + 60);
  ASSERT_EQ(run({"clean", take, range, "--dry-run", "--report", "r.json"}).code, 0);
  const Json spans = Json::parse(contents(folder / "r.json"))["takes"][0]["findings"];
  ASSERT_FALSE(spans.empty());
  for (const Json& span : spans) {
    EXPECT_GE(span["first_frame"], first + 30);
    EXPECT_LE(span["last_frame"], first + 60);
  }
  EXPECT_THAT(run({"fill", take, range, "--dry-run"}).out, HasSubstr("1 gap: 1 filled"));
  for (const std::string command : {"clean", "fill"}) {
    const Ran before = run({command, take, fmt::format("--range={}:", first - 1), "--dry-run"});
    EXPECT_EQ(before.code, 2);
    EXPECT_THAT(before.err, HasSubstr(fmt::format("--range: frame {} is outside {} to {}",
                                                  first - 1, first, first + 149)));
    EXPECT_EQ(run({command, take, fmt::format("--range=:{}", first + 150), "--dry-run"}).code, 2);
  }
}

TEST_P(FrameNumbers, AreTheFilesInSideFilesOfGaps) {
  put(folder / "gaps.csv", fmt::format("D,{},{}\n", first, first + 5));
  const Json filled = Json::parse(
      run({"fill", take, "--gaps", "gaps.csv", "--dry-run", "--json"}).out)["takes"][0]["findings"];
  ASSERT_EQ(filled.size(), 2u);
  EXPECT_EQ(filled[1]["track"], "D");
  EXPECT_EQ(filled[1]["first_frame"], first);
  EXPECT_EQ(filled[1]["last_frame"], first + 5);
  const Ran clean = run({"clean", take, "--gaps", "gaps.csv", "--dry-run", "--json"});
  EXPECT_EQ(Json::parse(clean.out)["takes"][0]["figures"]["gaps_left"], 2) << clean.err;
  put(folder / "gaps.csv", fmt::format("D,{},{}\n", first - 1, first + 5));
  for (const std::string command : {"clean", "fill"}) {
    const Ran wrong = run({command, take, "--gaps", "gaps.csv", "--dry-run"});
    EXPECT_EQ(wrong.code, 3);
    EXPECT_THAT(wrong.err, HasSubstr(fmt::format("gaps.csv:1: expected a frame number from {}, "
                                                 "found \"{}\"",
                                                 first, first - 1)));
  }
  put(folder / "gaps.csv", fmt::format("D,{},{}\n", first, first + 150));
  EXPECT_THAT(run({"fill", take, "--gaps", "gaps.csv", "--dry-run"}).err,
              HasSubstr(fmt::format("frames {0} to {1} are not in a take of frames {0} to {2}",
                                    first, first + 150, first + 149)));
}

TEST_P(FrameNumbers, AreTheFilesInTheGapsThatCheckWrites) {
  // D stands still for twelve frames.
  std::vector<std::string> lines = lines_of(plate_take(first));
  std::string text;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::string line = lines[i];
    if (i >= 6 + 60 && i < 6 + 72) {
      std::size_t cut = line.size();
      for (int c = 0; c < 3; ++c) cut = line.rfind('\t', cut - 1);
      line = line.substr(0, cut) + "\t90.5\t110.25\t930.125";
    }
    text += line + "\n";
  }
  put(folder / "still.trc", text);
  std::string still_take = "still.trc";
  if (take != "plate.trc") {
    still_take = "still" + fs::path(take).extension().string();
    ASSERT_EQ(run({"convert", "still.trc", still_take}).code, 0);
  }
  ASSERT_EQ(run({"check", still_take, "--gaps-out", "stale.csv"}).code, 0);
  EXPECT_THAT(contents(folder / "stale.csv"),
              HasSubstr(fmt::format("D,{},{}\n", first + 61, first + 71)));
}

INSTANTIATE_TEST_SUITE_P(Takes, FrameNumbers,
                         testing::Values(Numbering{"plate.trc", 1}, Numbering{"plate.trc", 0},
                                         Numbering{"plate.trc", 300}, Numbering{"plate.c3d", 300},
                                         Numbering{"plate.csv", 300}));

using AmcFrames = Program;

TEST_F(AmcFrames, AreThoseOfTheFile) {
  synth("walk.bvh", "walk", "3");
  ASSERT_EQ(run({"convert", "walk.bvh", "plain.amc"}).code, 0);
  fs::copy_file(folder / "plain.asf", folder / "walk.asf");
  std::string text;
  for (const std::string& line : lines_of(contents(folder / "plain.amc"))) {
    const bool is_number =
        !line.empty() && line.find_first_not_of("0123456789") == std::string::npos;
    text += is_number ? std::to_string(std::stoi(line) + 500) : line;
    text += "\n";
  }
  put(folder / "walk.amc", text);
  const std::vector<std::string> reading = {"--from-fps", "60", "--asf", "plain.asf"};
  const auto run_on = [&](std::vector<std::string> words) {
    words.insert(words.end(), reading.begin(), reading.end());
    return run(words);
  };
  EXPECT_THAT(run_on({"info", "walk.amc"}).out, HasSubstr("from frame 501"));
  EXPECT_THAT(run_on({"info", "plain.amc"}).out, Not(HasSubstr("from frame")));
  EXPECT_EQ(run_on({"clean", "walk.amc", "--range", "501:680", "--dry-run"}).code, 0);
  EXPECT_THAT(run_on({"clean", "walk.amc", "--range", "1:10", "--dry-run"}).err,
              HasSubstr("frame 1 is outside 501 to 680"));
  const auto contact_lines = [&](const std::string& take) {
    const Ran ran = run_on({"contacts", take});
    EXPECT_EQ(ran.code, 0) << ran.err;
    std::vector<std::string> found;
    for (const std::string& line : lines_of(ran.out)) {
      if (line.find("left ") == 0 || line.find("right ") == 0) found.push_back(line);
    }
    return found;
  };
  const std::vector<std::string> plain = contact_lines("plain.amc");
  const std::vector<std::string> numbered = contact_lines("walk.amc");
  ASSERT_EQ(plain.size(), numbered.size());
  ASSERT_FALSE(plain.empty());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    char side[16], part[16], side_of[16], part_of[16];
    int a = 0, b = 0, c = 0, d = 0;
    ASSERT_EQ(std::sscanf(plain[i].c_str(), "%15s %15s %d %d", side, part, &a, &b), 4);
    ASSERT_EQ(std::sscanf(numbered[i].c_str(), "%15s %15s %d %d", side_of, part_of, &c, &d), 4);
    EXPECT_EQ(c, a + 500);
    EXPECT_EQ(d, b + 500);
  }
  put(folder / "walk.contacts", numbered[0] + "\n");
  const Ran held =
      run_on({"clean", "walk.amc", "--contacts", "walk.contacts", "--dry-run", "--json"});
  ASSERT_EQ(held.code, 0) << held.err;
  const Json contact = Json::parse(held.out)["takes"][0]["feet"]["contacts"][0];
  EXPECT_THAT(numbered[0], HasSubstr(std::to_string(contact["first_frame"].get<int>())));
  put(folder / "walk.contacts", plain[0] + "\n");
  EXPECT_EQ(run_on({"clean", "walk.amc", "--contacts", "walk.contacts", "--dry-run"}).code, 3);
}

TEST_F(AmcFrames, OfTablesOfJointsAreTheirsToo) {
  put(folder / "a.bvh", hand_take());
  ASSERT_EQ(run({"convert", "a.bvh", "a.csv"}).code, 0);
  std::string text;
  for (const std::string& line : lines_of(contents(folder / "a.csv"))) {
    const std::size_t comma = line.find(',');
    const bool is_row =
        comma != std::string::npos && comma > 0 && line.find_first_not_of("0123456789") == comma;
    text += is_row ? std::to_string(std::stoi(line) + 299) + line.substr(comma) : line;
    text += "\n";
  }
  put(folder / "b.csv", text);
  EXPECT_THAT(run({"info", "b.csv"}).out, HasSubstr("from frame 300"));
  EXPECT_EQ(run({"clean", "b.csv", "--range", "300:309", "--dry-run"}).code, 0);
  EXPECT_EQ(run({"clean", "b.csv", "--range", "1:5", "--dry-run"}).code, 2);
}

}  // namespace
}  // namespace kinemend::test
