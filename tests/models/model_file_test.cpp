// Tests of model files: layout, checksum, versions, and the shipped models.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/system.hpp"

namespace kinemend {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Model joints_model() {
  Model model;
  model.method = "wiener";
  model.rate_hz = 60.5;
  model.takes = 3;
  model.seconds = 12.25;
  model.card = {"A \"walk\"", "two clips\nof one person", "CC0, ü", "kinemend train", "0.7"};
  model.layout.names = {"Hips", "Spine", "Left \"Arm\""};
  model.layout.parents = {-1, 0, 1};
  model.layout.references = {{1, 0, 0, 0}, {0.6, 0, 0.8, 0}, {0.5, -0.5, 0.5, -0.5}};
  model.layout.bones = {{0, 1, 0}, {0.6, 0.8, 0}, {0, 0, 0}};
  model.layout.place = {0.1, 0.55, -0.3};
  model.layout.trend_s = 0.4;
  model.numbers = {{"a", 1.0 / 3}, {"b", -1e300}, {"c", 0}};
  model.tensors["mean"] = {TensorType::f32, {2, 2}, {1, 2, 3, 4.5}};
  model.tensors["kind"] = {TensorType::u8, {0}, {}};
  return model;
}

Model markers_model() {
  Model model = joints_model();
  model.layout = {};
  model.layout.kind = BodyKind::markers;
  model.layout.names = {"LASI", "RASI", "SACR", "LHEE"};
  model.layout.means = {{0.1, 0.6, 0}, {-0.1, 0.6, 0}, {0, 0.6, -0.1}, {0.1, 0.05, 0}};
  model.layout.shape = {{0.1, 0.02, 0}, {-0.1, 0.02, 0}, {0, 0, -0.1}, {0.1, -0.5, 0}};
  model.layout.anchors = {1, 1, 1, 0};
  return model;
}

void expect_same(const Model& a, const Model& b) {
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.version, b.version);
  EXPECT_EQ(a.rate_hz, b.rate_hz);
  EXPECT_EQ(a.takes, b.takes);
  EXPECT_EQ(a.seconds, b.seconds);
  EXPECT_EQ(a.card.title, b.card.title);
  EXPECT_EQ(a.card.data, b.card.data);
  EXPECT_EQ(a.card.licence, b.card.licence);
  EXPECT_EQ(a.card.command, b.card.command);
  EXPECT_EQ(a.card.figures, b.card.figures);
  EXPECT_EQ(a.layout.kind, b.layout.kind);
  EXPECT_EQ(a.layout.names, b.layout.names);
  EXPECT_EQ(a.layout.parents, b.layout.parents);
  EXPECT_EQ(a.layout.references, b.layout.references);
  EXPECT_EQ(a.layout.bones, b.layout.bones);
  EXPECT_EQ(a.layout.with_place, b.layout.with_place);
  EXPECT_EQ(a.layout.place, b.layout.place);
  EXPECT_EQ(a.layout.means, b.layout.means);
  EXPECT_EQ(a.layout.shape, b.layout.shape);
  EXPECT_EQ(a.layout.anchors, b.layout.anchors);
  EXPECT_EQ(a.layout.trend_s, b.layout.trend_s);
  EXPECT_EQ(a.numbers, b.numbers);
  ASSERT_EQ(a.tensors.size(), b.tensors.size());
  for (const auto& [name, tensor] : a.tensors) {
    ASSERT_TRUE(b.tensors.contains(name)) << name;
    EXPECT_EQ(tensor.stored, b.tensors.at(name).stored);
    EXPECT_EQ(tensor.shape, b.tensors.at(name).shape);
    EXPECT_EQ(tensor.values, b.tensors.at(name).values);
  }
}

std::string error_of(const std::function<void()>& action, ErrorKind kind) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    return error.what();
  }
  return "no error";
}

