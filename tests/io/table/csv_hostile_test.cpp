// Bytes of CSV files that are cut, patched or moved are read or refused, in bounded memory.
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(HostileCsv, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("csv").empty());
  for (const std::string& text : fixture_bytes("csv")) expect_take_or_error(text, "csv");
}

TEST(HostileCsv, CutAtAnyLength) { expect_sane_when_cut_at_any_length("csv"); }

TEST(HostileCsv, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("csv", ",,,;\t \n\r.-\"#:0915eEnNXxw_");
}

TEST(HostileCsv, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("csv"); }

TEST(HostileCsv, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::string start = "frame,a_x,a_y,a_z\n", joint = "frame,a_w,a_x,a_y,a_z\n";
  expect_quick_verdicts(
      "csv",
      {{"noise", noise},
       {"noise as rows", start + noise},
       {"noise as labels", "frame,a_x,a_y,a_z," + noise},
       {"zero bytes", std::string(1 << 20, '\0')},
       {"comments", repeated("#\n", 400000)},
       {"notes", repeated("# a: b\n", 100000)},
       {"joints", repeated("# joint 0: a; parent -1; offset 0 0 0\n", 30000)},
       {"nested joints", "# joint 0: a; parent -1; offset 0 0 0\n" +
                             repeated("# joint 0: a; parent 0; offset 0 0 0\n", 10000) + joint},
       {"many labels, short rows",
        "frame" + repeated(",a_x,a_y,a_z", 15000) + "\n" + repeated("1,,1\n", 100000)},
       {"many joints, short rows",
        "frame" + repeated(",a_w,a_x,a_y,a_z", 15000) + "\n" + repeated("1,,1\n", 100000)},
       {"too many labels", "frame" + repeated(",a_x,a_y,a_z", 100000) + "\n1\n"},
       {"one wide row", start + repeated("1,", 300000)},
       {"separators", start + std::string(1 << 20, ',')},
       {"one endless cell", start + std::string(1 << 20, '1')},
       {"one endless quote", start + "1,\"" + std::string(1 << 20, ',')},
       {"empty lines", start + std::string(1 << 20, '\n')},
       {"filler rows", start + repeated(",,,\n", 200000)},
       {"zero rotations", joint + repeated("1,0,0,0,0\n", 100000)}});
}

}  // namespace
}  // namespace kinemend
