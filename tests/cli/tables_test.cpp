// Tests of other programs' tables, and of arrays of NumPy: through files, through pipes, in place.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Tables as laboratories export them.
class Tables : public Program {
 protected:
  Json info(const std::string& take) {
    const Ran ran = run({"info", take, "--json"});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return Json::parse(ran.out).at("takes").at(0);
  }
};

TEST_F(Tables, AreReadAsTheirProgramsMeanThem) {
  struct Table {
    const char* name;
    std::size_t markers, frames;
    double rate_hz;
    const char* unit;
  };
  for (const Table& table : {Table{"csv/good/nexus.csv", 2, 3, 100, "mm"},
                             Table{"csv/good/vicon_old.csv", 3, 3, 240, "mm"},
                             Table{"csv/good/motive_125.csv", 2, 4, 120, "Millimeters"},
                             Table{"tsv/good/labels.tsv", 2, 3, 120, "mm"},
                             Table{"trc/good/commas_filled.trc", 2, 3, 100, "mm"},
                             Table{"trc/good/semicolons_decimal.trc", 2, 3, 100, "mm"}}) {
    SCOPED_TRACE(table.name);
    const Json take = info(fixture(table.name));
    EXPECT_EQ(take.at("marker_count"), table.markers);
    EXPECT_EQ(take.at("frames"), table.frames);
    EXPECT_EQ(take.at("frame_rate_hz"), table.rate_hz);
    EXPECT_EQ(take.at("unit"), table.unit);
  }
}

TEST_F(Tables, OfAnythingElseAreRefusedByName) {
  const std::pair<const char*, const char*> tables[] = {
      {"csv/bad/nexus_without_trajectories.csv", "without Trajectories: no markers to clean"},
      {"csv/bad/motive_rigid_bodies.csv", "without measured markers: no markers to clean"},
      {"tsv/bad/rigid_bodies.tsv", "a Qualisys table of \"6D\" data"},
      {"tsv/bad/analog.tsv", "a Qualisys table of \"ANALOG\" data"},
      {"trc/bad/commas_of_two_kinds.trc", "cannot be told apart"}};
  for (const auto& [name, message] : tables) {
    SCOPED_TRACE(name);
    const std::string take = fixture(name);
    const Ran ran = run({"clean", take, "-o", "out.csv"});
    EXPECT_EQ(ran.code, 3);
    EXPECT_THAT(ran.err, AllOf(HasSubstr(take + ":"), HasSubstr(message), IsOneLine()));
    EXPECT_FALSE(fs::exists(folder / "out.csv"));
  }
}

TEST_F(Tables, WithoutARateAreSaidToBeAtAnAssumedOne) {
  const Ran ran = run({"convert", fixture("csv/good/head_unknown.csv"), "-o", "out.trc"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, AllOf(HasSubstr("120 Hz assumed"), HasSubstr("not understood")));
}

TEST_F(Tables, ComeBackInTheirOwnLayout) {
  for (const char* const name :
       {"csv/good/nexus.csv", "csv/good/motive_125.csv", "tsv/good/labels.tsv"}) {
    SCOPED_TRACE(name);
    const std::string take = fixture(name), out = "out-" + take;
    ASSERT_EQ(run({"convert", take, "-o", out}).code, 0);
    EXPECT_EQ(contents(folder / out), contents(folder / take));
    const Ran filled = run({"fill", take, "-o", "filled-" + take, "--method", "spline"});
    EXPECT_EQ(filled.code, 0) << filled.err;
    // The header is kept byte for byte.
    const std::string head = contents(folder / take).substr(0, 300);
    EXPECT_EQ(contents(folder / ("filled-" + take)).substr(0, 300), head);
  }
}

TEST_F(Tables, OtherSectionsThatANewLayoutLosesAreNamed) {
  const std::string take = fixture("csv/good/nexus.csv");
  const Ran ran = run({"convert", take, "--unit", "m", "-o", "out.csv"});
  EXPECT_EQ(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("the sections Devices, Model Outputs, Events are left out"));
  EXPECT_EQ(run({"convert", take, "-o", "out.trc", "--strict"}).code, 1);
  EXPECT_FALSE(fs::exists(folder / "out.trc"));
}

using Npz = Program;

TEST_F(Npz, PipesGiveTheBytesThatFilesGive) {
  noisy("walk.bvh");
  ASSERT_EQ(run({"convert", "walk.bvh", "walk.npz"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.npz", "-o", "file.npz"}).code, 0);
  const Setting piped{contents(folder / "walk.npz"), {}, {}};
  const Ran ran = run({"clean", "-", "--from", "npz", "-o", "-"}, piped);
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_EQ(ran.out, contents(folder / "file.npz"));
  EXPECT_THAT(ran.err, HasSubstr("spike"));
}

TEST_F(Npz, IsCleanedAsTheSameTakeInBvh) {
  noisy("walk.bvh");
  ASSERT_EQ(run({"convert", "walk.bvh", "walk.npz"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.bvh", "-o", "clean.bvh"}).code, 0);
  ASSERT_EQ(run({"clean", "walk.npz", "-o", "clean.npz"}).code, 0);
  const Ran ran = run({"compare", "clean.bvh", "clean.npz", "--json"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  // The limit is the rounding of the BVH file.
  EXPECT_LT(Json::parse(ran.out)["takes"][0]["figures"]["geodesic_rms_deg"].get<double>(), 2e-4);
}

TEST_F(Npz, ArraysThatTheProgramDoesNotKnowStay) {
  const std::string name = fixture("npz/good/other_arrays.npz");
  EXPECT_THAT(run({"info", name}).out, HasSubstr("contacts, heading, table"));
  const Ran ran = run({"clean", name, "-o", "clean.npz", "-m", "gaussian"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(run({"info", "clean.npz"}).out, HasSubstr("contacts, heading, table"));
  EXPECT_EQ(run({"clean", "clean.npz", "-o", "same.npz", "--strength", "0"}).code, 0);
  EXPECT_EQ(contents(folder / "same.npz"), contents(folder / "clean.npz"));
}

TEST_F(Npz, ABatchPassesOverArraysOfOtherThings) {
  fs::create_directory(folder / "raw");
  for (const char* const name : {"good/joints.npz", "bad/nothing.npz"}) {
    const fs::path path = fs::path(KINEMEND_TEST_FIXTURES) / "npz" / name;
    fs::copy_file(path, folder / "raw" / path.filename());
  }
  const Ran ran = run({"batch", "raw", "-o", "out"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_TRUE(fs::exists(folder / "out/joints.npz"));
  EXPECT_FALSE(fs::exists(folder / "out/nothing.npz"));
}

TEST_F(Npz, ADamagedFileIsOneLineAndExitCode3) {
  put(folder / "cut.npz", contents(fs::path(KINEMEND_TEST_FIXTURES) / "npz/bad/cut.npz"));
  const Ran ran = run({"clean", "cut.npz"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("cut.npz: byte "));
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1);
}

}  // namespace
}  // namespace kinemend::test
