#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/options.hpp"

// Fitting models to clean takes.
namespace kinemend {

/// Clean takes of one kind, handed out one at a time: each is asked for once, in order.
struct TrainingTakes {
  std::size_t count = 0;
  /// Nothing for a take that is to be left out.
  std::function<std::optional<std::variant<Clip, MarkerClip>>(std::size_t index)> take;
};

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
/// takes that are all shorter than a window.
Model train_model(std::string_view method, const TrainingTakes& takes,
                  const OptionValues& values = {}, const TrainSettings& settings = {});

}  // namespace kinemend
