// Tests of the networks of Mall et al. 2017, against LibTorch.
#include "papers/mall2017_recurrent/filter_network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/lab/synth.hpp"

namespace kinemend {
namespace {

// The random network of lab/networks/reference_filter_network.cpp for a root and two joints. Its
// tensor file also holds features and LibTorch's results.
Model small_model(const std::string& kind) {
  const std::string path = KINEMEND_TEST_FIXTURES "/nn/filter_" + kind + ".safetensors";
  std::ifstream file(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(file), {});
  Model model;
  model.method = "recurrent";
  model.rate_hz = 120;
  model.layout.names = {"Hips", "LeftUpLeg", "RightUpLeg"};
  model.layout.parents = {-1, 0, 0};
  model.layout.references.assign(3, Quat{});
  model.layout.bones.assign(3, Vec3{0, 1, 0});
  model.tensors = parse_tensors(bytes, path).tensors;
  model.tensors["mean"] = {TensorType::f32, {6}, std::vector<double>(6, 0.0)};
  model.tensors["deviation"] = {TensorType::f32, {6}, std::vector<double>(6, 1.0)};
  model.tensors["turning"] = {TensorType::f32, {3}, std::vector<double>(3, 1.0)};
  const bool has_encoder = kind == "ebf" || kind == "ebd";
  model.numbers = {{"head", kind == "ebf" || kind == "bf" ? 0.0 : 3.0},
                   {"stride", 1},
                   {"reach", kind == "nn" ? 3.0 : 0.0},
                   {"roughness", 0},
                   {"masks", kind == "ebd" ? 1.0 : 0.0},
                   {"encoders", has_encoder ? 4.0 : 0.0},
                   {"layers", kind == "nn" ? 0.0 : 2.0},
                   {"decoders", kind == "nn" ? 6.0 : 4.0}};
  return model;
}

std::string message_of(const Model& model) {
  try {
    filter_network_of(model);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

class EveryNetwork : public testing::TestWithParam<const char*> {};

TEST_P(EveryNetwork, AgreesWithLibTorchOnTheSameWeights) {
  const Model model = small_model(GetParam());
  const std::vector<float> outputs =
      run(filter_network_of(model), nn::floats_of(model.tensors.at("features")));
  const std::vector<double>& wanted = model.tensors.at("outputs").values;
  ASSERT_EQ(outputs.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(outputs[i], wanted[i], 1e-5) << "number " << i;
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryNetwork, testing::Values("ebf", "bf", "nn", "ebd"));

TEST(FilterNetwork, WithAStrideSeesEachPhaseByItself) {
  Model model = small_model("ebd");
  const std::vector<float> features = nn::floats_of(model.tensors.at("features"));
  const std::size_t width = features.size() / 19;
  model.numbers["stride"] = 4;
  const std::vector<float> outputs = run(filter_network_of(model), features);
  model.numbers["stride"] = 1;
  for (std::size_t phase = 0; phase < 4; ++phase) {
    std::vector<float> rows;
    for (std::size_t f = phase; f < 19; f += 4)
      rows.insert(rows.end(), features.begin() + static_cast<std::ptrdiff_t>(f * width),
                  features.begin() + static_cast<std::ptrdiff_t>((f + 1) * width));
    const std::vector<float> alone = run(filter_network_of(model), rows);
    for (std::size_t i = 0; i < alone.size(); ++i)
      EXPECT_EQ(outputs[(phase + 4 * (i / 6)) * 6 + i % 6], alone[i]);
  }
}

TEST(FilterNetwork, ThatDoesNotFitItselfOrItsBodyIsRefusedWithTheLayer) {
  Model model = small_model("ebf");
  model.tensors.erase("backward1.state.bias");
  EXPECT_EQ(message_of(model), "tensor backward1.state.bias is missing");
  model = small_model("ebf");
  model.numbers["stride"] = 0;
  EXPECT_EQ(message_of(model), "the model's stride is not between 1 and 64");
  model = small_model("ebf");
  model.numbers["head"] = 1;
  EXPECT_EQ(message_of(model), "the model's layer decoder: expected 12 numbers, found 6");
  model = small_model("ebf");
  model.numbers["masks"] = 1;
  EXPECT_EQ(message_of(model), "the model's layer encoder0: expected 11 numbers, found 9");
  model = small_model("ebf");
  model.tensors["deviation"].values[2] = 0;
  EXPECT_EQ(message_of(model), "the model's deviation is not positive everywhere");
  model = small_model("ebf");
  model.numbers.erase("head");
  EXPECT_EQ(message_of(model), "the model has no number \"head\", which recurrent needs");
}

TEST(FilterTake, HoldsTheJointsButTheRootAndHowTheRootTurns) {
  SynthOptions options;
  options.duration_s = 2;
  Take clip = synthesize(options);
  BodyLayoutBuilder builder;
  builder.add(clip);
  const BodyLayout layout = builder.finish();
  // An extra turn of 60 degrees per second about the vertical leaves the joint channels and adds 60
  // degrees per second to the root's angular velocity about the vertical.
  const FilterTake before =
      filter_take_of(encode_body(clip, layout, match_body(layout, clip)), layout);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double angle = radians_per_degree * 60 * static_cast<double>(f) / clip.frame_rate_hz;
    clip.rotation(f, 0) = exp({0, angle, 0}) * clip.rotation(f, 0);
  }
  const FilterTake after =
      filter_take_of(encode_body(clip, layout, match_body(layout, clip)), layout);
  ASSERT_EQ(before.channels, 3 * (layout.track_count() - 1));
  ASSERT_EQ(before.turning.size(), 3 * clip.frame_count());
  for (std::size_t i = 0; i < before.values.size(); ++i)
    EXPECT_NEAR(before.values[i], after.values[i], 1e-3);
  // The walker is nearly upright.
  for (std::size_t f = 1; f + 1 < clip.frame_count(); ++f)
    EXPECT_NEAR(after.turning[3 * f + 1] - before.turning[3 * f + 1], 60, 3) << "frame " << f;
}

}  // namespace
}  // namespace kinemend
