// Bytes of ASF and AMC files that are cut, patched or moved are read or refused, in bounded memory.
#include <fmt/format.h>

#include "acclaim.hpp"
#include "io/hostile.hpp"

namespace kinemend {
namespace {

using namespace test;

ReadOptions with_figure() {
  ReadOptions options;
  options.skeleton = acclaim_fixture("asf/good/figure.asf");
  return options;
}

const std::string likely_bytes = std::string("\r\n \t.-,#():0915eEnNxX") + '\0';

TEST(HostileAsf, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("asf").empty());
  for (const std::string& text : fixture_bytes("asf")) expect_take_or_error(text, "asf");
}

TEST(HostileAsf, CutAtAnyLength) { expect_sane_when_cut_at_any_length("asf"); }

TEST(HostileAsf, PatchedAtAnyByte) { expect_sane_when_patched_at_any_byte("asf", likely_bytes); }

TEST(HostileAsf, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("asf"); }

TEST(HostileAmc, EveryFixtureIsReadOrRefused) {
  ASSERT_FALSE(fixture_bytes("amc").empty());
  for (const std::string& text : fixture_bytes("amc")) {
    expect_take_or_error(text, "amc", with_figure());
  }
}

TEST(HostileAmc, CutAtAnyLength) { expect_sane_when_cut_at_any_length("amc", with_figure()); }

TEST(HostileAmc, PatchedAtAnyByte) {
  expect_sane_when_patched_at_any_byte("amc", likely_bytes, with_figure());
}

TEST(HostileAmc, PiecesMovedAndRepeated) { expect_sane_when_pieces_move("amc", with_figure()); }

std::string noise() {
  Random random(8);
  std::string bytes(1 << 20, '\0');
  for (char& c : bytes) c = static_cast<char>(random.below(256));
  return bytes;
}

// Bones in a chain, or all attached to the root.
std::string many_bones(int count, bool in_a_chain) {
  std::string bones = ":root\norder tx\n:bonedata\n", hierarchy = ":hierarchy\nbegin\n";
  for (int i = 0; i < count; ++i) {
    bones += fmt::format("begin name b{} dof rx end\n", i);
    hierarchy +=
        in_a_chain && i > 0 ? fmt::format("b{} b{}\n", i - 1, i) : fmt::format("root b{}\n", i);
  }
  return bones + hierarchy + "end\n";
}

TEST(HostileAsf, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string root = ":root\norder tx\n";
  expect_quick_verdicts(
      "asf", {{"noise", noise()},
              {"noise as bones", root + ":bonedata\n" + noise()},
              {"zero bytes", std::string(1 << 20, '\0')},
              {"a long chain", many_bones(16000, true)},
              {"a wide root", many_bones(16000, false)},
              {"too many bones", many_bones(20000, false)},
              {"bones without end", root + ":bonedata\n" + repeated("begin ", 200000)},
              {"hierarchies", root + repeated(":hierarchy begin end\n", 40000)},
              {"limits", root + ":bonedata begin name a limits " + repeated("1 ", 500000)},
              {"colons", repeated(":", 1 << 20)},
              {"keywords", repeated(":name\n", 200000)},
              {"comments", repeated("#\n", 500000)},
              {"parentheses", repeated("(", 1 << 20)},
              {"one endless name", root + ":bonedata begin name " + repeated("n", 1 << 20)}});
}

TEST(HostileAmc, LargeNonsenseIsRefusedQuicklyAndInLittleMemory) {
  const std::string head = ":FULLY-SPECIFIED\n:DEGREES\n";
  expect_quick_verdicts("amc",
                        {{"noise", noise()},
                         {"noise as frames", head + "1\n" + noise()},
                         {"zero bytes", std::string(1 << 20, '\0')},
                         {"numbers alone", head + repeated("1\n", 500000)},
                         {"bones alone", head + "1\n" + repeated("root 1 2 3 4 5 6\n", 60000)},
                         {"one endless line", head + "1\nroot " + repeated("1 ", 500000)},
                         {"one endless word", head + "1\nroot " + std::string(1 << 20, '1')},
                         {"not a number", head + repeated("nan\n", 200000)},
                         {"comments", head + repeated("#\n", 500000)},
                         {"keywords", repeated(":DEGREES\n", 100000)},
                         {"unknown keywords", repeated(":A\n", 300000)}},
                        with_figure());
}

TEST(HostileAmc, ManyBonesWithoutColumnsNeedNoMemoryPastAllBelief) {
  std::string asf = replaced(many_bones(10000, false), "order tx", "order rx");
  for (std::size_t at = 0; (at = asf.find(" dof rx", at)) != asf.npos;) asf.erase(at, 7);
  const std::size_t peak =
      peak_memory([&] { EXPECT_THROW(read_pair(repeated("1\nroot 0\n", 30000), asf), Error); });
  EXPECT_LT(peak, memory_allowed);
}

}  // namespace
}  // namespace kinemend
