// Names the kinds of models, and reads models, and the numbers of networks in them, for the methods
// that work with them; cmake/embed_models.cmake compiles the models in models/ into the program.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kinemend/extend/model.hpp"

namespace kinemend {

/// The models of each method that works with them, in the order of `model_kinds`.
inline constexpr ModelKind example_models{"example", 1, "kinemend train"};
inline constexpr ModelKind wiener_models{"wiener", 1, "kinemend train"};
inline constexpr ModelKind sparse_models{"sparse", 1, "kinemend train"};
inline constexpr ModelKind kalman_learned_models{"kalman-learned", 1, "kinemend train"};
inline constexpr ModelKind recurrent_models{"recurrent", 1, "kinemend-train"};
inline constexpr ModelKind learned_models{"learned", 1, "kinemend-train"};
inline constexpr ModelKind contact_models{"contacts", 1, "kinemend-train", false};

/// The kinds of models that a reader accepts.
struct KnownModels {
  std::span<const ModelKind> kinds;
  bool are_all = true;  ///< reject models of other methods; false: read them unchecked
};

/// Like `parse_model`, with its errors; the version of a model of an unknown method is not checked.
Model parse_model_of(std::string_view bytes, std::string_view name, const KnownModels& known);

/// Like `shipped_model`, by the kind of model.
std::shared_ptr<const Model> shipped_model_of(const ModelKind& kind);

/// Like `model_for`, by the kind of model.
std::shared_ptr<const Model> model_of(const ModelKind& kind, const std::string& path,
                                      std::shared_ptr<const Model> given = nullptr);

[[noreturn]] void refuse_network(const std::string& what);

/// A whole number of the model, between `least` and `most`.
std::size_t whole_number(const Model& model, const std::string& name, std::size_t least,
                         std::size_t most);
/// A tensor of `count` numbers, all above zero if `is_positive`.
std::vector<float> network_numbers(const Model& model, const char* name, std::size_t count,
                                   bool is_positive);
void check_width(const std::string& layer, std::size_t found, std::size_t expected);

struct EmbeddedModel {
  const char* method;  ///< the file's name without its extension
  const char* bytes;
  std::size_t size;
};
extern const EmbeddedModel* const embedded_models;
extern const std::size_t embedded_model_count;

}  // namespace kinemend
