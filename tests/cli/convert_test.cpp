// Tests of `kinemend convert`: from each format to others and back. The extension of an output
// selects the format that is written.
#include <cmath>
#include <map>
#include <sstream>

#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The cells of a CSV file by the names of their columns; empty cells are NaN.
struct Columns {
  std::map<std::string, std::vector<double>> values;
  std::size_t rows = 0;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line + ",");
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

Columns columns_of(const fs::path& path) {
  Columns columns;
  std::vector<std::string> names;
  for (const std::string& line : lines_of(contents(path))) {
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (names.empty()) {
      names = cells;
      continue;
    }
    for (std::size_t i = 0; i < names.size(); ++i)
      columns.values[names[i]].push_back(cells[i].empty() ? NAN : std::stod(cells[i]));
    ++columns.rows;
  }
  return columns;
}

class Convert : public Program {
 protected:
  void convert(const std::string& in, const std::string& out, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"convert", in, "-o", out, "--force"};
    words.insert(words.end(), more.begin(), more.end());
    const Ran ran = run(words);
    ASSERT_EQ(ran.code, 0) << in << " to " << out << ": " << ran.err;
  }
  /// The joints' positions in a take, converted to CSV.
  Columns positions(const std::string& take, std::vector<std::string> more = {}) {
    more.push_back("--positions");
    convert(take, "positions.csv", more);
    return columns_of(folder / "positions.csv");
  }
};

/// Expects that every column of `some` is in `all` with the same values.
void expect_same(const Columns& some, const Columns& all, double tolerance) {
  ASSERT_GT(some.rows, 0u);
  ASSERT_EQ(some.rows, all.rows);
  std::size_t compared = 0;
  for (const auto& [name, values] : some.values) {
    const auto other = all.values.find(name);
    if (other == all.values.end()) continue;
    ++compared;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isnan(values[i])) {
        EXPECT_TRUE(std::isnan(other->second[i])) << name << " " << i;
      } else {
        ASSERT_NEAR(values[i], other->second[i], tolerance) << name << " in row " << i;
      }
    }
  }
  EXPECT_GT(compared, some.values.size() / 2);
}

TEST_F(Convert, BvhToAmcAndBackLeavesEveryJointInItsPlace) {
  synth("walk.bvh");
  convert("walk.bvh", "walk.amc");
  EXPECT_TRUE(fs::exists(folder / "walk.asf"));
  convert("walk.amc", "again.bvh", {"--from-fps", "60"});
  const Columns before = positions("walk.bvh"),
                middle = positions("walk.amc", {"--from-fps", "60"}),
                after = positions("again.bvh");
  expect_same(before, middle, 2e-3);
  expect_same(before, after, 2e-3);
}

TEST_F(Convert, BvhToCsvAndBackIsTheSameFile) {
  synth("walk.bvh");
  convert("walk.bvh", "plain.bvh", {"--plain"});
  convert("walk.bvh", "walk.csv");
  convert("walk.csv", "again.bvh");
  EXPECT_EQ(contents(folder / "again.bvh"), contents(folder / "plain.bvh"));
}

TEST_F(Convert, MarkersGoThroughEveryFormatWithTheirGaps) {
  put(folder / "in.csv",
      "# units: mm\n# rate_hz: 50\nframe,time_s,A_x,A_y,A_z,B_x,B_y,B_z\n"
      "1,0,1.5,2,3,4,5,6.25\n2,0.02,,,,4.5,5,6\n3,0.04,2,2,3,,,\n4,0.06,2.5,2,3,5.5,5,6\n");
  const Columns before = columns_of(folder / "in.csv");
  convert("in.csv", "one.c3d");
  convert("one.c3d", "two.trc");
  convert("two.trc", "three.c3d");
  convert("three.c3d", "out.csv");
  const Columns after = columns_of(folder / "out.csv");
  expect_same(before, after, 1e-6);
  EXPECT_TRUE(std::isnan(after.values.at("A_y").at(1)));
  EXPECT_TRUE(std::isnan(after.values.at("B_z").at(2)));
  EXPECT_THAT(contents(folder / "out.csv"), HasSubstr("mm"));
}

