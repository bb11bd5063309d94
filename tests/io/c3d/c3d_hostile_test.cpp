// Bytes of C3D files that are cut, patched or moved are read or refused, in bounded memory.
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(HostileC3d, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("c3d").empty());
  for (const std::string& bytes : fixture_bytes("c3d")) expect_take_or_error(bytes, "c3d");
}

TEST(HostileC3d, CutAtAnyLength) { expect_sane_when_cut_at_any_length("c3d"); }

TEST(HostileC3d, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("c3d", std::string("\0\1\2\4\xFF\x7F\x80PTUV \xBF", 13));
}

TEST(HostileC3d, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("c3d"); }

TEST(HostileC3d, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string good =
      read_file(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "c3d/good/intel_integer.c3d");
  const auto patched = [&](std::size_t at, const std::string& piece, std::size_t size) {
    std::string bytes = good;
    bytes.resize(size, '\1');
    return bytes.replace(at, piece.size(), piece);
  };
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::string entry("\1\1A\6\0\2\0\0", 8);
  const std::string texts("\1\1A\x08\0\xFF\2\0\xFF\0", 10);
  expect_quick_verdicts("c3d", {{"noise", noise},
                                {"noise behind a header", good.substr(0, 516) + noise},
                                {"noise as data", good + noise},
                                {"zero bytes", std::string(1 << 20, '\0')},
                                {"zero bytes before the header", std::string(1 << 20, '\0') + good},
                                {"many parameters", good.substr(0, 516) + repeated(entry, 100000)},
                                {"many empty texts", good.substr(0, 516) + repeated(texts, 100000)},
                                {"most points", patched(2, "\xFF\xFF", 1 << 20)},
                                {"most analog values", patched(4, "\xFF\xFF", 1 << 20)},
                                {"most frames", patched(8, "\xFF\xFF", 1 << 20)},
                                {"ones", patched(4, "\xFF", 1 << 20)}});
}

}  // namespace
}  // namespace kinemend
