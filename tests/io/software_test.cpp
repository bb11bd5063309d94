// Tests that readers keep the name of the program that wrote a file; it tells the source of the
// motion.
#include <gtest/gtest.h>

#include <string>

#include "io/c3d/c3d_support.hpp"
#include "io/fbx/fbx_support.hpp"
#include "io/table/support.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {
namespace {

TEST(Software, OfAC3dFileIsItsManufacturer) {
  // The length must stay the same, because a parameter states it.
  const std::string bytes = with(good_c3d("intel_real"), "make_fixtures", "Theia3D 2023 ");
  const TakeSource source = source_of(read_take(bytes, "take.c3d").take);
  EXPECT_EQ(source.source, Source::video);
  EXPECT_EQ(source.reason, "read from the file, software: Theia3D 2023");
  EXPECT_EQ(source_of(read_good_c3d("intel_real")).reason, "not known");
}

TEST(Software, OfAGltfFileIsItsGenerator) {
  const std::string text =
      write_take(synthesize({.motion = "walk", .duration_s = 0.2, .frame_rate_hz = 60}), "gltf");
  const std::size_t at = text.find("\"Kinemend ");
  ASSERT_NE(at, std::string::npos);
  const std::string written = text.substr(at, text.find('"', at + 1) + 1 - at);
  const std::string suit = with(text, written, "\"Axis Studio\"");
  EXPECT_EQ(source_of(read_take(suit, "take.gltf").take).source, Source::suit);
  EXPECT_EQ(source_of(read_take(text, "take.gltf").take).source, Source::unknown);
}

// The program that saved the file last counts; it may have edited the first one's data.
TEST(Software, OfAnFbxFileIsThatWhichSavedItLast) {
  const auto property = [](const std::string& name, const std::string& value) {
    return FbxNode{"P", {name, std::string("KString"), std::string(), std::string(), value}, {}};
  };
  const auto saved_by = [&](const std::string& vendor, const std::string& name) {
    const FbxNode list{"Properties70",
                       {},
                       {property("Original|ApplicationName", "Rokoko Studio"),
                        property("LastSaved|ApplicationVendor", vendor),
                        property("LastSaved|ApplicationName", name)}};
    return FbxNode{"SceneInfo", {std::string("GlobalInfo"), std::string("UserData")}, {list}};
  };
  for (const FbxForm& form : fbx_forms) {
    const auto read = [&](const std::string& vendor, const std::string& name) {
      std::vector<FbxNode> nodes = FbxTestScene(fbx_walker()).nodes;
      nodes.front().children.push_back(saved_by(vendor, name));
      return read_fbx_clip(FbxTestWriter(form).file(nodes));
    };
    const Take suit = read("Rokoko", "Rokoko Studio");
    EXPECT_EQ(fact_of(suit, "software"), "Rokoko Studio") << form.title;
    EXPECT_EQ(source_of(suit).source, Source::suit) << form.title;
    const Take edited = read("Autodesk", "MotionBuilder");
    EXPECT_EQ(fact_of(edited, "software"), "Autodesk, MotionBuilder") << form.title;
    EXPECT_EQ(source_of(edited).source, Source::unknown) << form.title;
  }
}

}  // namespace
}  // namespace kinemend::test
