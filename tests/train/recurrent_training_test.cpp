#include "recurrent_training.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinemend/error.hpp"
#include "priors/recurrent_network.hpp"
#include "random_values.hpp"
#include "synthetic_walks.hpp"

namespace kinemend::train {
namespace {

const TrainingSequences& two_walks() {
  static const TrainingSequences sequences = encoded_walks(2);
  return sequences;
}

RecurrentTraining tiny_training() {
  RecurrentTraining training;
  training.batches = 12;
  training.batch = 2;
  training.frames = 64;
  training.pool = 4;
  training.uses = 4;
  training.hidden = 8;
  training.dilations = {1, 2};
  return training;
}

TEST(RecurrentTraining, GoesOnFromACheckpointToTheSameResult) {
  RecurrentTrainer whole(two_walks(), tiny_training()), first(two_walks(), tiny_training()),
      second(two_walks(), tiny_training());
  for (int i = 0; i < 12; ++i) whole.step();
  // In the middle of the second pool of samples.
  for (int i = 0; i < 10; ++i) first.step();
  second.resume(first.checkpoint(), "checkpoint");
  EXPECT_EQ(second.batch(), 10u);
  for (int i = 0; i < 2; ++i) second.step();
  EXPECT_EQ(write_model(whole.model()), write_model(second.model()));
  EXPECT_EQ(whole.checkpoint(), second.checkpoint());
}

TEST(RecurrentTraining, DependsOnItsSeed) {
  RecurrentTraining other = tiny_training();
  other.seed = 2;
  RecurrentTrainer a(two_walks(), tiny_training()), b(two_walks(), other);
  a.step(), b.step();
  EXPECT_NE(write_model(a.model()), write_model(b.model()));
  EXPECT_THROW(b.resume(a.checkpoint(), "checkpoint"), Error);
  EXPECT_THROW(b.resume("no tensors", "checkpoint"), Error);
}

TEST(RecurrentTraining, BeginsAtAutoAndGetsBetterThanIt) {
  RecurrentTraining training = tiny_training();
  training.batches = 60;
  training.hidden = 16;
  training.rate = 5e-3;
  training.descent.average_decay = 0.8;
  RecurrentTrainer trainer(two_walks(), training);
  const RecurrentSample sample =
      recurrent_sample(two_walks().layout, 120, sequence_at(two_walks(), 0).poses, Random(3));
  EXPECT_EQ(trainer.share_left(sample), 1);
  double first = 0, last = 0;
  for (int i = 0; i < 60; ++i) {
    const double loss = trainer.step();
    (i < 20 ? first : last) += i < 20 || i >= 40 ? loss : 0;
  }
  EXPECT_LT(last, first);
}

TEST(RecurrentTraining, TheNetworkOfTheLibraryGivesWhatLibTorchGives) {
  RecurrentTrainer trainer(two_walks(), tiny_training());
  for (int i = 0; i < 3; ++i) trainer.step();
  Model model = trainer.model();
  model.takes = 2;
  const RecurrentSample sample =
      recurrent_sample(two_walks().layout, 120, sequence_at(two_walks(), 0).poses, Random(3));
  // In the precision of the file.
  const Model read = parse_model(write_model(model), "model");
  const RecurrentNetwork network = recurrent_network_of(read);
  const RecurrentInput input = recurrent_input(sample.take, network.statistics);
  const std::vector<float> ours = run(network, input.features);
  const std::vector<float> theirs = trainer.outputs(input.features);
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) EXPECT_NEAR(ours[i], theirs[i], 2e-3);
}

TEST(Checkpoints, WithoutTheirNumbersAreRefused) {
  RecurrentTrainer trainer(two_walks(), tiny_training());
  TensorFile file = parse_tensors(trainer.checkpoint(), "good");
  file.metadata["batch"] = "many";
  EXPECT_THROW(trainer.resume(write_tensors(file), "damaged"), Error);
  file.metadata.erase("batch");
  EXPECT_THROW(trainer.resume(write_tensors(file), "damaged"), Error);
}

}  // namespace
}  // namespace kinemend::train
