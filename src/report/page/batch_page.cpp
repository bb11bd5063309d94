// Makes the page of a batch.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kinemend/experimental/page.hpp"
#include "kinemend/experimental/text.hpp"
#include "report/page/document.hpp"

namespace kinemend {

namespace {

// Returns the text as a JSON string.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

std::string batch_page(std::span<const BatchPageRow> rows, const BatchSums& sums,
                       const PageSettings& settings) {
  page::check_is_built();
  // Rows and sums are already JSON.
  std::string text = "[";
  for (const BatchPageRow& entry : rows) {
    text += fmt::format("{}{{\"row\": {}, \"page\": {}, \"picture\": {}}}",
                        text.size() > 1 ? ",\n" : "", entry.row.json, quoted(entry.page),
                        quoted(entry.picture));
  }
  const std::string batch = fmt::format("{{\"command_line\": {}, \"summary\": {}, \"rows\": {}]}}",
                                        quoted(settings.command_line), to_json(sums, ""), text);
  const std::string verdict = fmt::format("{} of {} cleaned, {} failed", grouped(sums.cleaned),
                                          counted(sums.takes, "take"), grouped(sums.failed));
  return page::document("kinemend batch", verdict, {{"batch", batch}});
}

}  // namespace kinemend
