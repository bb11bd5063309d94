// Tests of tensor files against the reference writer's bytes, and of invalid files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "base/files.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/tensor.hpp"

namespace kinemend {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::filesystem::path> fixtures(const char* folder) {
  const auto path = std::filesystem::path(KINEMEND_TEST_FIXTURES) / "tensors" / folder;
  std::vector<std::filesystem::path> paths;
  if (!std::filesystem::exists(path)) return paths;
  for (const auto& entry : std::filesystem::directory_iterator(path)) paths.push_back(entry.path());
  return paths;
}

std::string good(const std::string& name) {
  return file_bytes(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "tensors/good" /
                    (name + ".safetensors"));
}

std::string message_of(const std::string& bytes) {
  try {
    parse_tensors(bytes, "a.kmodel");
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::unreadable_input);
    return error.what();
  }
  return "no error";
}

std::string message_of_bad(const std::string& name) {
  return message_of(file_bytes(std::filesystem::path(KINEMEND_TEST_FIXTURES) / "tensors/bad" /
                               (name + ".safetensors")));
}

std::string message_of_writing(const std::string& name, const Tensor& tensor) {
  TensorFile file;
  file.tensors[name] = tensor;
  try {
    write_tensors(file);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    return error.what();
  }
  return "no error";
}

// The contents that tools/reference/tensors.py writes.
TensorFile fixture() {
  TensorFile file;
  file.metadata = {{"kind", "fixture"}, {"text", "äöü \"x\"\n\t\\"}, {"zero", ""}};
  file.tensors["a.half"] = {
      TensorType::f16,
      {2, 3},
      {0, -1.5, 65504, std::ldexp(1, -24), std::ldexp(1, -14), -0.333251953125}};
  file.tensors["b.bytes"] = {TensorType::u8, {4}, {0, 1, 128, 255}};
  file.tensors["c.small"] = {TensorType::i8, {3}, {-128, 0, 127}};
  file.tensors["d.single"] = {
      TensorType::f32,
      {2, 1, 2},
      {1, -2.5, std::numeric_limits<float>::max(), std::numeric_limits<float>::denorm_min()}};
  file.tensors["e.whole"] = {TensorType::i32, {2}, {-2147483648.0, 2147483647.0}};
  file.tensors["f.double"] = {TensorType::f64, {2}, {3.141592653589793, -1e300}};
  file.tensors["g.number"] = {TensorType::f64, {}, {42}};
  file.tensors["h.nothing"] = {TensorType::f32, {0, 5}, {}};
  file.tensors["ä \"quoted\""] = {TensorType::u8, {1}, {7}};
  return file;
}

void expect_same(const TensorFile& a, const TensorFile& b) {
  EXPECT_EQ(a.metadata, b.metadata);
  ASSERT_EQ(a.tensors.size(), b.tensors.size());
  for (const auto& [name, tensor] : a.tensors) {
    ASSERT_TRUE(b.tensors.contains(name)) << name;
    const Tensor& other = b.tensors.at(name);
    EXPECT_EQ(tensor.stored, other.stored) << name;
    EXPECT_EQ(tensor.shape, other.shape) << name;
    EXPECT_EQ(tensor.values, other.values) << name;
  }
}

TEST(TensorFile, ReadsWhatOtherWritersWrite) {
  expect_same(parse_tensors(good("as_written"), "a"), fixture());
  expect_same(parse_tensors(good("other_writer"), "a"), fixture());
  expect_same(parse_tensors(good("empty"), "a"), {});
  expect_same(parse_tensors(good("metadata_only"), "a"), {fixture().metadata, {}});
}

TEST(TensorFile, WritesTheBytesOfTheReference) {
  EXPECT_EQ(write_tensors(fixture()), good("as_written"));
  EXPECT_EQ(write_tensors({}), good("empty"));
}

TEST(TensorFile, RefusesEveryBadFixtureInOneLineWithItsName) {
  ASSERT_GT(fixtures("bad").size(), 50u);
  for (const auto& path : fixtures("bad")) {
    const std::string message = message_of(file_bytes(path));
    EXPECT_THAT(message, testing::StartsWith("a.kmodel: byte ")) << path;
    EXPECT_EQ(message.find_first_of("\r\n"), message.npos) << path;
    EXPECT_LT(message.size(), 250u) << message;
  }
}

