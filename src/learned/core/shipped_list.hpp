#pragma once

#include <cstddef>

// What cmake/embed_models.cmake makes of the files in models/.
namespace kinemend {

struct EmbeddedModel {
  const char* method;  ///< the file's name without its extension
  const char* bytes;
  std::size_t size;
};
extern const EmbeddedModel* const embedded_models;
extern const std::size_t embedded_model_count;

}  // namespace kinemend
