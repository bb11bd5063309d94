// Trains the method `wiener`: the options of the training, and its passes over the takes.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lab/training/training_sequences.hpp"
#include "lab/training/training_stages.hpp"
#include "lab/training/trainings.hpp"
#include "lab/training/wiener_fit.hpp"
#include "models/model_reading.hpp"

namespace kinemend {

namespace {

struct WienerTraining {
  double rate_hz = 120;
  double window_s = 0.5;
  std::int64_t coefficients = 20;
  std::int64_t rank = 120;
  std::int64_t components = 8;
  std::int64_t rounds = 10;
  std::int64_t windows = 12'000;
};

const OptionTable<WienerTraining>& wiener_training_table() {
  static const auto options =
      OptionTable<WienerTraining>()
          .number(&WienerTraining::rate_hz, "rate_hz", "Hz", 10, 500,
                  "rate of the model; takes at other rates are brought to it")
          .number(&WienerTraining::window_s, "window_s", "s", 0.1, 4, "length of a window")
          .integer(&WienerTraining::coefficients, "coefficients", "", 2, 200,
                   "DCT coefficients of a channel that are learned together")
          .integer(&WienerTraining::rank, "rank", "", 1, 1000,
                   "directions in which windows move together")
          .integer(&WienerTraining::components, "components", "", 1, 200,
                   "Gaussians of the mixture")
          .integer(&WienerTraining::rounds, "rounds", "", 0, 1000,
                   "rounds of expectation maximisation")
          .integer(&WienerTraining::windows, "windows", "", 10, 1e6,
                   "windows that the mixture is fitted to, drawn from all");
  return options;
}

// Runs both passes over the motion, or restores their results. Returns the seconds of motion.
double find_windows(const TrainingSequences& sequences, const TrainSettings& settings,
                    WienerFit& fit) {
  const std::string stage = "windows";
  if (const std::string_view kept = settings.stages->kept(stage); !kept.empty()) {
    StageReader reader(kept);
    const auto seconds = reader.value<double>();
    const std::vector<char> state = reader.values<char>();
    fit.restore({state.data(), state.size()});
    return seconds;
  }
  const double seconds = for_each_sequence(
      sequences, fit.window_frames(), settings, [&](const TrainingSequence& sequence) {
        for_each_half(sequence, sequences.takes, fit.window_frames(),
                      [&](std::size_t half, const PoseMatrix& poses) {
                        fit.add_moments(poses, sequence.weight, half);
                      });
      });
  fit.find_basis();
  for_each_sequence(sequences, fit.window_frames(), settings,
                    [&](const TrainingSequence& sequence) { fit.add_windows(sequence.poses); });
  StageWriter writer;
  writer.value(seconds);
  writer.values(std::span<const char>(fit.stored()));
  settings.stages->keep(stage, writer.take());
  settings.stages->stop_if_asked();
  return seconds;
}

Model train_wiener(const TrainingTakes& takes, const OptionValues& values,
                   const TrainSettings& settings) {
  const WienerTraining options = wiener_training_table().parse(values);
  const TrainingSequences sequences = encode_takes(takes, settings, options.rate_hz);
  Model model;
  model.layout = sequences.layout;
  model.takes = sequences.takes;
  model.rate_hz = options.rate_hz;
  WienerFitSettings fitting;
  fitting.rate_hz = options.rate_hz;
  fitting.window_s = options.window_s;
  fitting.coefficients = static_cast<std::size_t>(options.coefficients);
  fitting.rank = static_cast<std::size_t>(options.rank);
  fitting.components = static_cast<std::size_t>(options.components);
  fitting.rounds = static_cast<std::size_t>(options.rounds);
  fitting.windows = static_cast<std::size_t>(options.windows);
  fitting.seed = settings.seed;
  WienerFit fit(model.layout.channel_count(), fitting);
  model.seconds = find_windows(sequences, settings, fit);
  store_wiener_prior(fit.finish(settings.stages.get()), model);
  return model;
}

}  // namespace

Training wiener_training() {
  return {"wiener", wiener_models.version, "mixture of Gaussians over windows, in a temporal DCT",
          wiener_training_table().specs(), train_wiener};
}

}  // namespace kinemend