TEST(TensorFile, SaysWhichByteIsWrong) {
  EXPECT_EQ(message_of_bad("seven_bytes"),
            "a.kmodel: byte 0: expected 8 bytes with the length of a header, found 7");
  EXPECT_EQ(message_of_bad("cut_json"),
            "a.kmodel: byte 63: expected a header in JSON, found the end of the header");
  EXPECT_EQ(message_of_bad("name_twice"),
            "a.kmodel: byte 64: expected each name once, found \"a\" again");
  EXPECT_EQ(message_of_bad("unknown_type"),
            "a.kmodel: byte 27: tensor \"a\": expected a dtype of F64, F32, F16, I32, I8, U8, "
            "found \"BF16\"");
  EXPECT_EQ(message_of_bad("negative_offset"),
            "a.kmodel: byte 57: tensor \"a\": expected two whole numbers as data_offsets, found "
            "-4");
  EXPECT_EQ(message_of_bad("no_shape"), "a.kmodel: byte 48: tensor \"a\": shape is missing");
  EXPECT_THAT(message_of_bad("hole"), HasSubstr("tensor \"b\": expected its data at 4"));
  EXPECT_THAT(message_of_bad("overlap"), HasSubstr("tensor \"b\": expected its data at 8"));
  EXPECT_THAT(message_of_bad("data_after_last"),
              HasSubstr("expected tensors of 8 bytes in all, found 4"));
  EXPECT_THAT(message_of_bad("shape_too_large"),
              HasSubstr("expected the bytes of F32 of shape [2], found 4"));
  EXPECT_THAT(message_of_bad("header_of_all_memory"), HasSubstr("18446744073709551615"));
}

TEST(TensorFile, SaysWhichValueIsNotFinite) {
  const std::string bytes = good("as_written");
  const std::uint64_t begin =
      8 + static_cast<unsigned char>(bytes[0]) + 256u * static_cast<unsigned char>(bytes[1]);
  std::string broken = bytes;
  broken[begin + 4] = 0, broken[begin + 5] = 0x7C;
  EXPECT_EQ(message_of(broken), "a.kmodel: byte " + std::to_string(begin + 4) +
                                    ": tensor \"a.half\": expected a finite number, found inf");
}

TEST(TensorFile, IsSaneWhenCutOrPatchedAnywhere) {
  const std::string bytes = good("as_written");
  for (std::size_t length = 0; length < bytes.size(); ++length)
    EXPECT_NE(message_of(bytes.substr(0, length)), "no error") << length;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const char patch : {'\0', '"', '{', '}', '9', '\xFF'}) {
      std::string patched = bytes;
      patched[i] = patch;
      try {
        const TensorFile file = parse_tensors(patched, "a");
        expect_same(parse_tensors(write_tensors(file), "again"), file);
      } catch (const Error& error) {
        ASSERT_EQ(error.kind(), ErrorKind::unreadable_input) << i;
      }
    }
  }
}

TEST(TensorFile, RoundsToTheStoredType) {
  TensorFile file;
  file.tensors["half"] = {TensorType::f16, {3}, {0.1, 65519.9, 1e-9}};
  file.tensors["single"] = {TensorType::f32, {1}, {0.1}};
  file.tensors["whole"] = {TensorType::i32, {5}, {0.4, 0.5, 1.5, -2.5, -0.6}};
  const TensorFile again = parse_tensors(write_tensors(file), "a");
  EXPECT_THAT(again.tensors.at("half").values, ElementsAre(0.0999755859375, 65504, 0));
  EXPECT_THAT(again.tensors.at("single").values, ElementsAre(0.1f));
  EXPECT_THAT(again.tensors.at("whole").values, ElementsAre(0, 0, 2, -2, -1));
}

TEST(TensorFile, RefusesToWriteWhatDoesNotFit) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THAT(message_of_writing("a", {TensorType::f16, {1}, {65520}}),
              HasSubstr("tensor \"a\": 65520 is no number of F16"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f32, {1}, {1e39}}), HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f64, {1}, {infinity}}), HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f64, {1}, {std::nan("")}}),
              HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::u8, {1}, {-1}}), HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::u8, {1}, {255.6}}), HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::i32, {1}, {2147483648.0}}),
              HasSubstr("no number"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f32, {2, 2}, {1, 2, 3}}),
              HasSubstr("3 values have not shape [2, 2]"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f32, {0}, {1}}), HasSubstr("have not shape"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f32, {}, {}}), HasSubstr("have not shape"));
  EXPECT_THAT(message_of_writing("a", {TensorType::f32, {std::size_t{1} << 63, 2}, {}}),
              HasSubstr("have not shape"));
  EXPECT_THAT(message_of_writing("__metadata__", {}), HasSubstr("metadata"));
  EXPECT_THAT(message_of_writing("\xFF", {TensorType::u8, {1}, {1}}), HasSubstr("UTF-8"));
}

}  // namespace
}  // namespace kinemend
