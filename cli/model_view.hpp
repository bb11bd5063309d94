// Learned models as text, JSON and Markdown.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "kinemend/extend/model.hpp"

namespace kinemend::cli {

/// A model and the file it came from.
struct ModelFile {
  std::string name;  ///< path, or the method of a shipped model
  Model model;
  std::size_t bytes = 0;
  std::string checksum;
};
/// Errors: those of `parse_model`.
ModelFile model_file_of(std::string_view bytes, std::string_view name);
bool is_model_path(std::string_view path);

/// "31 joints, 96 channels"
std::string body_text(const BodyLayout& layout);
/// A table of facts, and on request the parts of the body.
std::string model_text(const ModelFile& file, bool with_parts);
nlohmann::ordered_json model_json(const ModelFile& file);
/// The card as a Markdown document.
std::string card_markdown(const ModelFile& file);

}  // namespace kinemend::cli
