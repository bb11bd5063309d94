// Makes the rows and sums of a batch, and reads rows back.
#include "kinemend/experimental/batch_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "kinemend/experimental/json_depth.hpp"
#include "kinemend/experimental/text.hpp"
#include "kinemend/experimental/version.hpp"
#include "report/json.hpp"

namespace kinemend {

namespace {

// Rows are read from files, which may hold anything.
std::string word(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::size_t whole(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

double number(const Json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : 0.0;
}

std::vector<std::string> words(const Json& json, const char* key) {
  std::vector<std::string> list;
  const auto found = json.find(key);
  if (found == json.end() || !found->is_array()) return list;
  for (const Json& entry : *found) {
    if (entry.is_string()) list.push_back(entry.get<std::string>());
  }
  return list;
}

BatchRow row_of(const Json& json) {
  const auto found = json.find("figures");
  const Json figures = found != json.end() && found->is_object() ? *found : Json::object();
  BatchRow row;
  row.name = word(json, "name");
  row.status = word(json, "status");
  row.input = word(json, "input");
  row.verdict = word(json, "verdict");
  row.error = word(json, "error");
  row.warnings = words(json, "warnings");
  row.frames = whole(json, "frames");
  row.frames_repaired = whole(figures, "frames_repaired");
  row.spikes = whole(figures, "spikes");
  row.gaps = whole(figures, "gaps");
  row.frame_rate_hz = number(json, "frame_rate_hz");
  row.seconds = number(figures, "seconds");
  row.json = text_of(json, -1);
  return row;
}

Json heading(std::string_view name, std::string_view status) {
  return {{"schema", report_schema}, {"name", name}, {"status", status}};
}

}  // namespace

BatchRow plain_row(std::string_view name, std::string_view status) {
  return row_of(heading(name, status));
}

BatchRow cleaned_row(std::string_view name, const Report& report,
                     const std::vector<std::string>& warnings) {
  Json json = heading(name, "cleaned");
  json.update(take_json(report, Depth::row));
  json["warnings"] = warnings;
  return row_of(json);
}

BatchRow failed_row(std::string_view name, std::string_view input, std::string_view error,
                    int exit_code, const std::vector<std::string>& warnings) {
  Json json = heading(name, "failed");
  json.update(failure_entry(input, error, exit_code));
  if (!warnings.empty()) json["warnings"] = warnings;
  return row_of(json);
}

std::optional<BatchRow> parse_row(std::string_view json) {
  const Json parsed = parse_json<Json>(json, false);
  return parsed.is_object() ? std::optional(row_of(parsed)) : std::nullopt;
}

std::vector<BatchRow> worst_rows(std::span<const BatchRow> rows, std::size_t most) {
  const auto badness = [](const BatchRow& row) {
    const auto frames = static_cast<double>(std::max(row.frames, std::size_t{1}));
    return std::pair(row.warnings.size(), static_cast<double>(row.frames_repaired) / frames);
  };
  std::vector<BatchRow> worst;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(worst), [&](const BatchRow& row) {
    return row.status == "cleaned" && badness(row) > std::pair(std::size_t{0}, 0.0);
  });
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const BatchRow& a, const BatchRow& b) { return badness(a) > badness(b); });
  if (worst.size() > most) worst.resize(most);
  return worst;
}

void BatchSums::add(std::string_view name, const BatchRow* row) {
  ++takes;
  if (row == nullptr) {
    ++to_do;
  } else if (row->status == "failed") {
    ++failed;
    failures.emplace_back(name, row->error);
  } else {
    ++cleaned;
    frames += row->frames;
    spikes += row->spikes;
    gaps += row->gaps;
    if (row->frame_rate_hz > 0) duration_s += static_cast<double>(row->frames) / row->frame_rate_hz;
    seconds += row->seconds;
  }
}

std::string to_json(const BatchSums& sums, std::string_view options_hash) {
  Json failures = Json::array();
  for (const auto& [name, error] : sums.failures)
    failures.push_back({{"name", name}, {"error", error}});
  return text_of(Json{{"schema", report_schema},
                      {"kinemend", version()},
                      {"command", "batch"},
                      {"options_hash", options_hash},
                      {"figures",
                       {{"takes", sums.takes},
                        {"cleaned", sums.cleaned},
                        {"failed", sums.failed},
                        {"to_do", sums.to_do},
                        {"frames", sums.frames},
                        {"duration_s", sums.duration_s},
                        {"seconds", sums.seconds},
                        {"spikes", sums.spikes},
                        {"gaps", sums.gaps}}},
                      {"failures", std::move(failures)}}) +
         "\n";
}

void BatchCounts::add(const BatchRow& row, bool is_new, int code) {
  exit_code = std::max(exit_code, code);
  if (code != 0) {
    ++failed;
    return;
  }
  with_warnings += row.warnings.empty() ? 0 : 1;
  if (row.status == "copied") {
    ++copied;
  } else {
    ++(is_new ? cleaned : kept);
  }
}

std::string to_text(const BatchCounts& counts, const BatchSums& sums,
                    std::span<const BatchRow> worst) {
  std::string text = fmt::format("{} cleaned, {} done already, {} failed", grouped(counts.cleaned),
                                 grouped(counts.kept), grouped(counts.failed));
  if (counts.copied > 0) text += fmt::format(", {} copied", counted(counts.copied, "skeleton"));
  if (counts.with_warnings > 0)
    text += fmt::format(", {} with warnings", grouped(counts.with_warnings));
  if (counts.parts > 1) text += fmt::format(" (part {} of {})", counts.part, counts.parts);
  text += fmt::format("\n{}: {} of {} done, {} failed, {} to do; {:.1f} minutes of motion\n",
                      counts.parts > 1 ? "all parts" : "in total", grouped(sums.cleaned),
                      counted(sums.takes, "take"), grouped(sums.failed), grouped(sums.to_do),
                      sums.duration_s / 60);
  if (worst.empty()) return text;
  text += worst.size() == 1 ? "needs review:\n" : "needs review, worst first:\n";
  for (const BatchRow& row : worst) {
    text += fmt::format("  {}: {}", printable(row.name), printable(row.verdict));
    if (!row.warnings.empty()) text += "; " + printable(row.warnings.front());
    if (row.warnings.size() > 1) text += fmt::format(" (and {} more)", row.warnings.size() - 1);
    text += "\n";
  }
  return text;
}

}  // namespace kinemend