/// Returns the model as a file of format 1, which has no checksum.
TensorFile without_checksum(const Model& model) {
  TensorFile file = parse_tensors(write_model(model), "source");
  file.metadata["kinemend.model"] = "1";
  file.metadata.erase("kinemend.checksum");
  return file;
}

std::string message_with(const std::function<void(TensorFile&)>& change,
                         const Model& model = joints_model()) {
  TensorFile file = without_checksum(model);
  change(file);
  const std::string bytes = write_tensors(file);
  return error_of([&] { parse_model(bytes, "walk.kmodel"); }, ErrorKind::unreadable_input);
}

std::string message_with(const std::string& key, const std::string& text) {
  return message_with([&](TensorFile& file) { file.metadata[key] = text; });
}

TEST(ModelFile, ComesBackWhole) {
  for (const Model& model : {joints_model(), markers_model()})
    expect_same(parse_model(write_model(model), "a"), model);
  Model without_place = joints_model();
  without_place.layout.with_place = false;
  EXPECT_FALSE(parse_model(write_model(without_place), "a").layout.with_place);
}

// tools/reference/tensors.py wrote the fixtures.
TEST(ModelFile, IsLaidOutAsTheReferenceLaysItOut) {
  const auto fixture = [](const char* name) {
    return std::filesystem::path(KINEMEND_TEST_FIXTURES) / "models/good" / name;
  };
  expect_same(read_model(fixture("joints.kmodel")), joints_model());
  expect_same(read_model(fixture("markers.kmodel")), markers_model());
  EXPECT_EQ(write_tensors(without_checksum(joints_model())), file_bytes(fixture("joints.kmodel")));
  EXPECT_EQ(write_tensors(without_checksum(markers_model())),
            file_bytes(fixture("markers.kmodel")));
}

TEST(ModelFile, IsTheSameBytesForTheSameModel) {
  const std::string bytes = write_model(joints_model());
  EXPECT_EQ(write_model(joints_model()), bytes);
  EXPECT_EQ(write_model(parse_model(bytes, "a")), bytes);
}

TEST(ModelFile, IsRefusedWhateverByteIsFlipped) {
  for (const Model& model : {joints_model(), markers_model()}) {
    const std::string bytes = write_model(model);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      for (const int bit : {0x01, 0x20, 0x80}) {
        std::string flipped = bytes;
        flipped[i] = static_cast<char>(flipped[i] ^ bit);
        EXPECT_THROW(parse_model(flipped, "walk.kmodel"), Error) << "byte " << i << " bit " << bit;
      }
    }
  }
}

TEST(ModelFile, HoldsTheHashOfItselfWithZerosInItsPlace) {
  std::string bytes = write_model(joints_model());
  const std::string key = "\"kinemend.checksum\":\"";
  const std::size_t place = bytes.find(key) + key.size();
  const std::string stated = bytes.substr(place, 32);
  bytes.replace(place, 32, 32, '0');
  EXPECT_EQ(content_hash(bytes), stated);
  EXPECT_EQ(error_of([&] { parse_model(bytes, "walk.kmodel"); }, ErrorKind::unreadable_input),
            "walk.kmodel: the file is damaged: its checksum is \"" + std::string(32, '0') +
                "\", that of what it holds " + stated);
}

TEST(ModelFile, IsReadFromDisk) {
  const auto path = std::filesystem::path(testing::TempDir()) / "kinemend-model-test.kmodel";
  std::ofstream(path, std::ios::binary) << write_model(markers_model());
  expect_same(read_model(path), markers_model());
  std::filesystem::remove(path);
  EXPECT_THAT(error_of([&] { read_model(path); }, ErrorKind::unreadable_input),
              HasSubstr("kinemend-model-test.kmodel: No such file"));
}

