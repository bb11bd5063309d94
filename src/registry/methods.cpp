// Lists all methods, in the order in which they are shown, and all kinds of models. Reads models of
// every method, and asks a method whether it can clean a take.
#include <fmt/format.h>

#include <array>
#include <vector>

#include "base/files.hpp"
#include "base/options.hpp"
#include "classic/entries.hpp"
#include "kinemend/cleaner.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/method_choice.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/methods.hpp"
#include "methods/auto/entries.hpp"
#include "methods/learned/entries.hpp"
#include "methods/prior/prior_cleaning.hpp"
#include "methods/wiener/entries.hpp"
#include "models/model_reading.hpp"
#include "papers/courty2008_bilateral/entries.hpp"
#include "papers/dean2016_nonlocal/entries.hpp"
#include "papers/lou2010_example/entries.hpp"
#include "papers/mall2017_recurrent/entries.hpp"
#include "papers/xiao2015_sparse/entries.hpp"

namespace kinemend {

std::span<const Method> methods() {
  static const std::vector<Method> table = [] {
    std::vector<Method> list;
    list.push_back(auto_method());
    list.push_back(bilateral_method());
    list.push_back(nonlocal_method());
    list.push_back(gaussian_method());
    list.push_back(butterworth_method());
    list.push_back(median_method());
    list.push_back(hampel_method());
    list.push_back(wavelet_method());
    list.push_back(weighted_mean_method());
    list.push_back(kalman_method());
    list.push_back(example_method());
    list.push_back(wiener_method());
    list.push_back(sparse_method());
    list.push_back(kalman_learned_method());
    list.push_back(recurrent_method());
    list.push_back(learned_method());
    list.push_back(one_euro_method());
    return list;
  }();
  return table;
}

const Method& find_method(std::string_view name) {
  return find_named(methods(), name, "unknown method");
}

std::unique_ptr<Cleaner> make_cleaner(std::string_view method, const OptionValues& values) {
  const Method& entry = find_method(method);
  for (const auto& [option, value] : values)
    find_option(entry.options, option, fmt::format("method {}", entry.name));
  return entry.make(values);
}

namespace {

const ModelKind& kind_of(std::string_view method) {
  return find_named(model_kinds(), method, "no model is known for");
}

}  // namespace

std::span<const ModelKind> model_kinds() {
  static constexpr std::array kinds = {example_models,        wiener_models,    sparse_models,
                                       kalman_learned_models, recurrent_models, learned_models};
  return kinds;
}

Model parse_model(std::string_view bytes, std::string_view name) {
  return parse_model_of(bytes, name, {model_kinds(), true});
}

Model read_model(const std::filesystem::path& path) {
  return parse_model(file_bytes(path), path.string());
}

std::shared_ptr<const Model> shipped_model(std::string_view method) {
  return shipped_model_of(kind_of(method));
}

std::shared_ptr<const Model> model_for(std::string_view method, const std::string& path,
                                       std::shared_ptr<const Model> given) {
  return model_of(kind_of(method), path, std::move(given));
}

std::string why_not(const Method& method, const Take& take) {
  try {
    const std::unique_ptr<Cleaner> cleaner = method.make({});
    const auto* const particular = dynamic_cast<const ParticularCleaner*>(cleaner.get());
    return particular == nullptr ? "" : particular->why_not(take);
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace kinemend
