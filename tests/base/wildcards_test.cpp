// Patterns of names: known cases, and agreement with the system's own matching.
#include "kinemend/extend/text.hpp"

#include <gtest/gtest.h>
#ifdef __GLIBC__
#include <fnmatch.h>
#endif

#include <random>
#include <string>
#include <vector>

namespace kinemend {
namespace {

TEST(Wildcards, MatchNames) {
  EXPECT_TRUE(matches_wildcards_anywhere("Left*", "LeftHand"));
  EXPECT_TRUE(matches_wildcards_anywhere("*Hand*", "LeftHandIndex1"));
  EXPECT_TRUE(matches_wildcards_anywhere("[LR]Toe?", "LToe1"));
  EXPECT_TRUE(matches_wildcards_anywhere("[!L]*", "RToe"));
  EXPECT_TRUE(matches_wildcards_anywhere("a[[:digit:]]", "a7"));
  EXPECT_TRUE(matches_wildcards_anywhere("a\\*", "a*"));
  EXPECT_TRUE(matches_wildcards_anywhere("**", ""));
  EXPECT_FALSE(matches_wildcards_anywhere("Left", "LeftHand"));
  EXPECT_FALSE(matches_wildcards_anywhere("?", ""));
  EXPECT_FALSE(matches_wildcards_anywhere("[a-c]", "d"));
  EXPECT_FALSE(matches_wildcards_anywhere("", "a"));
}

TEST(Wildcards, TakeNoLongerForManyAsterisks) {
  std::string pattern;
  for (int i = 0; i < 1000; ++i) pattern += "*a";
  EXPECT_FALSE(matches_wildcards_anywhere(pattern, std::string(2000, 'b')));
  EXPECT_TRUE(matches_wildcards_anywhere(pattern, std::string(2000, 'a')));
}

#ifdef __GLIBC__
TEST(Wildcards, AgreeWithTheSystem) {
  std::mt19937 random(1);
  // Systems disagree about unterminated bracket sets, so no pattern has one.
  const std::vector<std::string> of_patterns = {"a",    "b",     "*",    "?",      "[ab]",
                                                "[!a]", "[a-c]", "[]a]", "[^]b]",  "[a-]",
                                                "\\*",  "\\a",   "]",    "[\\]b]", "[[:alpha:]!]"};
  const std::vector<std::string> of_names = {"a", "b", "c",  "]", "-", "[",
                                             "!", "^", "\\", ":", "*"};
  const auto word = [&](const std::vector<std::string>& pieces, std::size_t most) {
    std::string text;
    for (std::size_t i = random() % (most + 1); i > 0; --i)
      text += pieces[random() % pieces.size()];
    return text;
  };
  int matched = 0;
  for (int i = 0; i < 400000; ++i) {
    const std::string pattern = word(of_patterns, 8), name = word(of_names, 6);
    const bool expected = fnmatch(pattern.c_str(), name.c_str(), 0) == 0;
    matched += expected ? 1 : 0;
    ASSERT_EQ(matches_wildcards_anywhere(pattern, name), expected) << pattern << " on " << name;
  }
  EXPECT_GT(matched, 10000);
}
#endif

}  // namespace
}  // namespace kinemend
