// Bytes of BVH files that are cut, patched or moved are read or refused, in bounded memory.
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

TEST(HostileBvh, EveryFixtureIsReadOrRefused) {
  for (const std::string& text : fixture_bytes("bvh")) expect_take_or_error(text, "bvh");
}

TEST(HostileBvh, CutAtAnyLength) { expect_sane_when_cut_at_any_length("bvh"); }

TEST(HostileBvh, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("bvh", std::string("{} \n\r\t.-,#/0915eEnN:", 20) + '\0');
}

TEST(HostileBvh, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("bvh"); }

TEST(HostileBvh, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string head =
      "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\n";
  const std::string motion = "MOTION\nFrames: 1000000\nFrame Time: 0.01\n";
  Random random(8);
  std::string noise(1 << 20, '\0');
  for (char& c : noise) c = static_cast<char>(random.below(256));
  const std::vector<std::pair<const char*, std::string>> files = {
      {"deep nesting", "HIERARCHY\nROOT a{" + repeated("JOINT a{", 100000)},
      {"many joints", head + repeated("JOINT a{}", 200000) + "}" + motion},
      {"many end sites", head + repeated("End Site{}", 200000) + "}" + motion},
      {"fixed joints, many frames",
       head + repeated("JOINT a{}", 10000) + "}\nMOTION\nFrame Time: 1\n" + repeated("0 ", 300000)},
      {"no channels, many frames", "HIERARCHY\nROOT a{OFFSET 0 0 0}" + motion},
      {"noise", noise},
      {"noise as motion", head + "}" + motion + noise},
      {"zero bytes", std::string(1 << 20, '\0')},
      {"one endless word", head + "}" + motion + std::string(1 << 20, '1')},
      {"one endless name", "HIERARCHY\nROOT " + std::string(1 << 20, 'n')},
      {"not a number", head + "}" + motion + repeated("nan ", 300000)},
      {"comments", head + "}" + motion + repeated("#\n", 500000)},
      {"commas", head + "}" + motion + repeated("0,", 500000)},
      {"commas in an offset", "HIERARCHY\nROOT a{OFFSET 1 2" + repeated(" ,", 500000) + "3"},
      {"braces", "HIERARCHY\nROOT a" + repeated("{", 500000)},
      {"uneven lines", head + "}" + motion + repeated("0 0\n0 0 0\n", 100000)},
  };
  expect_quick_verdicts("bvh", files);
}

}  // namespace
}  // namespace kinemend
