// Reads models for the methods that work with them. The public functions, which know all methods,
// are in `registry/models.cpp`.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "kinemend/experimental/model.hpp"

namespace kinemend {

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

}  // namespace kinemend
