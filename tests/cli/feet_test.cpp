// Tests of the feet flags and of files of contacts; of feet with meaningless names, feet of several
// people, and feet that never stand.
#include <algorithm>
#include <sstream>
#include <utility>

#include "cli/plate.hpp"
#include "cli/program.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"

namespace kinemend::test {
namespace {

using Feet = Program;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST_F(Feet, AreHeldWhenAskedFor) {
  synth("walk.bvh", "walk", "3");
  const Ran plain = run({"clean", "walk.bvh", "-o", "plain.bvh", "--method", "gaussian"});
  EXPECT_EQ(plain.code, 0) << plain.err;
  EXPECT_THAT(plain.out, Not(HasSubstr("feet:")));
  const Ran ran =
      run({"clean", "walk.bvh", "-o", "held.bvh", "--method", "gaussian", "--feet", "force"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("  feet: "));
  EXPECT_THAT(ran.out,
              testing::ContainsRegex("held for [0-9.]+ s; [0-9]+ frames adjusted; slide "));
  // Legs are reported like other joints: none was repaired, and they changed.
  EXPECT_THAT(ran.out, HasSubstr("changed, 0 frames repaired"));
  EXPECT_THAT(ran.out, Not(testing::ContainsRegex("Leg.* 0 +0\n")));
  EXPECT_THAT(ran.out, HasSubstr("knee pop "));
}

TEST_F(Feet, AreToldToPrograms) {
  synth("walk.bvh", "walk", "3");
  const Ran ran = run({"clean", "walk.bvh", "-o", "out.bvh", "--method", "gaussian", "--feet",
                       "force", "--report", "report.json", "--json"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json take = Json::parse(ran.out)["takes"][0];
  const Json feet = take["feet"];
  EXPECT_GT(feet["held"], 4);
  EXPECT_GT(feet["frames_adjusted"], 100);
  EXPECT_EQ(take["figures"]["frames_repaired"], 0);
  EXPECT_LT(feet["after"]["most_slide"], 0.1);
  EXPECT_EQ(feet["contacts"][0]["side"], "left");
  EXPECT_EQ(feet["contacts"][0]["held"], true);
  const Json spans = Json::parse(contents(folder / "report.json"))["takes"][0]["findings"];
  bool adjusted = false;
  for (const Json& span : spans) adjusted = adjusted || span["verdict"] == "foot_adjusted";
  EXPECT_TRUE(adjusted);
}

TEST_F(Feet, OfMarkersAreListedAndShownByCheck) {
  synth("walk.bvh", "walk", "3");
  const Take joints = read_take(folder / "walk.bvh").take;
  Take markers = joint_markers(joints, true);
  for (const auto& [joint, marker] :
       {std::pair("LeftFoot", "LHEE"), std::pair("LeftToeBase", "LTOE"),
        std::pair("RightFoot", "RHEE"), std::pair("RightToeBase", "RTOE")}) {
    std::replace(markers.names.begin(), markers.names.end(), std::string(joint),
                 std::string(marker));
  }
  markers.unit = "cm";
  put(folder / "walk.trc", write_take(markers, "trc"));
  const Ran listed = run({"contacts", "walk.trc"});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.out, testing::ContainsRegex("\nleft toe [0-9]+ [0-9]+  # [01]\\.[0-9]+\n"));
  EXPECT_EQ(run({"contacts", "walk.trc", "--to", "glb", "-o", "walk.glb"}).code, 2);
  EXPECT_THAT(run({"check", "walk.trc"}).out,
              testing::ContainsRegex("feet stand +stand for [0-9.]+ s, about [0-9.]+ s expected"));
  const Json stands = Json::parse(run({"check", "walk.trc", "--json"}).out)["takes"][0]["stands"];
  EXPECT_EQ(stands["contacts"][0]["side"], "left");
  EXPECT_GT(stands["contacts"][0]["confidence"], 0.5);
  EXPECT_FALSE(stands["ground"].empty());
  EXPECT_TRUE(stands["loads"].empty());
}

TEST_F(Feet, OfMarkersThatAreNotRecognisedAreSaidToBeMissing) {
  put(folder / "plate.trc", plate_take());
  const Ran listed = run({"contacts", "plate.trc"});
  EXPECT_EQ(listed.code, 0);
  EXPECT_THAT(listed.err, HasSubstr("no feet with markers on heel and toe found"));
}

TEST_F(Feet, CanBeListedEditedAndHeldAsListed) {
  synth("walk.bvh", "walk", "3");
  const Ran listed = run({"contacts", "walk.bvh", "-o", "walk.contacts"});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(contents(folder / "walk.contacts"), HasSubstr("# Times in which a foot stands"));
  EXPECT_THAT(contents(folder / "walk.contacts"), HasSubstr("\nleft heel "));
  EXPECT_EQ(run({"contacts", "walk.bvh"}).out, contents(folder / "walk.contacts"));
  put(folder / "mine.contacts", "left toe 100 130\n");
  const Ran ran = run({"clean", "walk.bvh", "-o", "held.bvh", "--contacts", "mine.contacts"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("feet: stand for 0.5 s, "));
  EXPECT_THAT(ran.out, HasSubstr("confidence 1.00; held for 0.5 s; "));
}

TEST_F(Feet, AreHeldByDefaultWhereTheSourceHasSlowErrors) {
  synth("walk.bvh", "walk", "4");
  EXPECT_EQ(run({"corrupt", "walk.bvh", "--damage", "system:kind=video", "-o", "video.bvh"}).code,
            0);
  const std::vector<std::string> words = {"clean", "video.bvh", "-o", "out.bvh", "--force"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run(all).out;
  };
  EXPECT_THAT(with({}), Not(HasSubstr("feet:")));
  EXPECT_THAT(with({"--source", "optical"}), Not(HasSubstr("feet:")));
  EXPECT_THAT(with({"--source", "video"}), HasSubstr("feet: stand for "));
  EXPECT_THAT(with({"--source", "video", "--feet", "off"}), Not(HasSubstr("feet:")));
}

TEST_F(Feet, AreWrittenAsCurvesForEngines) {
  synth("walk.bvh", "walk", "3");
  const Ran csv = run({"contacts", "walk.bvh", "--to", "csv"});
  EXPECT_EQ(csv.code, 0) << csv.err;
  EXPECT_THAT(csv.out, testing::StartsWith("frame,time_s,contact_l,contact_r\n1,0,"));
  EXPECT_EQ(std::count(csv.out.begin(), csv.out.end(), '\n'), 181);
  const Json json = Json::parse(run({"contacts", "walk.bvh", "--to", "json"}).out);
  EXPECT_GT(json["takes"][0]["feet"]["contacts"][0]["confidence"], 0.5);
  for (const std::string format : {"fbx", "glb"}) {
    const std::string name = "walk." + format;
    EXPECT_EQ(run({"contacts", "walk.bvh", "--to", format}).code, 2);
    const Ran ran = run({"contacts", "walk.bvh", "--to", format, "-o", name});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(contents(folder / name), HasSubstr("contact_l"));
    EXPECT_THAT(run({"info", name}).out, HasSubstr("180 frames"));
  }
}

TEST_F(Feet, RefuseFilesOfContactsThatDoNotFit) {
  synth("walk.bvh", "walk", "2");
  put(folder / "bad.contacts", "left heel 1 10\nleft toe 900 910\n");
  const Ran ran = run({"clean", "walk.bvh", "-o", "held.bvh", "--contacts", "bad.contacts"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("bad.contacts:2: expected a first frame of 1 to 120"));
  EXPECT_FALSE(fs::exists(folder / "held.bvh"));
  EXPECT_EQ(run({"clean", "walk.bvh", "--contacts", "none.contacts", "-o", "held.bvh"}).code, 3);
  EXPECT_EQ(
      run({"clean", "walk.bvh", "walk.bvh", "--output-dir", "o", "--contacts", "bad.contacts"})
          .code,
      2);
  EXPECT_EQ(run({"clean", "walk.bvh", "-o", "held.bvh", "--feet", "sometimes"}).code, 2);
}

TEST_F(Feet, MayBeAskedForInAConfigurationFileAndABatch) {
  fs::create_directory(folder / "raw");
  synth("raw/walk.bvh", "walk", "2");
  put(folder / "lab.toml", "method = \"gaussian\"\nfeet = \"force\"\n");
  const Ran ran = run({"batch", "raw", "-o", "clean", "--config", "lab.toml"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  const Json row = Json::parse(lines_of(contents(folder / "clean/rows.jsonl"))[0]);
  EXPECT_GT(row["feet"]["held"], 2);
  EXPECT_FALSE(row["feet"].contains("contacts"));
}

class FeetNames : public Program {
 protected:
  /// Writes walk.bvh, a copy whose leg names are numbers, and a map that names them.
  void make_unnamed() {
    synth("walk.bvh", "walk", "3");
    std::string text = contents(folder / "walk.bvh"), map = "# known,here\n";
    int number = 7;
    for (const std::string name : {"LeftToeBase", "LeftFoot", "RightToeBase", "RightFoot"}) {
      const std::string other = "bone_" + std::to_string(number++);
      ASSERT_NE(text.find(name), std::string::npos) << name;
      text = replaced(text, name, other);
      map += name + "," + other + "\n";
    }
    put(folder / "unnamed.bvh", text);
    put(folder / "names.csv", map);
  }

  Json check(const std::vector<std::string>& words) {
    std::vector<std::string> all = {"check", "--json"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = run(all);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out)["takes"][0];
  }
};

TEST_F(FeetNames, AMapServesCheckAsNamesDo) {
  make_unnamed();
  const Json named = check({"walk.bvh"}), unnamed = check({"unnamed.bvh"});
  const Json mapped = check({"unnamed.bvh", "--map", "names.csv"});
  EXPECT_FALSE(named["figures"]["slide_cm"].is_null());
  EXPECT_TRUE(unnamed["figures"]["slide_cm"].is_null());
  EXPECT_EQ(mapped["figures"], named["figures"]);
}

TEST_F(FeetNames, AMapServesContactsAsNamesDo) {
  make_unnamed();
  const std::string named = run({"contacts", "walk.bvh"}).out;
  EXPECT_THAT(named, HasSubstr("\nleft heel "));
  const Ran unnamed = run({"contacts", "unnamed.bvh"});
  EXPECT_THAT(unnamed.out, Not(HasSubstr("\nleft ")));
  EXPECT_THAT(unnamed.err, HasSubstr("no legs found; --map FILE gives"));
  const Ran mapped = run({"contacts", "unnamed.bvh", "--map", "names.csv", "-o", "walk.contacts"});
  EXPECT_EQ(mapped.code, 0) << mapped.err;
  EXPECT_EQ(mapped.err, "");
  EXPECT_EQ(contents(folder / "walk.contacts"), named);
}

TEST_F(FeetNames, AMapServesTheFeetOfCleanAndBatchAsNamesDo) {
  make_unnamed();
  const auto feet = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "clean");
    words.insert(words.end(), {"-m", "gaussian", "--json", "--force", "-o", "out.bvh"});
    const Ran ran = run(words);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out)["takes"][0]["feet"];
  };
  const Json named = feet({"walk.bvh", "--feet", "force"});
  ASSERT_GT(named["held"], 4);
  const std::string out = contents(folder / "out.bvh");
  EXPECT_EQ(feet({"unnamed.bvh", "--feet", "force", "--map", "names.csv"}), named);
  std::string back = contents(folder / "out.bvh");
  EXPECT_THAT(back, HasSubstr("bone_7")) << "the names of the take stay";
  for (const auto& [other, name] :
       std::vector<std::pair<std::string, std::string>>{{"bone_7", "LeftToeBase"},
                                                        {"bone_8", "LeftFoot"},
                                                        {"bone_9", "RightToeBase"},
                                                        {"bone_10", "RightFoot"}})
    back = replaced(back, other, name);
  EXPECT_EQ(replaced(back, "LeftToeBase0", "RightFoot"), out);
  EXPECT_EQ(feet({"unnamed.bvh", "--feet", "force"})["held"], 0);

  ASSERT_EQ(run({"contacts", "walk.bvh", "-o", "walk.contacts"}).code, 0);
  const Json held = feet({"walk.bvh", "--contacts", "walk.contacts"});
  EXPECT_EQ(feet({"unnamed.bvh", "--contacts", "walk.contacts", "--map", "names.csv"}), held);

  const Ran alone = run({"clean", "unnamed.bvh", "-m", "auto", "--map", "names.csv", "--dry-run"});
  EXPECT_EQ(alone.code, 2) << "without feet it is about the model of a method";
  fs::create_directory(folder / "raw");
  fs::copy_file(folder / "unnamed.bvh", folder / "raw/unnamed.bvh");
  const Ran batch = run(
      {"batch", "raw", "-o", "clean", "-m", "gaussian", "--feet", "force", "--map", "names.csv"});
  EXPECT_EQ(batch.code, 0) << batch.err;
  EXPECT_EQ(Json::parse(lines_of(contents(folder / "clean/rows.jsonl"))[0])["feet"]["held"],
            named["held"]);
}

TEST_F(FeetNames, AMapThatNamesWhatIsNotThereIsRefused) {
  make_unnamed();
  put(folder / "wrong.csv", "LeftFoot,bone_99\n");
  put(folder / "bad.csv", "LeftFoot\n");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", "unnamed.bvh"},
        {"contacts", "unnamed.bvh"},
        {"clean", "unnamed.bvh", "-m", "auto", "--dry-run", "--feet", "auto"}}) {
    auto with = [&](const std::string& map) {
      std::vector<std::string> all = words;
      all.insert(all.end(), {"--map", map});
      return run(all);
    };
    EXPECT_EQ(with("wrong.csv").code, 2);
    EXPECT_THAT(with("wrong.csv").err, HasSubstr("the take has no \"bone_99\"")) << words[0];
    EXPECT_THAT(with("bad.csv").err, HasSubstr("bad.csv:1: expected")) << words[0];
    EXPECT_EQ(with("missing.csv").code, 3) << words[0];
  }
}

/// The rows of a table of markers by their cells.
std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& line : lines_of(text)) {
    std::vector<std::string> cells;
    std::istringstream parts(line);
    for (std::string cell; std::getline(parts, cell, '\t');) cells.push_back(cell);
    rows.push_back(std::move(cells));
  }
  return rows;
}

class People : public FeetNames {
 protected:
  /// Writes ann.trc with one walk, and both.trc with Ann and with Bob, who walks three metres
  /// beside her and whose left foot slides.
  void make_people() {
    synth("walk.bvh", "walk", "3");
    ASSERT_EQ(run({"convert", "walk.bvh", "ann.trc"}).code, 0);
    const auto ann = rows_of(contents(folder / "ann.trc"));
    std::string text;
    const std::size_t markers = std::stoul(ann[2][3]);
    for (std::size_t row = 0; row < ann.size(); ++row) {
      std::vector<std::string> cells = ann[row];
      if (row == 2) cells[3] = std::to_string(2 * markers);
      cells.resize(row < 3 ? cells.size() : 2 + 6 * markers);
      for (std::size_t m = 0; m < markers && row >= 3; ++m) {
        const std::size_t from = 2 + 3 * m, to = 2 + 3 * (markers + m);
        if (row == 3) {
          cells[to] = "Bob:" + cells[from];
          cells[from] = "Ann:" + cells[from];
        } else if (row == 4) {
          for (std::size_t c = 0; c < 3; ++c)
            cells[to + c] = std::string(1, "XYZ"[c]) + std::to_string(markers + m + 1);
        } else if (cells[0] != "" && cells[from] != "") {
          const bool is_left_foot =
              ann[3][from].find("LeftFoot") == 0 || ann[3][from].find("LeftToe") == 0;
          // Slow enough to count as standing, and farther than Ann's foot slides in any step.
          const double slide = is_left_foot ? 1.5 * std::stod(cells[0]) : 0;
          cells[to] = std::to_string(std::stod(cells[from]) + 3000 + slide);
          cells[to + 1] = cells[from + 1];
          cells[to + 2] = cells[from + 2];
        }
      }
      for (std::size_t c = 0; c < cells.size(); ++c) text += (c == 0 ? "" : "\t") + cells[c];
      text += "\n";
    }
    put(folder / "both.trc", text);
  }
};

TEST_F(People, AreListedByInfo) {
  make_people();
  const Ran ran = run({"info", "both.trc"});
  EXPECT_THAT(ran.out, testing::ContainsRegex("subjects +Ann \\([0-9]+ markers\\), Bob \\("));
  const Json people = Json::parse(run({"info", "both.trc", "--json"}).out)["takes"][0]["subjects"];
  ASSERT_EQ(people.size(), 2u);
  EXPECT_EQ(people[0]["name"], "Ann");
  EXPECT_EQ(people[1]["name"], "Bob");
  EXPECT_EQ(people[0]["markers"], people[1]["markers"]);
  EXPECT_THAT(run({"info", "ann.trc"}).out, Not(HasSubstr("subjects")));
}

TEST_F(People, AreCheckedEachByThemselves) {
  make_people();
  const Json ann = check({"ann.trc"}), both = check({"both.trc"});
  ASSERT_FALSE(ann["figures"]["slide_cm"].is_null());
  ASSERT_EQ(both["subjects"].size(), 2u);
  EXPECT_EQ(both["subjects"][0]["name"], "Ann");
  EXPECT_EQ(both["subjects"][0]["slide_cm"], ann["figures"]["slide_cm"]);
  EXPECT_EQ(both["subjects"][0]["sink_cm"], ann["figures"]["sink_cm"]);
  EXPECT_GT(both["subjects"][1]["slide_cm"], ann["figures"]["slide_cm"]);
  EXPECT_EQ(both["figures"]["slide_cm"], both["subjects"][1]["slide_cm"]);
  EXPECT_TRUE(ann["subjects"].empty());
  const Ran text = run({"check", "both.trc"});
  EXPECT_THAT(text.out, testing::ContainsRegex("\n  Ann +[0-9]+ +[0-9.]+ "));
  EXPECT_THAT(text.out, Not(HasSubstr("Ann left foot slides")));
}

TEST_F(People, FeetThatNeverStandHaveNoFigure) {
  synth("walk.bvh", "walk", "2");
  // The feet are always in the air and faster than any standing foot.
  std::string text;
  bool is_motion = false;
  int frame = 0;
  for (const std::string& line : lines_of(contents(folder / "walk.bvh"))) {
    if (!is_motion) {
      text += line + "\n";
      is_motion = line.rfind("Frame Time", 0) == 0;
      continue;
    }
    std::istringstream parts(line);
    double x = 0, y = 0;
    parts >> x >> y;
    std::string rest;
    std::getline(parts, rest);
    text += std::to_string(x + 12.0 * frame) + " " + std::to_string(y + 9.0 * frame) + rest + "\n";
    ++frame;
  }
  put(folder / "air.bvh", text);
  const Json take = check({"air.bvh"});
  EXPECT_TRUE(take["figures"]["slide_cm"].is_null()) << take["figures"];
  EXPECT_TRUE(take["figures"]["sink_cm"].is_null());
  EXPECT_THAT(run({"check", "air.bvh"}).out,
              AllOf(testing::ContainsRegex("slide of a standing foot +no contacts found\n"),
                    Not(HasSubstr("below the floor"))));
  const Json feet = Json::parse(
      run({"clean", "air.bvh", "--feet", "force", "--dry-run", "--json"}).out)["takes"][0]["feet"];
  EXPECT_TRUE(feet["contacts"].empty());
  EXPECT_TRUE(feet["before"].is_null());
  EXPECT_TRUE(feet["after"].is_null());
  const Json compared =
      Json::parse(run({"compare", "air.bvh", "air.bvh", "--json"}).out)["takes"][0]["figures"];
  EXPECT_TRUE(compared["foot_slide"].is_null());
  EXPECT_TRUE(compared["foot_slide_reference"].is_null());
  const Ran limit = run({"compare", "air.bvh", "air.bvh", "--max-foot-slide", "1"});
  EXPECT_EQ(limit.code, 1);
  EXPECT_THAT(limit.err, HasSubstr("foot_slide is unknown because no foot has ground contact"));
}

}  // namespace
}  // namespace kinemend::test
