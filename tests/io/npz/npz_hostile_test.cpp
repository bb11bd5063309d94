#include "io/hostile.hpp"
#include "npz_support.hpp"

namespace kinemend {
namespace {

using namespace test;

const std::string likely_in_arrays("\0\1\2\x7F\x80\xFF<>|=fiubUSO0123489(),'{}PK", 31);

void damage(std::string& bytes, Random& random) {
  if (bytes.empty()) return;
  for (std::size_t n = 1 + random.below(3); n > 0; --n) {
    bytes[random.below(bytes.size())] =
        random.chance(0.7) ? likely_in_arrays[random.below(likely_in_arrays.size())]
                           : static_cast<char>(random.below(256));
  }
}

TEST(HostileNpz, CutAtManyLengths) {
  for (const std::string& bytes : fixture_bytes("npz")) {
    for (std::size_t length = 0; length <= bytes.size(); length += 7)
      ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes.substr(0, length), "npz")) << length;
  }
}

TEST(HostileNpz, PatchedAtManyBytes) {
  Random random(31);
  const auto all = fixture_bytes("npz");
  for (int i = 0; i < 6000; ++i) {
    std::string bytes = all[random.below(all.size())];
    damage(bytes, random);
    ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes, "npz")) << i;
  }
}

TEST(HostileNpz, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("npz"); }

std::vector<std::string> readable_fixtures() {
  std::vector<std::string> all;
  for (const auto& path : fixture_paths("npz")) {
    if (path.stem() != "cut") all.push_back(read_file(path));
  }
  return all;
}

// The checksum is made to match, or it would hide the damage. Array headers are damaged as often as
// elements.
std::string with_damaged_array(const std::string& bytes, Random& random) {
  const std::size_t members = read_zip(bytes, "take.npz").members.size();
  std::size_t left = random.below(members);
  return npz_with(bytes, [&](std::string&, std::string& content) {
    if (left-- != 0) return;
    constexpr std::size_t head = 128;
    std::string part = content.substr(0, head);
    if (random.chance(0.5) && content.size() > head) {
      std::string rest = content.substr(head);
      damage(rest, random);
      content = part + rest;
    } else {
      damage(part, random);
      content.replace(0, part.size(), part);
    }
    if (random.chance(0.05)) content.resize(random.below(content.size() + 1));
  });
}

TEST(HostileNpz, ArraysDamagedBelowTheirChecksums) {
  Random random(32);
  const auto all = readable_fixtures();
  for (int i = 0; i < 8000; ++i) {
    const std::string bytes = with_damaged_array(all[random.below(all.size())], random);
    ASSERT_NO_FATAL_FAILURE(expect_take_or_error(bytes, "npz")) << i;
  }
}

// A take that is read from a damaged file can still be written after a change.
TEST(HostileNpz, DamagedTakesThatAreReadCanBeChanged) {
  Random random(33);
  const auto all = readable_fixtures();
  std::size_t changed = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::string bytes = with_damaged_array(all[random.below(all.size())], random);
    try {
      Take take = read_npz_bytes(bytes).take;
      for (Quat& q : take.rotations) q = normalized(q * exp({0.01, 0.02, 0}));
      for (std::size_t p = 0; p < take.positions.size(); ++p) {
        if (take.has_joints() || take.observed[p] != 0) take.positions[p] += Vec3{0.1, 0, 0};
      }
      const Take again = read_npz_bytes(write_take(take)).take;
      ASSERT_EQ(again.positions, take.positions);
      ASSERT_EQ(again.observed, take.observed);
      ++changed;
    } catch (const Error& error) {
      ASSERT_EQ(error.kind(), ErrorKind::unreadable_input) << error.what();
    }
  }
  EXPECT_GT(changed, 1000u);
}

}  // namespace
}  // namespace kinemend
