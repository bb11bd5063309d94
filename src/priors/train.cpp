#include "kinemend/train.hpp"

#include <fmt/format.h>

#include "base/named_table.hpp"
#include "kinemend/error.hpp"
#include "priors/train_list.hpp"

namespace kinemend {

namespace {

// Checked here and once, so that a typing error is known before any take is read.
OptionValues checked_options(const TrainMethod& method, const OptionValues& values) {
  OptionValues checked;
  for (const auto& [name, value] : values) {
    const OptionSpec& spec =
        find_option(method.options, name, fmt::format("training {}", method.name));
    checked[name] = check_option(spec, value);
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
  return find_named(train_methods(), name, "no model is trained for");
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
