// Models, and their training on takes in memory or in files.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "conversions.hpp"
#include "held.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/train.hpp"
#include "running.hpp"

namespace kinemend::python {

namespace {

using namespace py::literals;
namespace fs = std::filesystem;

using ModelPtr = std::shared_ptr<Model>;
using TrainingTake = std::variant<HeldTakePtr, fs::path>;

Take take_for_training(const TrainingTake& source, const std::optional<std::string>& fill) {
  const auto* held = std::get_if<HeldTakePtr>(&source);
  if (held != nullptr) (*held)->check();
  Take take = held != nullptr ? (*held)->take : read_take(std::get<fs::path>(source)).take;
  if (fill) {
    FillSettings settings;
    settings.method = *fill;
    fill_gaps(take, settings);
  }
  return take;
}

ModelPtr train(const std::string& method, const std::vector<TrainingTake>& takes,
               const py::dict& options, const py::iterable& names,
               const std::optional<std::string>& fill, std::uint64_t seed, const py::dict& card,
               std::size_t threads, const py::object& progress) {
  const OptionValues values = option_values_of(options);
  TrainSettings settings;
  settings.names = all_bytes_of(names);
  settings.seed = seed;
  const auto said = [&](const char* name) {
    return card.contains(name) ? bytes_of(card[name]) : std::string();
  };
  settings.card = {said("title"), said("data"), said("licence"), said("command"), said("figures")};
  ModelPtr model;
  run_watched(progress, [&](const Tell& tell) {
    std::optional<ThreadLimit> limit;
    if (threads > 0) limit.emplace(threads);
    settings.progress = tell;
    const TrainingTakes source{takes.size(), [&](std::size_t index) -> std::optional<Take> {
                                 return take_for_training(takes[index], fill);
                               }};
    model = std::make_shared<Model>(train_model(method, source, values, settings));
  });
  return model;
}

py::bytes model_bytes(const Model& model) { return write_model(model); }

py::str model_words(const Model& model) {
  return text_of(fmt::format("<kinemend.Model for {}: {} {}, {:.0f} s of motion at {:g} Hz>",
                             model.method, model.layout.names.size(), to_string(model.layout.kind),
                             model.seconds, model.rate_hz));
}

void bind_model(py::module_& module) {
  py::class_<Model, ModelPtr> type(module, "Model",
                                   "What a method knows of human motion, as `train` makes it.");
  type.def_static(
      "read", [](const fs::path& path) { return std::make_shared<Model>(read_model(path)); },
      "path"_a, "A model from a file.");
  type.def_readonly("method", &Model::method, "The method that it is for.");
  type.def_readonly("fps", &Model::rate_hz, "Frames per second of the motion it was trained on.");
  type.def_readonly("takes", &Model::takes, "How many takes it was trained on.");
  type.def_readonly("seconds", &Model::seconds, "How much motion it was trained on.");
  type.def_property_readonly(
      "names", [](const Model& model) { return texts_of(model.layout.names); },
      "Joints or markers that it knows.");
  type.def_property_readonly(
      "kind", [](const Model& model) { return std::string(to_string(model.layout.kind)); },
      "\"joints\" or \"markers\".");
  type.def("to_bytes", model_bytes, "The bytes of its file.");
  type.def("__repr__", model_words);
  type.def(
      "write",
      [](const Model& model, const fs::path& path, bool overwrite) {
        write_file(path, write_model(model), overwrite);
      },
      "path"_a, py::kw_only(), "overwrite"_a = false, "Writes its file, `walk.kmodel`.");
}

}  // namespace

void bind_training(py::module_& module) {
  bind_model(module);
  module.def("train", train, "method"_a, "takes"_a, py::kw_only(), "options"_a, "names"_a, "fill"_a,
             "seed"_a, "card"_a, "threads"_a, "progress"_a);
}

}  // namespace kinemend::python
