// Trains the method `kalman-learned`: the options of the training and the fit of its dynamics.
#include <cstdint>

#include "kinemend/error.hpp"
#include "lab/training/linear_dynamics_fit.hpp"
#include "lab/training/training_sequences.hpp"
#include "lab/training/trainings.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

struct KalmanLearnedTraining {
  double rate_hz = 30;
  std::int64_t order = 1;
  double ridge = 1e-4;
  std::int64_t directions = 0;
};

const OptionTable<KalmanLearnedTraining>& kalman_learned_training_table() {
  static const auto options =
      OptionTable<KalmanLearnedTraining>()
          .number(&KalmanLearnedTraining::rate_hz, "rate_hz", "Hz", 5, 500,
                  "rate of the model; takes at other rates are brought to it")
          .integer(&KalmanLearnedTraining::order, "order", "", 1, 2,
                   "poses that the next one follows from")
          .number(&KalmanLearnedTraining::ridge, "ridge", "", 0, 1,
                  "added to each variance in the fit, relative to it")
          .integer(&KalmanLearnedTraining::directions, "directions", "", 0, 1000,
                   "dimension of the subspace of poses that the model moves in; 0: all channels");
  return options;
}

Model train_kalman_learned(const TrainingTakes& takes, const OptionValues& values,
                           const TrainSettings& settings) {
  const KalmanLearnedTraining options = kalman_learned_training_table().parse(values);
  const TrainingSequences sequences = encode_takes(takes, settings, options.rate_hz);
  Model model;
  model.layout = sequences.layout;
  model.takes = sequences.takes;
  const auto order = static_cast<std::size_t>(options.order);
  LinearDynamicsFit fit(model.layout.channel_count(), order);
  model.seconds = for_each_sequence(
      sequences, order + 1, settings,
      [&](const TrainingSequence& sequence) { fit.add(sequence.poses, sequence.weight); });
  if (fit.transitions() <= 0)
    throw Error(ErrorKind::usage, "no take has two neighbouring frames that are whole");
  store_dynamics(fit.finish({options.rate_hz, order, options.ridge,
                             static_cast<std::size_t>(options.directions)}),
                 model);
  return model;
}

}  // namespace

Training kalman_learned_training() {
  return {"kalman-learned", kalman_learned_models.version,
          "linear dynamical system (Lou & Chai 2010, section 4.2)",
          kalman_learned_training_table().specs(), train_kalman_learned};
}

}  // namespace kinemend
