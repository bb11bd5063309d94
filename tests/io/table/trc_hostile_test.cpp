// Bytes of TRC files that are cut, patched or moved are read or refused, in bounded memory.
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(HostileTrc, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("trc").empty());
  for (const std::string& text : fixture_bytes("trc")) expect_take_or_error(text, "trc");
}

TEST(HostileTrc, CutAtAnyLength) { expect_sane_when_cut_at_any_length("trc"); }

TEST(HostileTrc, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("trc",
                                       std::string("\t\t\t \n\r.-,;\"0915eEnNXF#", 22) + '\0');
}

TEST(HostileTrc, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("trc"); }

TEST(HostileTrc, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string head =
      "PathFileType\t4\t(X/Y/Z)\ta\nDataRate\tNumFrames\tNumMarkers\tUnits\n"
      "100\t1000000000000\t1000000000\tmm\n";
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::string start = head + "Frame#\tTime\ta\t\t\n\n";
  expect_quick_verdicts(
      "trc",
      {{"noise", noise},
       {"noise as rows", start + noise},
       {"noise as labels", head + "Frame#\tTime\t" + noise},
       {"zero bytes", std::string(1 << 20, '\0')},
       {"only head lines", repeated("PathFileType\t4\n", 100000)},
       {"many labels, short rows",
        head + "Frame#\tTime" + repeated("\ta\t\t", 60000) + "\n\n" + repeated("1\t\t1\n", 100000)},
       {"too many labels", head + "Frame#\tTime" + repeated("\ta\t\t", 300000) + "\n\n1\t0\t1\n"},
       {"one wide row", start + repeated("1\t0\t1\t2\t3\n", 50000) + repeated("1\t", 190000)},
       {"wider and wider", start + repeated("1\t0\t1\t2\t3\n", 20000) + repeated("1\t", 300000)},
       {"one endless cell", start + std::string(1 << 20, '1')},
       {"one endless quote", start + "1\t\"" + std::string(1 << 20, '\t')},
       {"quotes", start + repeated("1\t\"\n", 200000)},
       {"empty lines", start + std::string(1 << 20, '\n')},
       {"not a number", start + repeated("nan\tnan\tnan\tnan\tnan\n", 50000)},
       {"zeros", start + repeated("1\t0\t0\t0\t0\n", 100000)}});
}

}  // namespace
}  // namespace kinemend
