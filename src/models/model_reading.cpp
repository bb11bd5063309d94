// Lists the kinds of models. Finds the model for a method (the one given, the one of a file, or the
// one compiled into the program), and looks up its numbers and tensors, with errors that name what
// is missing or invalid.
#include "models/model_reading.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <mutex>

#include "base/files.hpp"
#include "base/options.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/model.hpp"
#include "nn/layers.hpp"

namespace kinemend {

std::span<const ModelKind> model_kinds() {
  static constexpr std::array kinds = {example_models,        wiener_models,    sparse_models,
                                       kalman_learned_models, recurrent_models, learned_models,
                                       contact_models};
  return kinds;
}

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

namespace {

const ModelKind& kind_of(std::string_view method) {
  return find_named(model_kinds(), method, "no model is known for");
}

}  // namespace

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

namespace {

const Tensor& find_tensor(const Model& model, std::string_view name) {
  const auto found = model.tensors.find(name);
  if (found == model.tensors.end()) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("the model has no tensor \"{}\", which {} needs", name, model.method));
  }
  return found->second;
}

}  // namespace

double Model::number(std::string_view name) const {
  const auto found = numbers.find(name);
  if (found == numbers.end()) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("the model has no number \"{}\", which {} needs", name, method));
  }
  return found->second;
}

const Tensor& Model::tensor(std::string_view name, const std::vector<std::size_t>& shape) const {
  const Tensor& found = find_tensor(*this, name);
  if (found.shape != shape) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("tensor \"{}\" of the model: expected shape {}, found {}", name, shape,
                            found.shape));
  }
  return found;
}

// Without this overload `{3}` would be a count of dimensions.
const Tensor& Model::tensor(std::string_view name, std::initializer_list<std::size_t> shape) const {
  return tensor(name, std::vector<std::size_t>(shape));
}

const Tensor& Model::tensor(std::string_view name, std::size_t dimensions) const {
  const Tensor& found = find_tensor(*this, name);
  if (found.shape.size() != dimensions) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("tensor \"{}\" of the model: expected {} dimensions, found {}", name,
                            dimensions, found.shape.size()));
  }
  return found;
}

void refuse_network(const std::string& what) { throw Error(ErrorKind::unreadable_input, what); }

std::size_t whole_number(const Model& model, const std::string& name, std::size_t least,
                         std::size_t most) {
  const double value = model.number(name);
  if (!(value >= static_cast<double>(least) && value <= static_cast<double>(most)))
    refuse_network(fmt::format("the model's {} is not between {} and {}", name, least, most));
  return static_cast<std::size_t>(value);
}

std::vector<float> network_numbers(const Model& model, const char* name, std::size_t count,
                                   bool is_positive) {
  std::vector<float> values = nn::floats_of(model.tensor(name, {count}));
  if (is_positive && std::any_of(values.begin(), values.end(), [](float v) { return !(v > 0); }))
    refuse_network(fmt::format("the model's {} is not positive everywhere", name));
  return values;
}

void check_width(const std::string& layer, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  refuse_network(
      fmt::format("the model's layer {}: expected {} numbers, found {}", layer, expected, found));
}

}  // namespace kinemend
