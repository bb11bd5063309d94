// Tests of the training of Mall et al.'s networks: it resumes to the same result and reduces the
// error.
#include "lab/networks/filter_training.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::train {
namespace {

std::vector<Take> walks() {
  std::vector<Take> takes;
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    SynthOptions options;
    options.duration_s = 2;
    options.frame_rate_hz = 120;
    options.seed = seed;
    takes.push_back(synthesize(options));
  }
  return takes;
}

FilterTraining tiny(const char* kind, const char* head) {
  FilterTraining training;
  training.kind = kind;
  training.head = head;
  training.epochs = 6;
  training.batch = 2;
  training.frames = 48;
  training.uses = 2;
  training.noise = {{"gaussian-channels", {{"k", 0.5}}}};
  return training;
}

struct Kind {
  const char *name, *head;
};
class EveryKind : public testing::TestWithParam<Kind> {};

TEST_P(EveryKind, GoesOnFromACheckpointToTheSameResult) {
  FilterTraining training = tiny(GetParam().name, GetParam().head);
  if (training.kind == "ebd") training.gaps = {{"gaps", {{"start_probability", 0.05}}}};
  FilterTrainer whole(walks(), training), first(walks(), training), second(walks(), training);
  ASSERT_GE(whole.batches(), 8u);
  for (int i = 0; i < 8; ++i) whole.step();
  for (int i = 0; i < 5; ++i) first.step();
  second.resume(first.checkpoint(), "checkpoint");
  for (int i = 0; i < 3; ++i) second.step();
  EXPECT_EQ(write_model(whole.model()), write_model(second.model()));
  // The result is a network that can clean.
  const Model model = whole.model();
  const Take clip = walks()[0];
  const FilterTake take =
      filter_take_of(encode_body(clip, model.layout, match_body(model.layout, clip)), model.layout);
  for (const float value : filtered(filter_network_of(model), take))
    ASSERT_TRUE(std::isfinite(value));
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryKind,
                         testing::Values(Kind{"ebf", "gaussian"}, Kind{"ebf", "biased"},
                                         Kind{"bf", "shape"}, Kind{"nn", "residual"},
                                         Kind{"ebd", "residual"}, Kind{"ebd", "pose"}),
                         [](const auto& kind) {
                           return std::string(kind.param.name) + "_" + kind.param.head;
                         });

TEST(FilterTraining, DependsOnItsSeed) {
  FilterTraining other = tiny("ebf", "gaussian");
  other.seed = 2;
  FilterTrainer a(walks(), tiny("ebf", "gaussian")), b(walks(), other);
  a.step(), b.step();
  EXPECT_NE(write_model(a.model()), write_model(b.model()));
  EXPECT_THROW(b.resume(a.checkpoint(), "checkpoint"), Error);
  EXPECT_THROW(b.resume("no tensors", "checkpoint"), Error);
}

TEST(Checkpoints, WithoutTheirNumbersAreRefused) {
  FilterTrainer trainer(walks(), tiny("ebf", "gaussian"));
  TensorFile file = parse_tensors(trainer.checkpoint(), "good");
  file.metadata["batch"] = "many";
  EXPECT_THROW(trainer.resume(write_tensors(file), "damaged"), Error);
  file.metadata.erase("batch");
  EXPECT_THROW(trainer.resume(write_tensors(file), "damaged"), Error);
}

TEST(FilterTraining, LeavesLessErrorTheLongerItGoesOn) {
  // A free shape starts as the mean of 31 frames.
  FilterTraining training = tiny("ebf", "shape");
  training.epochs = 40;
  FilterTrainer trainer(walks(), training);
  const double before = trainer.share_left(walks());
  for (int i = 0; i < 120; ++i) trainer.step();
  EXPECT_LT(trainer.share_left(walks()), 0.9 * before);
}

TEST(FilterTraining, WithoutAHeadStartBeginsWithMoreErrorAndLearns) {
  FilterTraining training = tiny("ebf", "gaussian");
  training.epochs = 40;
  const FilterTrainer given(walks(), training);
  training.has_head_start = training.scales_loss = training.standardises = false;
  FilterTrainer drawn(walks(), training);
  const double before = drawn.share_left(walks());
  EXPECT_GT(before, 1.02 * given.share_left(walks()));
  for (int i = 0; i < 120; ++i) drawn.step();
  EXPECT_LT(drawn.share_left(walks()), 0.98 * before);
}

