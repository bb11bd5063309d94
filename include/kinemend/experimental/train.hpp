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

#include "kinemend/experimental/model.hpp"
#include "kinemend/options.hpp"
#include "kinemend/take.hpp"

namespace kinemend {

/// Clean takes of one kind, handed out one at a time: each is asked for once, in order.
struct TrainingTakes {
  std::size_t count = 0;
  /// Nothing for a take that is to be left out.
  std::function<std::optional<Take>(std::size_t index)> take;
};

/// A training was asked to end before it was done; it goes on from what it has kept.
class TrainingStopped : public std::exception {
 public:
  const char* what() const noexcept override { return "the training was stopped"; }
};

/// How a training that is broken off goes on later, to the same bytes. What is kept are stages that
/// are done and the state of iterations; takes are read again.
struct TrainCheckpoint {
  /// What `keep` was given last, by a training of the same takes, options, names and seed; empty:
  /// from the beginning.
  std::string start;
  std::string name = "checkpoint";  ///< of `start`, for messages
  /// Takes all that there is to keep, in place of what it took before. One call at a time, from any
  /// thread. Nothing: nothing is kept.
  std::function<void(const std::string& bytes)> keep;
  /// Seconds between the states of an iteration that are kept; the first is kept at once.
  double every_s = 10;
  /// Whether the training is to end: it keeps its state and throws `TrainingStopped`.
  std::function<bool()> stop;
};

class TrainingStages;

/// What does not depend on the method.
struct TrainSettings {
  std::vector<std::string> names;  ///< joints or markers, or shell patterns; empty: all that move
  ModelCard card;
  std::uint64_t seed = 1;  ///< of all that is drawn, whatever the method
  /// Bytes of motion that may lie in memory at once; what is more lies in a nameless file of the
  /// temporary folder.
  std::size_t most_memory = std::size_t{1} << 29;
  /// Called as work goes on with what is being done and how far it is (0..1).
  std::function<void(std::string_view stage, double done)> progress;
  TrainCheckpoint checkpoint;
  /// The library's own: what `train_model` makes of `checkpoint` for the method.
  std::shared_ptr<TrainingStages> stages;
};

/// A method with a learned model, as training and model files know it; `find_method(name)` is the
/// cleaner.
struct LearnedMethod {
  std::string name;     ///< that of the cleaning method
  int version = 1;      ///< of the model's tensors and numbers: the newest that is read, as written
  std::string summary;  ///< what is fitted, one line
  std::vector<OptionSpec> options;  ///< of the training
  /// nullptr for a network, which `kinemend-train` fits.
  Model (*train)(const TrainingTakes& takes, const OptionValues& values,
                 const TrainSettings& settings);
};

/// Those that `train_model` fits.
std::span<const LearnedMethod> learned_methods();
/// These, and the networks: all methods whose models are read.
std::span<const LearnedMethod> methods_with_models();
/// Errors: `ErrorKind::usage`, with the names there are.
const LearnedMethod& find_learned_method(std::string_view name);
/// Calibration frames are left out. Errors: `ErrorKind::usage` for an unknown method or option, a
/// value out of range, no takes, takes of different kinds or bodies (with the parts named), and
/// takes that are all shorter than a window; for a checkpoint of other takes or options, with the
/// first that differs. `ErrorKind::unreadable_input` for a damaged one. `TrainingStopped`.
Model train_model(std::string_view method, const TrainingTakes& takes,
                  const OptionValues& values = {}, const TrainSettings& settings = {});

}  // namespace kinemend