TEST_F(Convert, JointsBecomeMarkersInMillimetres) {
  synth("walk.bvh");
  const Ran ran = run({"convert", "walk.bvh", "-o", "walk.c3d"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("the unit is taken to be"));
  const Json take = Json::parse(run({"info", "walk.c3d", "--json"}).out).at("takes").at(0);
  EXPECT_EQ(take.at("unit"), "mm");
  EXPECT_EQ(take.at("kind"), "markers");
  const Json skeleton = Json::parse(run({"info", "walk.bvh", "--json"}).out).at("takes").at(0);
  EXPECT_EQ(take.at("marker_count"), skeleton.at("joint_count"));
  EXPECT_EQ(take.at("frames"), skeleton.at("frames"));
}

TEST_F(Convert, ChangesRateAxesAndUnitOnlyWhenAsked) {
  synth("walk.bvh");
  const Columns as_it_was = positions("walk.bvh");
  const Columns half = positions("walk.bvh", {"--fps", "30"});
  EXPECT_EQ(half.rows, (as_it_was.rows + 1) / 2);
  const Columns turned = positions("walk.bvh", {"--up", "z", "--from-up", "y"});
  const std::string hip = as_it_was.values.count("Hips_y") ? "Hips" : "";
  ASSERT_EQ(hip, "Hips");
  for (std::size_t i = 0; i < as_it_was.rows; ++i)
    EXPECT_NEAR(turned.values.at("Hips_z")[i], as_it_was.values.at("Hips_y")[i], 1e-3);
  const Columns metres = positions("walk.bvh", {"--unit", "m"});
  for (std::size_t i = 0; i < as_it_was.rows; ++i)
    EXPECT_NEAR(1000 * metres.values.at("Hips_y")[i], as_it_was.values.at("Hips_y")[i], 1e-2);
}

TEST_F(Convert, SaysWhichAxisItTookForUp) {
  synth("walk.bvh", "walk", "2");
  const Ran ran = run({"convert", "walk.bvh", "--up", "z", "-o", "up.bvh"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("y is taken to be the vertical axis"));
}

TEST_F(Convert, RefusesMarkersWhereJointsAreNeeded) {
  put(folder / "in.csv",
      "# units: mm\n# rate_hz: 50\nframe,time_s,A_x,A_y,A_z\n1,0,1,2,3\n2,0.02,1,2,3\n");
  const Ran ran = run({"convert", "in.csv", "-o", "out.bvh"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("bvh files hold joints"));
  EXPECT_THAT(ran.err, IsOneLine());
  EXPECT_FALSE(fs::exists(folder / "out.bvh"));
}

TEST_F(Convert, WritesNoAmcWithoutAPlaceForItsSkeleton) {
  synth("walk.bvh");
  const Ran ran = run({"convert", "walk.bvh", "--to", "amc", "-o", "-"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, IsOneLine());
  put(folder / "walk.asf", "dear");
  EXPECT_EQ(run({"convert", "walk.bvh", "-o", "walk.amc"}).code, 4);
  EXPECT_EQ(contents(folder / "walk.asf"), "dear");
  EXPECT_FALSE(fs::exists(folder / "walk.amc"));
}

TEST_F(Convert, WritesGltfForViewers) {
  synth("walk.bvh");
  convert("walk.bvh", "walk.glb");
  EXPECT_THAT(contents(folder / "walk.glb"), StartsWith("glTF"));
  EXPECT_EQ(run({"info", "walk.glb"}).code, 0);
  convert("walk.glb", "walk.gltf");
  convert("walk.gltf", "again.glb");
  EXPECT_EQ(contents(folder / "again.glb"), contents(folder / "walk.glb"));
}

class Endings : public Program {
 protected:
  void SetUp() override { synth("walk.bvh"); }

  void expect_refused(std::vector<std::string> words, const std::string& output,
                      const std::string& written) {
    words.insert(words.end(), {"-o", output});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 2) << words[0];
    EXPECT_THAT(ran.err, IsOneLine()) << words[0];
    EXPECT_THAT(ran.err, AllOf(HasSubstr(output), HasSubstr("not written"), HasSubstr(written)));
    EXPECT_EQ(ran.out, "");
    EXPECT_THAT(files(), Not(Contains(output))) << words[0];
  }
};

TEST_F(Endings, OfFormatsThatAreNotWrittenAreRefusedByEveryCommand) {
  for (const char* output : {"out.obj", "out.png", "out.usd", "out.bvhh", "out.C3D.zip"}) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"clean", "walk.bvh"},
                                               {"fill", "walk.bvh"},
                                               {"convert", "walk.bvh"},
                                               {"corrupt", "walk.bvh", "--damage", "gaussian"},
                                               {"synth", "walk"},
                                               {"clean", "walk.bvh", "--dry-run"},
                                               {"view", "walk.bvh"}})
      expect_refused(
          words, output,
          ".bvh, .amc, .asf, .c3d, .trc, .tsv, .csv, .glb, .vrm, .vrma, .gltf, .fbx, .npz");
    expect_refused({"plot", "walk.bvh"}, output, "only .svg");
  }
  expect_refused({"plot", "walk.bvh"}, "out.bvh", "only .svg");
}

TEST_F(Endings, AreRefusedBeforeTheInputIsRead) {
  const Ran ran = run({"clean", "absent.bvh", "-o", "out.obj"});
  EXPECT_EQ(ran.code, 2);
  EXPECT_THAT(ran.err, HasSubstr("out.obj"));
}

