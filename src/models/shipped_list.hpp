// The models that cmake/embed_models.cmake compiles into the program from the files in models/.
#pragma once

#include <cstddef>

namespace kinemend {

struct EmbeddedModel {
  const char* method;  ///< the file's name without its extension
  const char* bytes;
  std::size_t size;
};
extern const EmbeddedModel* const embedded_models;
extern const std::size_t embedded_model_count;

}  // namespace kinemend
