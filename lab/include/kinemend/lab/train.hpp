// Fits models to clean takes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/model.hpp"
#include "kinemend/extend/options.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Clean takes of one kind, which are requested one at a time, each once, in order.
struct TrainingTakes {
  std::size_t count = 0;
  /// Returns a take, or empty if the take is to be left out.
  std::function<std::optional<Take>(std::size_t index)> take;
};

/// Thrown by a training that was asked to stop early. It can be resumed from its checkpoint.
class TrainingStopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the training was stopped"; }
};

/// Lets an interrupted training resume and produce the same bytes. A checkpoint holds finished
/// stages and the state of iterations; takes are read again.
struct TrainCheckpoint {
  /// The bytes last passed to `keep` by a training with the same takes, options, names and seed;
  /// empty: train from the beginning.
  std::string start;
  std::string name = "checkpoint";  ///< name of `start`, for messages
  /// Receives the whole checkpoint, which replaces the previous one. One call at a time, from any
  /// thread. Not set: no checkpoints are made.
  std::function<void(const std::string& bytes)> keep;
  /// Seconds between checkpoints of an iteration; the first is made at once.
  double every_s = 10;
  /// Returns whether the training is to stop; it then makes a checkpoint and throws
  /// `TrainingStopped`.
  std::function<bool()> stop;
};

class TrainingStages;

/// The settings that do not depend on the method.
struct TrainSettings {
  std::vector<std::string> names;  ///< joints or markers, or shell patterns; empty: all that move
  ModelCard card;
  std::uint64_t seed = 1;  ///< seed of all random numbers, whatever the method
  /// Largest number of bytes of motion in memory; the rest is kept in an unnamed temporary file.
  std::size_t most_memory = std::size_t{1} << 29;
  /// Receives the current stage and its progress (0..1).
  std::function<void(std::string_view stage, double done)> progress;
  TrainCheckpoint checkpoint;
  /// For the library only: `train_model` creates it from `checkpoint`.
  std::shared_ptr<TrainingStages> stages;
};

/// The training of a method's model; `find_method(name)` is the cleaner.
struct Training {
  std::string name;                 ///< name of the cleaning method
  int version = 1;                  ///< version of the model's tensors and numbers
  std::string summary;              ///< the parameters that are fitted, one line
  std::vector<OptionSpec> options;  ///< options of the training
  Model (*train)(const TrainingTakes& takes, const OptionValues& values,
                 const TrainSettings& settings);
};

/// Returns the trainings of all methods whose models `train_model` fits.
std::span<const Training> trainings();
/// Returns the training of the method of that name. Errors: `ErrorKind::usage`, with all names, or
/// naming the program that fits the models of this method.
const Training& find_training(std::string_view name);
/// Fits a model. Calibration frames are left out. Errors: `ErrorKind::usage` for an unknown method
/// or option, a value out of range, no takes, takes of different kinds or bodies (with the parts
/// named), takes that are all shorter than a window, and a checkpoint of other takes or options,
/// with the first difference; `ErrorKind::unreadable_input` for a damaged checkpoint;
/// `TrainingStopped`.
Model train_model(std::string_view method, const TrainingTakes& takes,
                  const OptionValues& values = {}, const TrainSettings& settings = {});

}  // namespace kinemend