TEST_F(Endings, ThatAreAbsentKeepTheFormatOfTheInput) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"clean", "walk.bvh"},
                                             {"fill", "walk.bvh"},
                                             {"convert", "walk.bvh"},
                                             {"corrupt", "walk.bvh", "--damage", "gaussian"},
                                             {"synth", "walk"}}) {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"-o", "out", "--force"});
    ASSERT_EQ(run(all).code, 0) << words[0];
    EXPECT_THAT(contents(folder / "out"), StartsWith("HIERARCHY")) << words[0];
  }
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "picture"}).code, 0);
  EXPECT_THAT(contents(folder / "picture"), HasSubstr("<svg"));
  EXPECT_EQ(run({"plot", "walk.bvh", "-o", "picture.SVG"}).code, 0);
}

TEST_F(Endings, OfAFormatThatIsNamedMayBeAny) {
  EXPECT_EQ(run({"convert", "walk.bvh", "-o", "walk.txt", "--to", "csv"}).code, 0);
  EXPECT_THAT(contents(folder / "walk.txt"), StartsWith("# rate_hz"));
}

TEST_F(Endings, OfAFormatThatCannotHoldTheTakeAreRefusedBeforeWork) {
  for (const char* command : {"clean", "fill"}) {
    const Ran ran = run({command, "walk.bvh", "-o", "out.c3d"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_THAT(ran.err, HasSubstr("walk.bvh: holds joints; c3d files hold markers"));
  }
}

TEST_F(Endings, ThatAreWrongAreSaidAndPutRightInTheResult) {
  const std::string bytes = contents(folder / "walk.bvh");
  fs::rename(folder / "walk.bvh", folder / "walk.c3d");
  for (const char* command : {"clean", "fill"}) {
    const Ran ran = run({command, "walk.c3d"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.err, HasSubstr("walk.c3d: the name ends in .c3d, but the "
                                   "content is bvh (Biovision hierarchy): read as bvh"))
        << command;
  }
  EXPECT_THAT(contents(folder / "walk.clean.bvh"), StartsWith("HIERARCHY"));
  EXPECT_EQ(contents(folder / "walk.filled.bvh"), bytes);
  EXPECT_EQ(run({"clean", "walk.c3d", "--output-dir", "out"}).code, 0);
  EXPECT_THAT(contents(folder / "out/walk.bvh"), StartsWith("HIERARCHY"));
  EXPECT_EQ(run({"batch", "walk.c3d", "-o", "batch"}).code, 0);
  EXPECT_THAT(contents(folder / "batch/walk.bvh"), StartsWith("HIERARCHY"));
  const Ran info = run({"info", "walk.c3d"});
  EXPECT_THAT(info.out, AllOf(HasSubstr("bvh (Biovision hierarchy)"), HasSubstr("ends in .c3d")));
  const Ran strict = run({"clean", "walk.c3d", "--strict", "--force"});
  EXPECT_EQ(strict.code, 1);
  EXPECT_THAT(strict.err, HasSubstr("walk.c3d: the name ends in .c3d"));
  // An explicit --from suppresses the warning.
  EXPECT_EQ(run({"clean", "walk.c3d", "--from", "bvh", "--strict", "--force"}).err, "");
}

TEST_F(Endings, ThatAreUnknownAreReplacedInTheResult) {
  fs::copy_file(folder / "walk.bvh", folder / "walk.dat");
  fs::copy_file(folder / "walk.bvh", folder / "plain");
  ASSERT_EQ(run({"clean", "walk.dat"}).code, 0);
  ASSERT_EQ(run({"clean", "plain"}).code, 0);
  EXPECT_THAT(files(), AllOf(Contains("walk.clean.bvh"), Contains("plain.clean.bvh")));
}

TEST_F(Endings, OfMarkersSayTheGuessedUnitOnce) {
  const Ran ran = run({"convert", "walk.bvh", "out.trc"});
  ASSERT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, AllOf(IsOneLine(), HasSubstr("walk.bvh: the unit is taken to be")));
  const Ran metres = run({"convert", "walk.bvh", "metres.trc", "--unit", "m"});
  EXPECT_THAT(metres.err, IsOneLine());
}

TEST_F(Endings, DoNotMatterForAFileThatWasCutOff) {
  std::string text = contents(folder / "walk.bvh");
  put(folder / "cut.bvh", text.substr(0, text.size() - 20));
  const Ran ran = run({"clean", "cut.bvh"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("the file ends in the middle of frame 30"));
  EXPECT_EQ(run({"clean", "cut.bvh", "--strict", "--force"}).code, 1);
  const Ran again = run({"info", "cut.clean.bvh", "--json"});
  EXPECT_EQ(Json::parse(again.out)["takes"][0]["frames"], 29);
  EXPECT_TRUE(Json::parse(again.out)["takes"][0]["diagnostics"].empty());
}

}  // namespace
}  // namespace kinemend::test
