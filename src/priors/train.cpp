#include "kinemend/train.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "kinemend/error.hpp"
#include "priors/train_list.hpp"

namespace kinemend {

namespace {

std::vector<std::string> names_of(const auto& entries) {
  std::vector<std::string> names;
  names.reserve(entries.size());
  for (const auto& entry : entries) names.push_back(entry.name);
  return names;
}

// Checked here and once, so that a typing error is known before any take is read.
OptionValues checked_options(const TrainMethod& method, const OptionValues& values) {
  OptionValues checked;
  for (const auto& [name, value] : values) {
    const auto spec =
        std::find_if(method.options.begin(), method.options.end(),
                     [&wanted = name](const OptionSpec& s) { return s.name == wanted; });
    if (spec == method.options.end()) {
      const std::vector<std::string> names = names_of(method.options);
      throw Error(ErrorKind::usage,
                  fmt::format("training {} has no option \"{}\"{} (it takes {})", method.name, name,
                              suggestion(name, names), fmt::join(names, ", ")));
    }
    checked[name] = check_option(*spec, value);
  }
  return checked;
}

}  // namespace

std::span<const TrainMethod> train_methods() {
  static const std::vector<TrainMethod> table = [] {
    std::vector<TrainMethod> list;
    list.push_back(example_training());
    list.push_back(wiener_training());
    list.push_back(kalman_learned_training());
    return list;
  }();
  return table;
}

const TrainMethod& find_train_method(std::string_view name) {
  for (const TrainMethod& method : train_methods()) {
    if (method.name == name) return method;
  }
  const std::vector<std::string> names = names_of(train_methods());
  throw Error(ErrorKind::usage, fmt::format("no model is trained for \"{}\"{} (there are {})", name,
                                            suggestion(name, names), fmt::join(names, ", ")));
}

Model train_model(std::string_view method, const TrainingTakes& takes, const OptionValues& values,
                  const TrainSettings& settings) {
  const TrainMethod& entry = find_train_method(method);
  const OptionValues checked = checked_options(entry, values);
  if (takes.count == 0) throw Error(ErrorKind::usage, "no takes to learn from");
  Model model = entry.train(takes, checked, settings);
  model.method = entry.name;
  model.takes = takes.count;
  model.card = settings.card;
  return model;
}

}  // namespace kinemend
