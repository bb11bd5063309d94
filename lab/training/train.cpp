// The table of trainings, and the steps that they share.
#include "kinemend/lab/train.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "base/options.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"
#include "lab/training/training_stages.hpp"
#include "lab/training/trainings.hpp"

namespace kinemend {

namespace {

// The options are checked before any take is read, so that errors are reported early.
OptionValues checked_options(const Training& method, const OptionValues& values) {
  OptionValues checked;
  for (const auto& [name, value] : values) {
    const OptionSpec& spec =
        find_option(method.options, name, fmt::format("training {}", method.name));
    checked[name] = check_option(spec, value);
  }
  return checked;
}

// Returns all facts, besides the takes and the card, on which the bytes of the model depend.
TrainingFacts facts_of(const Training& method, const OptionValues& checked,
                       const TrainSettings& settings) {
  TrainingFacts facts = {{"method", fmt::format("{} {}", method.name, method.version)},
                         {"kinemend", std::string(version())}};
  for (const OptionSpec& option : method.options) {
    const auto given = checked.find(option.name);
    facts.emplace_back(option.name,
                       to_string(given == checked.end() ? option.default_value : given->second));
  }
  facts.emplace_back("seed", fmt::format("{}", settings.seed));
  facts.emplace_back("names", settings.names.empty()
                                  ? std::string("all that move")
                                  : fmt::format("{}", fmt::join(settings.names, ",")));
  return facts;
}

}  // namespace

std::span<const Training> trainings() {
  static const std::vector<Training> table = {example_training(), wiener_training(),
                                              sparse_training(), kalman_learned_training()};
  return table;
}

const Training& find_training(std::string_view name) {
  const std::span<const Training> known = trainings();
  const bool is_known = std::any_of(known.begin(), known.end(),
                                    [&](const Training& entry) { return entry.name == name; });
  for (const ModelKind& kind : model_kinds()) {
    if (!is_known && kind.name == name)
      throw Error(ErrorKind::usage,
                  fmt::format("the network of {} is trained by {}", name, kind.trained_by));
  }
  return find_named(known, name, "no model is trained for");
}

Model train_model(std::string_view method, const TrainingTakes& takes, const OptionValues& values,
                  const TrainSettings& settings) {
  const Training& entry = find_training(method);
  const OptionValues checked = checked_options(entry, values);
  TrainSettings own = settings;
  own.stages = std::make_shared<TrainingStages>(std::move(own.checkpoint),
                                                facts_of(entry, checked, settings));
  Model model = entry.train(takes, checked, own);
  model.method = entry.name;
  model.version = entry.version;
  model.card = settings.card;
  return model;
}

}  // namespace kinemend
