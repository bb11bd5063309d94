#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/train.hpp"
#include "priors/shipped_list.hpp"

namespace kinemend {

std::vector<ShippedModel> shipped_models() {
  std::vector<ShippedModel> models;
  for (std::size_t i = 0; i < embedded_model_count; ++i) {
    const EmbeddedModel& model = embedded_models[i];
    models.push_back({model.method, {model.bytes, model.size}});
  }
  return models;
}

std::shared_ptr<const Model> shipped_model(std::string_view method) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Model>, std::less<>> parsed;
  const std::lock_guard lock(mutex);
  if (const auto found = parsed.find(method); found != parsed.end()) return found->second;
  const std::vector<ShippedModel> models = shipped_models();
  const auto shipped = std::find_if(models.begin(), models.end(), [&](const ShippedModel& model) {
    return model.method == method;
  });
  if (shipped == models.end()) {
    const auto methods = methods_with_models();
    const bool is_network =
        std::any_of(methods.begin(), methods.end(),
                    [&](const LearnedMethod& m) { return m.name == method && m.train == nullptr; });
    throw Error(ErrorKind::usage,
                fmt::format("method {0} needs a model: --model FILE, made by kinemend{1} {0}",
                            method, is_network ? "-train" : " train"));
  }
  auto model = std::make_shared<const Model>(
      parse_model(shipped->bytes, fmt::format("the {} model of this program", method)));
  parsed.emplace(method, model);
  return model;
}

std::shared_ptr<const Model> model_for(std::string_view method, const std::string& path,
                                       std::shared_ptr<const Model> given) {
  if (!given && path.empty()) return shipped_model(method);
  const std::string name = given ? "the model given" : path;
  if (!given) given = std::make_shared<const Model>(read_model(path));
  if (given->method != method) {
    throw Error(ErrorKind::usage, fmt::format("{}: expected a model of method {}, found one of {}",
                                              name, method, given->method));
  }
  return given;
}

}  // namespace kinemend