// The change of a layer's weights, in those of the first draw.
double moved(const Model& now, const Model& first, const std::string& layer) {
  double change = 0, size = 0;
  const std::vector<double>&a = now.tensors.at(layer).values, &b = first.tensors.at(layer).values;
  for (std::size_t i = 0; i < a.size(); ++i) {
    change += (a[i] - b[i]) * (a[i] - b[i]);
    size += b[i] * b[i];
  }
  return std::sqrt(change / size);
}

TEST(FilterTraining, MovesEveryLayerOfAnEncoderFromItsFirstWeights) {
  for (const bool has_head_start : {true, false}) {
    FilterTraining training = tiny("ebf", "gaussian");
    training.epochs = 40;
    training.rate = 5e-3;
    training.has_head_start = has_head_start;
    FilterTrainer trainer(walks(), training);
    const Model first = trainer.model();
    for (int i = 0; i < 60; ++i) trainer.step();
    const Model trained = trainer.model();
    for (const char* layer : {"encoder0.weight", "encoder1.weight", "encoder3.weight"}) {
      EXPECT_GT(moved(trained, first, layer), 0.1) << layer;
      EXPECT_LT(moved(trained, first, layer), 3) << layer;
    }
  }
}

// A network with the layers of a model, as it was before training.
Model untrained(const Model& model) {
  BidirectionalShape shape;
  shape.encoder.clear();
  shape.decoder.clear();
  const auto rows = [&](const std::string& layer) {
    return model.tensors.at(layer + ".weight").shape[0];
  };
  shape.inputs = model.tensors.at("encoder0.weight").shape[1];
  for (int i = 0; i < model.numbers.at("encoders"); ++i)
    shape.encoder.push_back(rows("encoder" + std::to_string(i)));
  for (int i = 0; i + 1 < model.numbers.at("decoders"); ++i)
    shape.decoder.push_back(rows("decoder" + std::to_string(i)));
  shape.units = rows("forward0.state") / 4;
  shape.outputs = rows("decoder" + std::to_string(shape.decoder.size()));
  Model first;
  first.tensors = SequenceNetwork(shape, {}, 1).averages();
  return first;
}

TEST(FilterTraining, EncodersOfTheNetworksInTheTreeAreNotTheirFirstDraw) {
  const std::string models = KINEMEND_TEST_FIXTURES "/../../lab/experiments/models/";
  for (const char* name : {"ebd", "shapes"}) {
    const Model model = read_model(models + name + ".kmodel");
    const Model first = untrained(model);
    // Ten passes move it by 0.085, forty by 0.166.
    EXPECT_GT(moved(model, first, "encoder0.weight"), 0.12) << name;
    // Two independent draws differ by 1.4.
    EXPECT_LT(moved(model, first, "encoder0.weight"), 1.2) << name;
  }
  const Model ships = *shipped_model("recurrent");
  EXPECT_GT(moved(ships, untrained(ships), "encoder0.weight"), 0.12);
}

TEST(FilterTraining, LearnsABiasThatIsOnTopOfTheNoise) {
  FilterTraining training = tiny("nn", "biased");
  training.epochs = 40;
  training.rate = 2e-2;
  training.noise = {{"gaussian-channels", {{"k", 0.02}}}};
  training.bias = {{"bias", {{"bias_deg", 2.0}, {"axis", std::string("x")}}}};
  FilterTrainer trainer(walks(), training);
  const double before = trainer.share_left(walks());
  for (int i = 0; i < 120; ++i) trainer.step();
  // No filter removes a constant bias.
  EXPECT_LT(trainer.share_left(walks()), 0.8 * before);
}

