// Finds the model for a method: the one given, the one of a file, or the one compiled into the
// program.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "base/file_bytes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "learned/core/model_reading.hpp"
#include "learned/core/shipped_list.hpp"

namespace kinemend {

std::vector<ShippedModel> shipped_models() {
  std::vector<ShippedModel> models;
  for (std::size_t i = 0; i < embedded_model_count; ++i) {
    const EmbeddedModel& model = embedded_models[i];
    models.push_back({model.method, {model.bytes, model.size}});
  }
  return models;
}

std::shared_ptr<const Model> shipped_model_of(const LearnedMethod& method) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Model>, std::less<>> parsed;
  const std::lock_guard lock(mutex);
  if (const auto found = parsed.find(method.name); found != parsed.end()) return found->second;
  const std::vector<ShippedModel> models = shipped_models();
  const auto shipped = std::find_if(models.begin(), models.end(), [&](const ShippedModel& model) {
    return model.method == method.name;
  });
  if (shipped == models.end()) {
    const bool is_network = method.train == nullptr;
    throw Error(ErrorKind::usage,
                fmt::format("method {0} needs a model: --model FILE, made by kinemend{1} {0}",
                            method.name, is_network ? "-train" : " train"));
  }
  const std::string name = fmt::format("the {} model of this program", method.name);
  auto model =
      std::make_shared<const Model>(parse_model_of(shipped->bytes, name, {{&method, 1}, false}));
  parsed.emplace(method.name, model);
  return model;
}

std::shared_ptr<const Model> model_of(const LearnedMethod& method, const std::string& path,
                                      std::shared_ptr<const Model> given) {
  if (!given && path.empty()) return shipped_model_of(method);
  const std::string name = given ? "the model given" : path;
  if (!given) {
    given = std::make_shared<const Model>(
        parse_model_of(file_bytes(path), path, {{&method, 1}, false}));
  }
  if (given->method != method.name) {
    throw Error(ErrorKind::usage, fmt::format("{}: expected a model of method {}, found one of {}",
                                              name, method.name, given->method));
  }
  return given;
}

}  // namespace kinemend
