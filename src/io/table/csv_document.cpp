// Keeps the other data of a table through a conversion.
#include "io/table/csv_document.hpp"

namespace kinemend {

std::shared_ptr<const SourceDocument> CsvDocument::after(const TakeChange& /*change*/) const {
  if (beside.empty()) return nullptr;
  auto rest = std::make_shared<TableRest>();
  rest->beside = beside;
  return rest;
}

std::shared_ptr<const SourceDocument> TableRest::after(const TakeChange& /*change*/) const {
  return std::make_shared<TableRest>(*this);
}

}  // namespace kinemend
