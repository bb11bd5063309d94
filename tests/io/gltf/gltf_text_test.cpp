#include "gltf_support.hpp"
#include "io/gltf/gltf_container.hpp"
#include "io/gltf/gltf_json.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

using namespace test;

std::string text_at(const std::string& json, std::optional<ByteSpan> place) {
  return place ? json.substr(place->begin, place->size) : "nothing";
}

TEST(GltfText, Base64IsThatOfTheStandard) {
  // RFC 4648, section 10.
  const std::vector<std::pair<std::string, std::string>> known{{"", ""},
                                                               {"f", "Zg=="},
                                                               {"fo", "Zm8="},
                                                               {"foo", "Zm9v"},
                                                               {"foob", "Zm9vYg=="},
                                                               {"fooba", "Zm9vYmE="},
                                                               {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : known) {
    EXPECT_EQ(base64_of(plain), coded);
    EXPECT_EQ(bytes_of_data_uri("data:a/b;base64," + coded), plain);
  }
  Random random(5);
  std::string bytes(1000, '\0');
  for (char& c : bytes) c = static_cast<char>(random.below(256));
  EXPECT_EQ(bytes_of_data_uri("data:;base64," + base64_of(bytes)), bytes);
  for (const char* const bad :
       {"data:;base64,A", "data:;base64,A*==", "data:,abcd", "data:", "abcd"})
    EXPECT_FALSE(bytes_of_data_uri(bad)) << bad;
}

TEST(GltfText, AddressesStayInTheFolderOfTheirFile) {
  EXPECT_EQ(relative_path_of_uri("walk%20cycle.bin"), "walk cycle.bin");
  EXPECT_EQ(relative_path_of_uri("maps/./a..b.png"), "maps/./a..b.png");
  for (const char* const bad :
       {"", "/etc/passwd", "../a", "a/../../b", "a/%2e%2E/b", "..", "C:/a", "c%3Aa", "file:a",
        "http://a/b", "a\\b", "%5Ca", "a%0Ab", "%4", "%zz"})
    EXPECT_FALSE(relative_path_of_uri(bad)) << bad;
  EXPECT_EQ(uri_of_file_name("walk cycle (2) \xC3\xA4.bin"), "walk%20cycle%20%282%29%20%C3%A4.bin");
  EXPECT_EQ(relative_path_of_uri(uri_of_file_name("a \"b\"%.bin")), "a \"b\"%.bin");
}

TEST(GltfText, MembersAndElementsAreFoundByBracketsAndQuotes) {
  const std::string json =
      R"( {"a" : [1, {"b":"]\"}"} , [2,[3]], "\\"], "\u0062" :{"c": -1.5e3 },"a2":null,"b":true})";
  EXPECT_EQ(text_at(json, json_root(json)), json.substr(1));
  EXPECT_EQ(text_at(json, json_member(json, {"b"})), "true") << "the last of one name";
  EXPECT_EQ(text_at(json, json_member(json, {"a2"})), "null");
  EXPECT_EQ(text_at(json, json_member(json, {"a", "b"})), "nothing") << "an array has no members";
  EXPECT_EQ(text_at(json, json_member(json, {"c"})), "nothing");
  EXPECT_EQ(text_at(json, json_element(json, "a", 0)), "1");
  EXPECT_EQ(text_at(json, json_element(json, "a", 1)), R"({"b":"]\"}"})");
  EXPECT_EQ(text_at(json, json_element(json, "a", 2)), "[2,[3]]");
  EXPECT_EQ(text_at(json, json_element(json, "a", 3)), R"("\\")");
  EXPECT_EQ(text_at(json, json_element(json, "a", 4)), "nothing");
}

TEST(GltfText, EditsReplaceAndInsertInOrder) {
  EXPECT_EQ(edited_json("0123456789", {{{7, 2}, "x"}, {{2, 0}, "a"}, {{2, 0}, "b"}, {{4, 1}, ""}}),
            "01ab2356x9");
}

TEST(GltfText, OnlyStringsThatAreDataAreCut) {
  EXPECT_EQ(without_inline_data(R"(["data:abc","x data:y","\"data:z","data:","\\","data:d"])"),
            R"(["data:","x data:y","\"data:z","data:","\\","data:"])");
  EXPECT_EQ(without_inline_data(R"("data:never ends)"), R"("data:never ends)");
}

}  // namespace
}  // namespace kinemend
