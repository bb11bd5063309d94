#include "io/fbx/fbx_tree.hpp"

#include <gtest/gtest.h>

#include "fbx_support.hpp"
#include "io/fbx/fbx_patch.hpp"
#include "io/fbx/fbx_values.hpp"
#include "kinemend/error.hpp"

namespace kinemend {
namespace {

using namespace test;

FbxTree text_tree(const std::string& text) {
  return read_fbx_tree("; FBX 7.4.0 project file\n" + text, "t", 512);
}

TEST(FbxTree, StringsMayHoldWhatEndsRecords) {
  const FbxTree tree = text_tree("A: \"x{y}:,;\", 3 {\n\tB: Y\n\t; C: 1\n}\nD: 4\n");
  ASSERT_EQ(tree.records.size(), 3u);
  EXPECT_EQ(fbx_text(tree, tree.properties[0]), "x{y}:,;");
  EXPECT_EQ(tree.records[1].parent, 0u);
  EXPECT_EQ(fbx_child_integer(tree, no_fbx_record, "D", 0), 4);
}

TEST(FbxTree, ListsMayGoOnInTheNextLine) {
  const FbxTree tree = text_tree("Key: 0,1.5,C,n\n   ,10,2.5,L\nEnd: 1\n");
  ASSERT_EQ(tree.records.size(), 2u);
  EXPECT_EQ(tree.records[0].property_count, 7u);
  EXPECT_EQ(fbx_number(tree, tree.properties[5]), 2.5);
}

TEST(FbxTree, ARecordWithoutValuesEndsBeforeTheNext) {
  const FbxTree tree = text_tree("Empty:\nNext: 1\nBlock:  {\n}\nShading: Y\n");
  ASSERT_EQ(tree.records.size(), 4u);
  EXPECT_EQ(tree.records[0].property_count, 0u);
  EXPECT_EQ(tree.name_of(tree.records[3]), "Shading");
}

TEST(FbxTree, ErrorsSayWhere) {
  const auto message_of_text = [](const std::string& text) {
    try {
      text_tree(text);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(message_of_text("A: {\n"), "t:3: the file ends within braces that are open");
  EXPECT_EQ(message_of_text("A: 1\n}\n"), "t:3: a brace closes nothing");
  EXPECT_EQ(message_of_text("A: \"x\n"), "t:2: a string does not end");
  std::string bytes = fbx_bytes(fbx_walker());
  bytes.resize(bytes.size() / 2);
  try {
    read_fbx_tree(bytes, "b", 512);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 8), "b: byte ");
  }
}

TEST(FbxTree, PatchesOfOtherLengthMoveWhatIsBehind) {
  for (const FbxForm& form : fbx_forms) {
    if (form.is_text) continue;
    SCOPED_TRACE(form.title);
    const std::string bytes = fbx_bytes(fbx_walker(), form);
    const FbxTree tree = read_fbx_tree(bytes, "file", 512);
    const std::uint32_t takes = tree.child(no_fbx_record, "Takes");
    const FbxProperty& name = *fbx_child_value(tree, takes, "Current");
    std::string longer(4, '\0');
    longer[form.is_big_endian ? 3 : 0] = 9;
    const std::string written =
        write_patched_fbx(tree, {{name.begin, name.begin + name.size, longer + "walk away", 0}});
    const auto before = walk_binary_fbx(bytes), after = walk_binary_fbx(written);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) {
      EXPECT_EQ(after[i].path, before[i].path);
      if (after[i].path != "/Takes/Current") {
        EXPECT_EQ(after[i].properties, before[i].properties);
      }
    }
    const FbxTree again = read_fbx_tree(written, "file", 512);
    EXPECT_EQ(
        fbx_text(again, *fbx_child_value(again, again.child(no_fbx_record, "Takes"), "Current")),
        "walk away");
    EXPECT_EQ(write_patched_fbx(again, {}), written);
  }
}

}  // namespace
}  // namespace kinemend
