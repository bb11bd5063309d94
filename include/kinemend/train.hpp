#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "kinemend/clip.hpp"
#include "kinemend/marker_clip.hpp"
#include "kinemend/model.hpp"
#include "kinemend/options.hpp"

// Fitting models to clean takes.
namespace kinemend {

/// Clean takes of one kind, handed out one at a time, so that memory does not grow with their
/// number. Each is asked for more than once.
struct TrainingTakes {
  std::size_t count = 0;
  std::function<std::variant<Clip, MarkerClip>(std::size_t index)> take;
};

/// What does not depend on the method.
struct TrainSettings {
  std::vector<std::string> names;  ///< joints or markers, or shell patterns; empty: all that move
  ModelCard card;
  /// Called as work goes on with what is being done and how far it is (0..1).
  std::function<void(std::string_view stage, double done)> progress;
};

/// A kind of model that can be trained.
struct TrainMethod {
  std::string name;     ///< that of the cleaning method
  std::string summary;  ///< one line
  std::vector<OptionSpec> options;
  Model (*train)(const TrainingTakes& takes, const OptionValues& values,
                 const TrainSettings& settings);
};

std::span<const TrainMethod> train_methods();
/// Errors: `ErrorKind::usage`, with the names there are.
const TrainMethod& find_train_method(std::string_view name);
/// Calibration frames are left out. Errors: `ErrorKind::usage` for an unknown method or option, a
/// value out of range, no takes, takes of different kinds or bodies (with the parts named), and
/// takes that are all shorter than a window.
Model train_model(std::string_view method, const TrainingTakes& takes,
                  const OptionValues& values = {}, const TrainSettings& settings = {});

}  // namespace kinemend
