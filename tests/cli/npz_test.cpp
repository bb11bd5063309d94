// Tests of takes as arrays of NumPy: through files, through pipes, and in place.
#include "cli/program.hpp"

namespace kinemend::test {
namespace {

using Npz = Program;
using testing::HasSubstr;

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
