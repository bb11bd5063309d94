// Tests of the training of `learned`, on small networks.
#include "lab/networks/motion_training.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "kinemend/error.hpp"
#include "methods/learned/motion_network.hpp"
#include "synthetic_walks.hpp"

namespace kinemend::train {
namespace {

const TrainingSequences& walks_to_clean() {
  static const TrainingSequences sequences = encoded_walks(2);
  return sequences;
}

MotionTraining tiny_motion_training() {
  MotionTraining training;
  training.batches = 8;
  training.batch = 5;  // more than one part
  training.sampling.steps = 24;
  training.shape.encoded = 6;
  training.shape.slot_units = 4;
  training.shape.hidden = 12;
  training.shape.head = 8;
  training.shape.dilations = {1, 2};
  return training;
}

TEST(MotionTraining, GoesOnFromACheckpointToTheSameResult) {
  MotionTrainer whole(walks_to_clean(), {}, {}, {}, tiny_motion_training()),
      first(walks_to_clean(), {}, {}, {}, tiny_motion_training()),
      second(walks_to_clean(), {}, {}, {}, tiny_motion_training());
  for (int i = 0; i < 8; ++i) whole.step();
  for (int i = 0; i < 5; ++i) first.step();
  second.resume(first.checkpoint(), "checkpoint");
  EXPECT_EQ(second.batch(), 5u);
  for (int i = 0; i < 3; ++i) second.step();
  EXPECT_EQ(write_model(whole.model()), write_model(second.model()));
  EXPECT_EQ(whole.checkpoint(), second.checkpoint());
}

TEST(MotionTraining, DependsOnItsSeed) {
  MotionTraining other = tiny_motion_training();
  other.seed = 2;
  MotionTrainer a(walks_to_clean(), {}, {}, {}, tiny_motion_training()),
      b(walks_to_clean(), {}, {}, {}, other);
  a.step(), b.step();
  EXPECT_NE(write_model(a.model()), write_model(b.model()));
  EXPECT_THROW(b.resume(a.checkpoint(), "checkpoint"), Error);
  EXPECT_THROW(b.resume("no tensors", "checkpoint"), Error);
}

TEST(MotionTraining, BeginsWithAModel) {
  MotionTrainer trained(walks_to_clean(), {}, {}, {}, tiny_motion_training());
  for (int i = 0; i < 3; ++i) trained.step();
  MotionTraining other = tiny_motion_training();
  other.seed = 2;
  MotionTrainer next(walks_to_clean(), {}, {}, {}, other);
  next.begin_with(trained.model());
  EXPECT_EQ(write_model(next.model()), write_model(trained.model()));
  MotionTraining wider = other;
  wider.shape.hidden = 16;
  EXPECT_THROW(MotionTrainer(walks_to_clean(), {}, {}, {}, wider).begin_with(trained.model()),
               Error);
}

TEST(MotionTraining, LearnsToTakeNoiseOut) {
  MotionTraining training = tiny_motion_training();
  training.batches = 140;
  training.rate = 5e-3;
  MotionTrainer trainer(walks_to_clean(), {}, {}, {}, training);
  MotionSampling sampling = training.sampling;
  sampling.clean_share = 0;
  const double before = trainer.share_left({walks_to_clean(), trainer.mirror()}, sampling, 8, 5);
  for (int i = 0; i < 140; ++i) trainer.step();
  EXPECT_LT(trainer.share_left({walks_to_clean(), trainer.mirror()}, sampling, 8, 5),
            0.95 * before);
}

TEST(MotionTraining, MakesAModelThatTheLibraryReads) {
  MotionTrainer trainer(walks_to_clean(), {}, {}, {}, tiny_motion_training());
  trainer.step();
  const Model model = parse_model(write_model(trainer.model()), "model");
  const MotionNetwork network = motion_network_of(model);
  EXPECT_EQ(network.slots, walks_to_clean().layout.channel_count());
  EXPECT_EQ(network.blocks.size(), 2u);
}

}  // namespace
}  // namespace kinemend::train
