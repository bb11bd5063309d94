// Reads models of every method.
#include <array>

#include "base/file_bytes.hpp"
#include "base/named_table.hpp"
#include "classic/entries.hpp"
#include "kinemend/experimental/model.hpp"
#include "methods/learned/entries.hpp"
#include "methods/wiener/entries.hpp"
#include "models/model_reading.hpp"
#include "papers/lou2010_example/entries.hpp"
#include "papers/mall2017_recurrent/entries.hpp"
#include "papers/xiao2015_sparse/entries.hpp"

namespace kinemend {

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

}  // namespace kinemend