TEST(SequenceNetwork, OfLstmLayersIsTheSameWhetherItIsTrainedOrRun) {
  BidirectionalShape shape;
  shape.inputs = 5;
  shape.outputs = 3;
  shape.encoder = {6};
  shape.units = 4;
  shape.decoder = {6};
  SequenceNetwork network(shape, {.dropout = 0}, 1);
  // The last layer starts at zero.
  TensorFile state = network.state();
  for (auto& [name, tensor] : state.tensors) {
    for (std::size_t i = 0; i < tensor.values.size(); ++i)
      tensor.values[i] = 0.3 * std::sin(static_cast<double>(i) + 1);
  }
  network.set_state(state);
  std::vector<float> inputs;
  for (int i = 0; i < 11 * 5; ++i) inputs.push_back(static_cast<float>(std::cos(0.7 * i)));
  const std::vector<float> trained = network.forward(inputs, 1), run = network.run(inputs);
  ASSERT_EQ(trained.size(), run.size());
  for (std::size_t i = 0; i < run.size(); ++i) EXPECT_NEAR(trained[i], run[i], 1e-5);

  // The gradient norm of a step equals that of finite differences of sum(outputs).
  network.add_gradient(std::vector<float>(trained.size(), 1.0F));
  const double norm = network.step(0);
  double square = 0;
  for (const auto& [name, tensor] : state.tensors) {
    if (name.rfind("weights.", 0) != 0) continue;
    for (std::size_t i = 0; i < tensor.values.size(); ++i) {
      double change = 0;
      for (const double sign : {-1.0, 1.0}) {
        TensorFile moved = state;
        moved.tensors["means" + name.substr(7)].values[i] += sign * 1e-2;
        network.set_state(moved);
        for (const float value : network.run(inputs)) change += sign * static_cast<double>(value);
      }
      square += std::pow(change / 2e-2, 2);
    }
  }
  EXPECT_NEAR(norm, std::sqrt(square), 2e-3 * norm);
}

TEST(SequenceNetwork, DrawsTheWeightsOfDenseLayersWithinABoundWhereOneIsGiven) {
  BidirectionalShape shape;
  shape.inputs = 50;
  shape.outputs = 4;
  shape.weight_bound = 0.5;
  const TensorFile state = SequenceNetwork(shape, {}, 1).state();
  const auto largest = [&](const char* name) {
    double most = 0;
    for (const double value : state.tensors.at(name).values) most = std::max(most, std::abs(value));
    return most;
  };
  for (const char* layer :
       {"weights.encoder0.weight", "weights.encoder3.weight", "weights.decoder2.weight"}) {
    EXPECT_LE(largest(layer), 0.5) << layer;
    EXPECT_GT(largest(layer), 0.49) << layer;
  }
  EXPECT_EQ(largest("weights.decoder3.weight"), 0) << "begins with the constants";
}

TEST(SequenceNetwork, LetsTheSignalThroughAllItsLayersBeforeItHasLearned) {
  constexpr std::size_t frames = 60;
  BidirectionalShape shape;
  shape.inputs = 50;
  shape.outputs = 1;
  SequenceNetwork network(shape, {}, 1);
  TensorFile state = network.state();
  Tensor& last = state.tensors.at("means.decoder3.weight");
  for (std::size_t i = 0; i < last.values.size(); ++i)
    last.values[i] = (i % 2 == 0 ? 1 : -1) / std::sqrt(static_cast<double>(last.values.size()));
  network.set_state(state);
  // Each input is a different wave about 0 with deviation 1.
  std::vector<float> inputs;
  for (std::size_t i = 0; i < frames * shape.inputs; ++i) {
    const double frame = static_cast<double>(i / shape.inputs);
    const double channel = static_cast<double>(i % shape.inputs);
    inputs.push_back(static_cast<float>(std::sqrt(2) * std::sin(0.1 * frame + channel * channel)));
  }
  double sum = 0, square = 0;
  for (const float value : network.run(inputs)) {
    sum += static_cast<double>(value) / frames;
    square += static_cast<double>(value * value) / frames;
  }
  EXPECT_GT(std::sqrt(square - sum * sum), 0.04);
}

TEST(FilterTraining, RefusesWhatItCannotTrain) {
  EXPECT_THROW(FilterTrainer({}, tiny("ebf", "gaussian")), Error);
  EXPECT_THROW(FilterTrainer(walks(), tiny("tcn", "gaussian")), Error);
  EXPECT_THROW(FilterTrainer(walks(), tiny("ebf", "round")), Error);
  EXPECT_THROW(FilterTrainer(walks(), tiny("ebd", "gaussian")), Error);
}

}  // namespace
}  // namespace kinemend::train
