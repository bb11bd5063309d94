#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "kinemend/experimental/page.hpp"
#include "kinemend/experimental/text.hpp"
#include "page/document.hpp"

namespace kinemend {

std::string batch_page(std::span<const BatchPageRow> rows, const BatchSums& sums,
                       const PageSettings& settings) {
  page::check_is_built();
  // Rows and sums are JSON already.
  std::string text = "[";
  for (const BatchPageRow& entry : rows) {
    const nlohmann::json link = entry.page;
    text +=
        fmt::format("{}{{\"row\": {}, \"page\": {}}}", text.size() > 1 ? ",\n" : "", entry.row.json,
                    link.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  }
  const nlohmann::json command = settings.command_line;
  const std::string batch =
      fmt::format("{{\"command_line\": {}, \"summary\": {}, \"rows\": {}]}}",
                  command.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
                  to_json(sums, ""), text);
  const std::string verdict = fmt::format("{} of {} cleaned, {} failed", grouped(sums.cleaned),
                                          counted(sums.takes, "take"), grouped(sums.failed));
  return page::document("kinemend batch", verdict, {{"batch", batch}});
}

}  // namespace kinemend
