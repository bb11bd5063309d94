// Reads a table by its reader and keeps its bytes with the take.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "kinemend/io.hpp"

namespace kinemend {

/// Reads a table by `Reader(document, name, options).read()`, and keeps its bytes in the `Document`
/// that becomes the take's source.
template <class Document, class Reader>
TakeResult read_table(std::string&& bytes, std::string_view name, std::string_view format,
                      const ReadOptions& options) {
  const auto document = std::make_shared<Document>();
  document->bytes = std::move(bytes);
  TakeResult result = Reader(*document, name, options).read();
  SourceInfo& source = result.take.source;
  source.name = name;
  source.format = format;
  source.document = document;
  return result;
}

}  // namespace kinemend
