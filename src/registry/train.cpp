// The tables of methods that have models, and the steps that all trainings share.
#include "kinemend/experimental/train.hpp"

#include <fmt/format.h>

#include <memory>

#include "base/named_table.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/version.hpp"
#include "learned/core/training_stages.hpp"
#include "learned/corrector/entries.hpp"
#include "learned/example/entries.hpp"
#include "learned/papers/entries.hpp"
#include "learned/sparse/entries.hpp"
#include "learned/wiener/entries.hpp"

namespace kinemend {

namespace {

// The options are checked before any take is read, so that errors are reported early.
OptionValues checked_options(const LearnedMethod& method, const OptionValues& values) {
  OptionValues checked;
  for (const auto& [name, value] : values) {
    const OptionSpec& spec =
        find_option(method.options, name, fmt::format("training {}", method.name));
    checked[name] = check_option(spec, value);
  }
  return checked;
}

// Returns all facts, besides the takes and the card, on which the bytes of the model depend.
TrainingFacts facts_of(const LearnedMethod& method, const OptionValues& checked,
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

std::span<const LearnedMethod> learned_methods() {
  static const std::vector<LearnedMethod> table = {example_learned(), wiener_learned(),
                                                   sparse_learned(), kalman_learned_learned()};
  return table;
}

std::span<const LearnedMethod> methods_with_models() {
  static const std::vector<LearnedMethod> table = [] {
    const std::span<const LearnedMethod> fitted = learned_methods();
    std::vector<LearnedMethod> list(fitted.begin(), fitted.end());
    list.push_back(recurrent_learned());
    list.push_back(learned_learned());
    return list;
  }();
  return table;
}

const LearnedMethod& find_learned_method(std::string_view name) {
  for (const LearnedMethod& method : methods_with_models()) {
    if (method.name == name && method.train == nullptr)
      throw Error(ErrorKind::usage,
                  fmt::format("the network of {} is trained by kinemend-train", name));
  }
  return find_named(learned_methods(), name, "no model is trained for");
}

Model train_model(std::string_view method, const TrainingTakes& takes, const OptionValues& values,
                  const TrainSettings& settings) {
  const LearnedMethod& entry = find_learned_method(method);
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
