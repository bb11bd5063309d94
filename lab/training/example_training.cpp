// Trains the method `example`: the options of the training, the bases, and their cross-validation.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "kinemend/error.hpp"
#include "lab/training/channel_ranges.hpp"
#include "lab/training/training_sequences.hpp"
#include "lab/training/trainings.hpp"
#include "models/model_reading.hpp"
#include "papers/lou2010_example/example.hpp"
#include "papers/lou2010_example/filter_bases.hpp"

namespace kinemend {

namespace {

struct ExampleTraining {
  double rate_hz = 30;
  double window_s = 20.0 / 30;  // the paper: 20 frames at 30 Hz
  std::int64_t bases = 0;
  double energy = 0.99;
  bool centred = true;
  double trend_s = 0.5;
};

// Two square matrices of this side are held: 1 GiB. Chosen by hand, not swept.
constexpr std::size_t largest_window_values = 8192;
// Quantiles of a channel in the training that define its range. Chosen by hand, not swept.
constexpr double lowest_share = 0.001, highest_share = 0.999;

const OptionTable<ExampleTraining>& example_training_table() {
  static const auto options =
      OptionTable<ExampleTraining>()
          .number(&ExampleTraining::rate_hz, "rate_hz", "Hz", 5, 500,
                  "rate of the model; takes at other rates are brought to it")
          .number(&ExampleTraining::window_s, "window_s", "s", 0.01, 10, "length of a window")
          .integer(&ExampleTraining::bases, "bases", "", 0, largest_window_values,
                   "number of filter bases; 0: by energy")
          .number(&ExampleTraining::energy, "energy", "", 0.01, 1,
                  "share of the motion's energy that the bases keep")
          .flag(&ExampleTraining::centred, "centred",
                "patterns of the motion about its mean pose; off: of poses as they are")
          .number(&ExampleTraining::trend_s, "trend_s", "s", 0.01, 10,
                  "smoothing of the place and heading that motion is seen from");
  return options;
}

std::size_t window_frames(const ExampleTraining& options, std::size_t channels) {
  const auto frames =
      static_cast<std::size_t>(std::max(1L, std::lround(options.window_s * options.rate_hz)));
  if (frames * channels > largest_window_values) {
    throw Error(ErrorKind::usage,
                "window_s: a window of " + std::to_string(frames) + " frames x " +
                    std::to_string(channels) + " channels is more than " +
                    std::to_string(largest_window_values) +
                    " values; take a shorter window, a lower rate or fewer joints or markers");
  }
  return frames;
}

Model train_example(const TrainingTakes& takes, const OptionValues& values,
                    const TrainSettings& settings) {
  const ExampleTraining options = example_training_table().parse(values);
  const TrainingSequences sequences =
      encode_takes(takes, settings, options.rate_hz, options.trend_s);
  Model model;
  model.layout = sequences.layout;
  model.takes = sequences.takes;
  const std::size_t channels = model.layout.channel_count();
  const std::size_t window = window_frames(options, channels);
  LagCovariance covariance(window, channels);
  ChannelRanges ranges(channels);
  std::array<LagCovariance, 2> halves{LagCovariance(window, channels),
                                      LagCovariance(window, channels)};
  model.seconds =
      for_each_sequence(sequences, window, settings, [&](const TrainingSequence& sequence) {
        covariance.add(sequence.poses, sequence.weight);
        for_each_half(sequence, sequences.takes, window,
                      [&](std::size_t half, const PoseMatrix& poses) {
                        halves[half].add(poses, sequence.weight);
                      });
        ranges.add(sequence.poses, sequence.weight);
      });
  if (covariance.windows() <= 0) {
    throw Error(ErrorKind::usage, "no take has a stretch without gaps of " +
                                      std::to_string(window) + " frames, which is a window");
  }
  ExamplePrior prior;
  prior.rate_hz = options.rate_hz;
  prior.bases = filter_bases(covariance, {options.energy, static_cast<std::size_t>(options.bases)},
                             options.centred);
  if (prior.bases.count == 0) throw Error(ErrorKind::usage, "nothing moves in these takes");
  if (halves[0].windows() > 0 && halves[1].windows() > 0)
    cross_validate(prior.bases, halves[0], halves[1], options.centred);
  for (std::size_t c = 0; c < channels; ++c) {
    prior.lowest.push_back(ranges.quantile(c, lowest_share));
    prior.highest.push_back(ranges.quantile(c, highest_share));
  }
  store_example(prior, model);
  return model;
}

}  // namespace

Training example_training() {
  return {"example", example_models.version, "filter bases by M-SSA (Lou & Chai 2010, section 3.1)",
          example_training_table().specs(), train_example};
}

}  // namespace kinemend
