// Outputs never contain NaN or infinity. A format that cannot represent a gap gets its held value.
#include <cctype>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

// Replaces more than a hundred numbers of a take by NaN or infinity: alone, in runs, at either end,
// and where the previous sample equals the filled value.
std::string with_gaps(std::string text, std::size_t data_begin) {
  const char* const words[] = {"nan", "inf", "-nan", "1e999", "NaN", "-inf"};
  std::string result = text.substr(0, data_begin);
  std::size_t count = 0;
  for (std::size_t i = data_begin; i < text.size();) {
    const bool starts = std::isspace(static_cast<unsigned char>(text[i - 1])) != 0 &&
                        (std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-');
    if (!starts) {
      result += text[i++];
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \n", i), text.size());
    const bool is_gap = ++count % 17 == 0 || count % 101 < 3;
    result += is_gap ? std::string(words[count % 6]) : text.substr(i, end - i);
    i = end;
  }
  return result;
}

// Counts the words that parse as NaN or infinity.
std::size_t count_of_no_numbers(const std::string& text) {
  std::size_t count = 0;
  std::string word;
  for (const char c : text + " ") {
    if (std::isspace(static_cast<unsigned char>(c)) == 0 && c != ',' && c != ';') {
      word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      continue;
    }
    if (word == "nan" || word == "-nan" || word == "inf" || word == "-inf" || word == "1e999")
      ++count;
    word.clear();
  }
  return count;
}

class Finite : public Program {
 protected:
  void SetUp() override {
    noisy("walk.bvh", "1");
    const std::string text = contents(folder / "walk.bvh");
    const std::size_t rows = text.find('\n', text.find("Frame Time:")) + 1;
    put(folder / "gaps.bvh", with_gaps(text, rows));
    ASSERT_GT(count_of_no_numbers(contents(folder / "gaps.bvh")), 111u);
    ASSERT_EQ(run({"convert", "walk.bvh", "-o", "gaps.amc"}).code, 0);
    const std::string amc = contents(folder / "gaps.amc");
    std::string lines;
    for (const std::string& line : lines_of(amc)) {
      const std::size_t blank = line.find(' ');
      lines += blank == line.npos ? line : with_gaps(line, blank + 1);
      lines += '\n';
    }
    // Sample numbers restart in each line of an AMC file, so a few words are replaced here.
    for (const char* bone : {"Spine ", "Head ", "LeftHand "}) {
      for (std::size_t at = lines.find(bone); at != lines.npos; at = lines.find(bone, at + 400)) {
        const std::size_t begin = at + std::string(bone).size();
        const std::size_t end = lines.find_first_of(" \n", begin);
        lines.replace(begin, end - begin, "nan");
      }
    }
    put(folder / "gaps.amc", lines);
    ASSERT_GT(count_of_no_numbers(lines), 100u);
  }

  void expect_numbers(std::vector<std::string> words, const std::string& output) {
    words.insert(words.end(), {"-o", output, "--force"});
    const Ran ran = run(words);
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(count_of_no_numbers(contents(folder / output)), 0u)
        << words[0] << " " << words[1] << " " << words.back();
  }
};

TEST_F(Finite, IsWhatEveryMethodWrites) {
  const Json methods = Json::parse(run({"methods", "--json"}).out).at("methods");
  ASSERT_GT(methods.size(), 12u);
  for (const Json& method : methods) {
    const auto name = method.at("name").get<std::string>();
    if (name == "kalman-learned") continue;  // has no default model
    for (const char* format : {"bvh", "amc"}) {
      const std::string in = std::string("gaps.") + format, out = std::string("out.") + format;
      expect_numbers({"clean", in, "-m", name}, out);
      expect_numbers({"clean", in, "-m", name, "--joints", "Head"}, out);
    }
  }
}

TEST_F(Finite, IsWhatEveryOtherCommandWrites) {
  for (const char* format : {"bvh", "amc"}) {
    const std::string in = std::string("gaps.") + format, out = std::string("out.") + format;
    expect_numbers({"fill", in}, out);
    expect_numbers({"fill", in, "-m", "spline", "--names", "Head"}, out);
    expect_numbers({"clean", in, "--fill", "auto", "--strength", "0.5"}, out);
    expect_numbers({"clean", in, "--range", "10:20"}, out);
    expect_numbers({"corrupt", in, "--damage", "gaussian:joints=Head"}, out);
    for (const char* to : {"bvh", "amc", "csv", "trc"}) {
      expect_numbers({"convert", in}, std::string("converted.") + to);
      expect_numbers({"convert", in, "--plain"}, std::string("converted.") + to);
      expect_numbers({"convert", in, "--fps", "30"}, std::string("converted.") + to);
    }
  }
}

TEST_F(Finite, IsTheFrameTimeThatWasNone) {
  std::string text = contents(folder / "walk.bvh");
  const std::size_t at = text.find("Frame Time:") + 11;
  text.replace(at, text.find('\n', at) - at, " nan");
  put(folder / "timeless.bvh", text);
  expect_numbers({"clean", "timeless.bvh"}, "out.bvh");
  expect_numbers({"clean", "timeless.bvh", "--from-fps", "60"}, "out.bvh");
  EXPECT_THAT(run({"info", "out.bvh"}).out, testing::HasSubstr("60 Hz"));
}

TEST_F(Finite, IsAMarkerThatWasMeasured) {
  put(folder / "m.csv",
      "# rate_hz: 50\n# units: "
      "mm\nframe,A_x,A_y,A_z,B_x,B_y,B_z\n1,1,2,3,4,5,6\n2,nan,2,3,4,inf,6\n"
      "3,1,2,3,4,5,6\n4,1,2,3,4,5,6\n");
  expect_numbers({"fill", "m.csv", "-m", "spline", "--fill-all"}, "out.csv");
  for (const char* to : {"trc", "csv"})
    expect_numbers({"convert", "m.csv", "--plain"}, std::string("out.") + to);
}

}  // namespace
}  // namespace kinemend::test
