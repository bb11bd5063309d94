#include "io/hostile.hpp"
#include "npz_support.hpp"

namespace kinemend {
namespace {

using namespace test;

void expect_turns_about_axes(const Take& take, double tolerance) {
  ASSERT_EQ(take.joint_count(), 3u);
  ASSERT_EQ(take.frame_count(), 5u);
  const Vec3 speeds[] = {{0.1, 0, 0}, {0, -0.2, 0}, {0, 0, 0.3}};
  for (std::size_t f = 0; f < 5; ++f) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Quat expected = exp(static_cast<double>(f) * speeds[j]);
      ASSERT_LE(angle_between(take.rotation(f, j), expected), tolerance) << f << ", " << j;
    }
    ASSERT_NEAR(take.root_position(f).x, static_cast<double>(f) / 8, 1e-12);
  }
}

TEST(NpzReader, ATakeOfJointsIsWhatNumPyWrote) {
  const Take take = read_npz_bytes(npz_fixture("good/joints")).take;
  EXPECT_EQ(take.skeleton.names, (std::vector<std::string>{"Hips", "Knee", "Füße"}));
  EXPECT_EQ(take.skeleton.parents, (std::vector<std::int32_t>{-1, 0, 1}));
  EXPECT_EQ(take.skeleton.offsets[1], (Vec3{0, -0.5, 0}));
  EXPECT_EQ(take.frame_rate_hz, 60);
  EXPECT_EQ(take.metres_per_unit, 1);
  EXPECT_EQ(take.source.format, "npz");
  expect_turns_about_axes(take, 1e-12);
}

TEST(NpzReader, EveryTypeAndOrderOfElementsGivesTheSameMotion) {
  for (const char* const name : {"compressed", "fortran", "big_endian", "float32"}) {
    SCOPED_TRACE(name);
    const Take take = read_npz_bytes(npz_fixture(std::string("good/") + name)).take;
    EXPECT_EQ(take.skeleton.names[2], "Füße");
    expect_turns_about_axes(take, name == std::string("float32") ? 1e-6 : 1e-12);
  }
}

TEST(NpzReader, MarkersHaveGapsWhereTheMaskSaysSo) {
  for (const char* const name : {"markers", "float16", "version_2"}) {
    SCOPED_TRACE(name);
    const Take take = read_npz_bytes(npz_fixture(std::string("good/") + name)).take;
    EXPECT_FALSE(take.has_joints());
    EXPECT_EQ(take.names, (std::vector<std::string>{"LASI", "RASI"}));
    EXPECT_EQ(take.unit, "mm");
    EXPECT_EQ(std::count(take.observed.begin(), take.observed.end(), 0), 1);
    EXPECT_FALSE(take.is_observed(2, 1));
    EXPECT_EQ(take.position(4, 1), (Vec3{270, 280, 290}));
  }
}

TEST(NpzReader, ARestRotationIsTakenOffTheWholeRotation) {
  const Take take = read_npz_bytes(npz_fixture("good/rest")).take;
  const Take plain = read_npz_bytes(npz_fixture("good/joints")).take;
  for (std::size_t f = 0; f < take.frame_count(); ++f) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Quat whole = take.skeleton.rest_rotations[j] * take.rotation(f, j);
      EXPECT_LE(angle_between(whole, plain.rotation(f, j)), 1e-12);
    }
  }
  ASSERT_EQ(take.skeleton.end_sites.size(), 1u);
  EXPECT_EQ(take.skeleton.end_sites[0].name, "toe");
}

TEST(NpzReader, NumbersThatAreNotFiniteAreMissing) {
  const TakeResult joints = read_npz_bytes(npz_fixture("good/not_finite"));
  EXPECT_EQ(joints.diagnostics.count("value_not_finite"), 2u);
  EXPECT_FALSE(joints.take.is_observed(1, 1));
  EXPECT_EQ(joints.take.rotation(1, 1), joints.take.rotation(0, 1));
  const TakeResult markers = read_npz_bytes(npz_fixture("good/markers_not_finite"));
  EXPECT_FALSE(markers.take.is_observed(4, 0));
  EXPECT_EQ(markers.take.first_frame, 12);
}

TEST(NpzReader, OddQuaternionsAreScaledAndZerosAreMissing) {
  ReadOptions options;
  options.frame_rate_hz = 50;
  const TakeResult result = read_npz_bytes(npz_fixture("good/odd_lengths"), options);
  EXPECT_EQ(result.diagnostics.count("rotation_missing"), 1u);
  EXPECT_EQ(result.diagnostics.count("rotation_not_unit"), 3u);
  EXPECT_EQ(result.take.frame_rate_hz, 50);
  options.strict = true;
  EXPECT_THROW(read_npz_bytes(npz_fixture("good/odd_lengths"), options), Error);
}

TEST(NpzReader, ARefusalNamesTheArray) {
  const std::pair<const char*, const char*> expected[] = {
      {"nothing", "take.npz: holds neither the array rotations nor positions; it has: "},
      {"no_names", "take.npz: the array names is missing; the file has: "},
      {"layout", "take.npz: has the layout \"kinemend-9\"; this program reads kinemend-1"},
      {"child_first", "array \"parents\": element 1 is 2, which no joint can be"},
      {"shape", "array \"rotations\": expected the shape (5, 3, 4), found (5, 2, 4)"},
      {"objects", "array \"names\": elements of type \"|O\" are not read"},
      {"cut", "the archive has no directory: the file is cut off"}};
  for (const auto& [name, message] : expected) {
    const std::string bytes = npz_fixture(std::string("bad/") + name);
    const std::string found =
        message_of([&] { read_npz_bytes(bytes); }, ErrorKind::unreadable_input);
    EXPECT_NE(found.find(message), found.npos) << name << ": " << found;
  }
}

TEST(NpzReader, IsFoundByContent) {
  EXPECT_EQ(read_take(npz_fixture("good/joints"), "take").take.source.format, "npz");
  EXPECT_EQ(sniff_npz(npz_fixture("good/joints")), 100);
  EXPECT_EQ(sniff_npz(npz_fixture("good/markers")), 100);
  EXPECT_LT(sniff_npz(npz_fixture("bad/nothing")), 50);
  EXPECT_EQ(sniff_npz("PK\3\4 and other zips"), 0);
  EXPECT_EQ(sniff_npz("PK"), 0);
}

// Deflate compresses a thousand zeros to a byte.
TEST(NpzReader, AFileThatUnpacksToGigabytesIsRefused) {
  const std::size_t size = std::size_t{64} << 20;
  const std::string bytes = make_zip({{"positions.npy", std::string(size, '\0'), true}});
  const std::size_t peak = peak_memory([&] {
    EXPECT_NE(message_of([&] { read_npz_bytes(bytes); }, ErrorKind::unreadable_input)
                  .find("too much memory"),
              std::string::npos);
  });
  EXPECT_LT(peak, memory_allowed);
}

}  // namespace
}  // namespace kinemend