TEST(ModelFile, RefusesOtherTensorFiles) {
  const std::string bytes = write_tensors({{{"format", "pt"}}, {}});
  EXPECT_EQ(error_of([&] { parse_model(bytes, "net.safetensors"); }, ErrorKind::unreadable_input),
            "net.safetensors: expected a model, found a file of tensors without the metadata "
            "\"kinemend.model\"");
}

TEST(ModelFile, RefusesNewerVersionsWithBothNumbers) {
  EXPECT_EQ(message_with("kinemend.model", "3"),
            "walk.kmodel: the model is of format 3, and this program reads up to 2");
  EXPECT_EQ(message_with("version", "99"),
            "walk.kmodel: the model is version 99 of wiener, and this program reads up to 1");
  EXPECT_EQ(
      message_with("method", "oracle"),
      "walk.kmodel: metadata \"method\": expected one of example, wiener, sparse, kalman-learned, "
      "recurrent, learned, contacts, "
      "found \"oracle\"");
}

TEST(ModelFile, NamesTheMetadataThatIsMissingOrNoNumber) {
  for (const char* key : {"method", "version", "rate_hz", "takes", "seconds", "title", "data",
                          "licence", "command", "figures", "layout", "numbers"}) {
    EXPECT_EQ(message_with([&](TensorFile& file) { file.metadata.erase(key); }),
              std::string("walk.kmodel: metadata \"") + key + "\" is missing");
  }
  for (const char* text : {"", "x", "1x", "nan", "inf", "-1", " 1", "1e999", "0"})
    EXPECT_THAT(message_with("rate_hz", text), HasSubstr("\"rate_hz\": expected a number above 0"));
  for (const char* text : {"", "1.5", "-1", "99999999999999999999"})
    EXPECT_THAT(message_with("takes", text), HasSubstr("\"takes\": expected a whole number"));
  for (const char* text : {"", "[", "[1]", "{\"a\":\"x\"}", "{\"a\":null}", "{\"a\":1e999}"})
    EXPECT_THAT(message_with("numbers", text), HasSubstr("metadata \"numbers\": expected"));
}

TEST(ModelFile, RefusesABodyThatKeepsNotTheRules) {
  const char* start = "{\"kind\":\"joints\",\"trend_s\":0.5,\"with_place\":true,";
  const auto layout = [&](const std::string& rest) { return message_with("layout", start + rest); };
  EXPECT_THAT(layout("\"names\":[\"a\"]}"), HasSubstr("a valid \"parents\""));
  EXPECT_THAT(layout("\"names\":[1,2,3],\"parents\":[-1,0,1]}"), HasSubstr("a valid \"names\""));
  EXPECT_THAT(layout("\"names\":[\"a\",\"b\",\"c\"],\"parents\":[-1,0,2]}"),
              StartsWith("walk.kmodel: "));
  EXPECT_THAT(layout("\"names\":[\"a\",\"b\"],\"parents\":[-1,0]}"),
              HasSubstr("\"layout.references\": expected shape [2, 4], found [3, 4]"));
  EXPECT_THAT(message_with("layout", "{\"kind\":\"cats\"}"), HasSubstr("joints or markers"));
  EXPECT_THAT(message_with("layout", std::string(1000, '[')), HasSubstr("\"layout\": expected"));
  EXPECT_THAT(message_with([](TensorFile& file) { file.tensors.erase("layout.bones"); }),
              HasSubstr("tensor \"layout.bones\" is missing"));
  EXPECT_THAT(
      message_with([](TensorFile& file) { file.tensors["layout.means"] = file.tensors["mean"]; }),
      HasSubstr("tensor \"layout.means\": a body of joints has none of this name"));
  EXPECT_THAT(
      message_with([](TensorFile& file) { file.tensors["layout.references"].values[0] = 9; }),
      StartsWith("walk.kmodel: "));
}

