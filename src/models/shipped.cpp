// Finds the model for a method: the one given, the one of a file, or the one compiled into the
// program.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <mutex>

#include "base/file_bytes.hpp"
#include "kinemend/error.hpp"
#include "kinemend/experimental/model.hpp"
#include "models/model_reading.hpp"
#include "models/shipped_list.hpp"

namespace kinemend {

std::vector<ShippedModel> shipped_models() {
  std::vector<ShippedModel> models;
  for (std::size_t i = 0; i < embedded_model_count; ++i) {
    const EmbeddedModel& model = embedded_models[i];
    models.push_back({model.method, {model.bytes, model.size}});
  }
  return models;
}

std::shared_ptr<const Model> shipped_model_of(const ModelKind& kind) {
  static std::mutex mutex;
  static std::map<std::string, std::shared_ptr<const Model>, std::less<>> parsed;
  const std::lock_guard lock(mutex);
  if (const auto found = parsed.find(kind.name); found != parsed.end()) return found->second;
  const std::vector<ShippedModel> models = shipped_models();
  const auto shipped = std::find_if(models.begin(), models.end(), [&](const ShippedModel& model) {
    return model.method == kind.name;
  });
  if (shipped == models.end()) {
    throw Error(ErrorKind::usage,
                fmt::format("method {0} needs a model: --model FILE, made by {1} {0}", kind.name,
                            kind.trained_by));
  }
  const std::string name = fmt::format("the {} model of this program", kind.name);
  auto model =
      std::make_shared<const Model>(parse_model_of(shipped->bytes, name, {{&kind, 1}, false}));
  parsed.emplace(kind.name, model);
  return model;
}

std::shared_ptr<const Model> model_of(const ModelKind& kind, const std::string& path,
                                      std::shared_ptr<const Model> given) {
  if (!given && path.empty()) return shipped_model_of(kind);
  const std::string name = given ? "the model given" : path;
  if (!given) {
    given =
        std::make_shared<const Model>(parse_model_of(file_bytes(path), path, {{&kind, 1}, false}));
  }
  if (given->method != kind.name) {
    throw Error(ErrorKind::usage, fmt::format("{}: expected a model of method {}, found one of {}",
                                              name, kind.name, given->method));
  }
  return given;
}

}  // namespace kinemend
