// Lower case changes the letters A to Z and no other byte.
#include "kinemend/extend/text.hpp"

#include <gtest/gtest.h>

namespace kinemend::test {
namespace {

TEST(LetterCase, ChangesTheLettersOfAsciiAlone) {
  EXPECT_EQ(lower_case("LeftUpLeg_01 AZ@["), "leftupleg_01 az@[");
  EXPECT_EQ(lower_case("\xC3\x84rmel"), "\xC3\x84rmel") << "bytes of UTF-8 stay";
  for (int byte = 0; byte < 256; ++byte) {
    const bool is_capital = byte >= 'A' && byte <= 'Z';
    const char letter = static_cast<char>(byte);
    EXPECT_EQ(lower_case(letter), is_capital ? static_cast<char>(byte + 32) : letter) << byte;
  }
}

TEST(LetterCase, ComparesTextsOfTheSameLengthOnly) {
  EXPECT_TRUE(same_but_for_case("Heel", "hEEL"));
  EXPECT_TRUE(same_but_for_case("", ""));
  EXPECT_FALSE(same_but_for_case("heel", "heels"));
  EXPECT_FALSE(same_but_for_case("[", "{")) << "32 apart, but no letters";
}

}  // namespace
}  // namespace kinemend::test