TEST(ModelFile, RefusesToWriteWhatCouldNotBeRead) {
  const auto message = [](const std::function<void(Model&)>& change) {
    Model model = joints_model();
    change(model);
    return error_of([&] { write_model(model); }, ErrorKind::usage);
  };
  EXPECT_THAT(message([](Model& m) { m.rate_hz = 0; }), HasSubstr("its rate"));
  EXPECT_THAT(message([](Model& m) { m.numbers["x"] = 0.0 / 0.0; }), HasSubstr("number \"x\""));
  EXPECT_THAT(message([](Model& m) { m.tensors["layout.x"] = {}; }), HasSubstr("layout.x"));
  EXPECT_THAT(message([](Model& m) { m.layout.names[0] = "\xFF"; }), HasSubstr("UTF-8"));
  EXPECT_NE(message([](Model& m) { m.layout.parents[1] = 2; }), "no error");
}

TEST(Model, SaysWhichNumberOrTensorIsMissing) {
  const Model model = joints_model();
  const auto kind = ErrorKind::unreadable_input;
  EXPECT_EQ(model.number("c"), 0);
  EXPECT_EQ(error_of([&] { model.number("gain"); }, kind),
            "the model has no number \"gain\", which wiener needs");
  EXPECT_EQ(model.tensor("mean", {2, 2}).values[3], 4.5);
  EXPECT_EQ(error_of([&] { model.tensor("mean", {4}); }, kind),
            "tensor \"mean\" of the model: expected shape [4], found [2, 2]");
  EXPECT_EQ(error_of([&] { model.tensor("mean", 3); }, kind),
            "tensor \"mean\" of the model: expected 3 dimensions, found 2");
  EXPECT_EQ(error_of([&] { model.tensor("bases", 2); }, kind),
            "the model has no tensor \"bases\", which wiener needs");
}

TEST(ShippedModels, AreReadableAndOfTheMethodTheyAreNamedAfter) {
  ASSERT_FALSE(shipped_models().empty());
  for (const ShippedModel& shipped : shipped_models()) {
    const auto model = shipped_model(shipped.method);
    EXPECT_EQ(model->method, shipped.method);
    EXPECT_EQ(shipped_model(shipped.method), model) << "parsed once";
    EXPECT_EQ(model_for(shipped.method, ""), model);
    EXPECT_EQ(write_model(*model), shipped.bytes);
    EXPECT_LT(shipped.bytes.size(), 5'000'000u);
    EXPECT_FALSE(model->card.licence.empty());
  }
}

TEST(ShippedModels, AreTheFilesOfTheFolder) {
  std::vector<std::string> files, shipped;
  const auto folder = std::filesystem::path(KINEMEND_TEST_FIXTURES) / "../../models";
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".kmodel") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  for (const ShippedModel& model : shipped_models()) shipped.emplace_back(model.bytes);
  EXPECT_THAT(shipped, testing::UnorderedElementsAreArray(files));
}

TEST(ModelFor, SaysWhereAModelComesFrom) {
  EXPECT_EQ(error_of([] { model_for("kalman-learned", ""); }, ErrorKind::usage),
            "method kalman-learned needs a model: --model FILE, made by kinemend train "
            "kalman-learned");
  const auto path = std::filesystem::path(testing::TempDir()) / "kinemend-model-for.kmodel";
  std::ofstream(path, std::ios::binary) << write_model(joints_model());
  EXPECT_EQ(model_for("wiener", path.string())->takes, 3u);
  EXPECT_THAT(error_of([&] { model_for("example", path.string()); }, ErrorKind::usage),
              HasSubstr("expected a model of method example, found one of wiener"));
  std::filesystem::remove(path);
}

// The hash of no bytes, from the specification of XXH3 (128 bits).
TEST(ModelChecksum, IsXxh3) {
  EXPECT_EQ(model_checksum(""), "99aa06d3014798d86001c324468d497f");
  EXPECT_NE(model_checksum("a"), model_checksum("b"));
  EXPECT_EQ(model_checksum("abc"), content_hash("abc"));
}

}  // namespace
}  // namespace kinemend
