#include "io/hostile.hpp"
#include "io/npz/npy_array.hpp"
#include "kinemend/lab/synth.hpp"
#include "npz_support.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(NpzWriter, EveryFixtureComesBackToTheByte) {
  for (const auto& path : fixture_paths("npz")) {
    if (path.parent_path().filename() != "good") continue;
    SCOPED_TRACE(path);
    const std::string bytes = read_file(path);
    const TakeResult result = read_npz_bytes(bytes);
    expect_written_back(result, bytes, "npz", {});
  }
}

// The names of the members whose unpacked bytes differ.
std::vector<std::string> changed_members(const std::string& before, const std::string& after) {
  std::vector<std::string> changed;
  const ZipArchive archive = read_zip(after, "after");
  for (const ZipMember& member : archive.members) {
    const std::string name = member.name.substr(0, member.name.rfind('.'));
    if (npz_content(before, name) != npz_content(after, name)) changed.push_back(name);
  }
  return changed;
}

TEST(NpzWriter, AChangedJointChangesItsSamplesAndNoOtherArray) {
  const std::string bytes = npz_fixture("good/other_arrays");
  Take take = read_npz_bytes(bytes).take;
  const Quat turned = normalized(take.rotation(2, 1) * exp({0.1, 0, 0.2}));
  take.rotation(2, 1) = turned;
  const std::string written = write_take(take);
  EXPECT_EQ(changed_members(bytes, written), std::vector<std::string>{"rotations"});
  const Take again = read_npz_bytes(written).take;
  EXPECT_EQ(again.rotations, take.rotations);
  EXPECT_EQ(again.rotation(2, 1), turned);
  EXPECT_EQ(again.positions, take.positions);
  EXPECT_EQ(write_take(again), written);
}

TEST(NpzWriter, OfSingleNumbersTheUnchangedOnesKeepTheirValues) {
  Take take = read_npz_bytes(npz_fixture("good/float32")).take;
  const Take before = take;
  take.root_position(3).y = 0.3;
  const Take again = read_npz_bytes(write_take(take)).take;
  EXPECT_EQ(again.positions, take.positions);
  EXPECT_EQ(again.rotations, before.rotations);
}

TEST(NpzWriter, AFilledGapIsMarkedAsSeen) {
  Take take = read_npz_bytes(npz_fixture("good/gaps")).take;
  ASSERT_FALSE(take.is_observed(1, 2));
  take.observed[1 * 3 + 2] = 1;
  EXPECT_TRUE(read_npz_bytes(write_take(take)).take.is_observed(1, 2));
  Take zero = read_npz_bytes(npz_fixture("good/odd_lengths")).take;
  ASSERT_FALSE(zero.is_observed(2, 1));
  zero.observed.clear();
  const Take filled = read_npz_bytes(write_take(zero)).take;
  EXPECT_TRUE(filled.is_observed(2, 1));
  EXPECT_LE(angle_between(filled.rotation(2, 1), zero.rotation(2, 1)), 1e-12);
}

TEST(NpzWriter, ANewGapIsWrittenIntoTheMask) {
  Take take = read_npz_bytes(npz_fixture("good/joints")).take;
  take.observed.assign(take.rotations.size(), 1);
  take.observed[4] = 0;
  const Take again = read_npz_bytes(write_take(take)).take;
  EXPECT_EQ(again.observed, take.observed);
  EXPECT_EQ(again.rotations, take.rotations);
}

TEST(NpzWriter, ATakeOfAnotherFormatComesBackWithRestEndsAndUnits) {
  Take take = read_npz_bytes(npz_fixture("good/rest")).take;
  take.source = {};
  const Take again = read_npz_bytes(write_take(take, "npz")).take;
  EXPECT_EQ(again.skeleton.rest_rotations, take.skeleton.rest_rotations);
  EXPECT_EQ(again.skeleton.end_sites[0].offset, take.skeleton.end_sites[0].offset);
  EXPECT_EQ(again.metres_per_unit, take.metres_per_unit);
  expect_same_motion(again, take, 1e-12);
}

TEST(NpzWriter, BvhToNpzAndBackIsTheSameMotion) {
  const Take bvh = read_joints(std::filesystem::path(KINEMEND_TAKES) / "walk.bvh").take;
  const Take npz = read_npz_bytes(write_take(bvh, "npz")).take;
  EXPECT_EQ(npz.rotations, bvh.rotations);
  EXPECT_EQ(npz.positions, bvh.positions);
  EXPECT_EQ(npz.skeleton.names, bvh.skeleton.names);
  const Take back = read_text(write_take(npz, "bvh"));
  expect_same_motion(back, bvh, 1e-6);
}

TEST(NpzWriter, OtherFramesMakeANewFileAndTheLossIsNamed) {
  const Take take = read_npz_bytes(npz_fixture("good/other_arrays")).take;
  Take part = slice(take, 1, 4);
  part.source = take.source;
  const Diagnostics losses = lost_in_writing(part, "npz");
  ASSERT_EQ(losses.count("not_kept"), 1u);
  EXPECT_NE(losses.entries()[0].message.find("array contacts"), std::string::npos);
  EXPECT_EQ(read_npz_bytes(write_take(part)).take.rotations, part.rotations);
  EXPECT_TRUE(lost_in_writing(take, "npz").empty());
}

TEST(NpzWriter, NamesOfAnyBytesComeBack) {
  Take take = read_npz_bytes(npz_fixture("good/joints")).take;
  take.source = {};
  take.skeleton.names = {"\xFF\x80 latin", "\xF0\x9F\x95\xBA", ""};
  const Take again = read_npz_bytes(write_take(take, "npz")).take;
  EXPECT_EQ(again.skeleton.names, take.skeleton.names);
  take.skeleton.names[0] = std::string(30u << 20, 'x');
  EXPECT_THROW(write_take(take, "npz"), Error);
}

}  // namespace
}  // namespace kinemend
