// Tests of the bound on nested JSON, on text alone.
#include "kinemend/extend/text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace kinemend {
namespace {

std::string nested(std::size_t levels, const std::string& inside) {
  return std::string(levels, '[') + inside + std::string(levels, ']');
}

TEST(JsonDepth, LeavesTextWithinTheBoundAsItIs) {
  for (const std::string& text :
       {std::string(), std::string("7"), nested(deepest_json, "1"),
        std::string(R"({"a": [{"b": []}, "]]]["]})"), std::string("]]]]"), std::string("\"")})
    EXPECT_EQ(json_within_depth(text), text);
  // Siblings add no depth.
  std::string wide = "[";
  for (int i = 0; i < 1000; ++i) wide += "{},";
  wide += "1]";
  EXPECT_EQ(json_within_depth(wide), wide);
}

TEST(JsonDepth, CutsWhereALevelIsTooDeep) {
  EXPECT_EQ(json_within_depth(nested(deepest_json + 1, "1")), std::string(deepest_json, '['));
  const std::string objects = [] {
    std::string text;
    for (std::size_t i = 0; i <= deepest_json; ++i) text += "{\"a\":";
    return text;
  }();
  EXPECT_EQ(json_within_depth(objects).size(), objects.size() - 5);
  EXPECT_EQ(json_within_depth(std::string(5'000'000, '[')).size(), deepest_json);
}

TEST(JsonDepth, DoesNotCountBracketsInStrings) {
  const std::string brackets(1000, '[');
  for (const std::string& text :
       {"\"" + brackets + "\"", "[\"\\\"" + brackets + "\"]", "[\"\\\\\", \"" + brackets + "\"]"})
    EXPECT_EQ(json_within_depth(text), text);
  // The string ends at its second quote, so the brackets after it are counted.
  EXPECT_LT(json_within_depth("\"\\\\\"" + brackets).size(), 100u);
}

}  // namespace
}  // namespace kinemend
