// Reads models of every method.
#include "base/file_bytes.hpp"
#include "base/named_table.hpp"
#include "kinemend/experimental/model.hpp"
#include "kinemend/experimental/train.hpp"
#include "learned/core/model_reading.hpp"

namespace kinemend {

namespace {

const LearnedMethod& entry_of(std::string_view method) {
  return find_named(methods_with_models(), method, "no model is known for");
}

}  // namespace

Model parse_model(std::string_view bytes, std::string_view name) {
  return parse_model_of(bytes, name, {methods_with_models(), true});
}

Model read_model(const std::filesystem::path& path) {
  return parse_model(file_bytes(path), path.string());
}

std::shared_ptr<const Model> shipped_model(std::string_view method) {
  return shipped_model_of(entry_of(method));
}

std::shared_ptr<const Model> model_for(std::string_view method, const std::string& path,
                                       std::shared_ptr<const Model> given) {
  return model_of(entry_of(method), path, std::move(given));
}

}  // namespace kinemend
