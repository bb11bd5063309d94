#include "batch_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "batch_record.hpp"
#include "kinemend/io.hpp"
#include "kinemend/version.hpp"
#include "takes.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

std::size_t whole(const Json& row, const char* key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

double number(const Json& row, const char* key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// One line, whatever is in it.
std::string line_of(const Json& row) {
  return row.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

void BatchCounts::add(const Json& row, bool is_new, int code) {
  exit_code = std::max(exit_code, code);
  if (code != 0) {
    ++failed;
  } else if (row.at("status") == "copied") {
    ++copied;
  } else {
    ++(is_new ? cleaned : kept);
  }
}

void write_rows(const std::string& folder, const Shard& shard, const std::vector<Json>& rows) {
  std::string text;
  for (const Json& row : rows) text += line_of(row);
  const std::string name = shard.count == 1
                               ? "rows.jsonl"
                               : fmt::format("rows.{}-of-{}.jsonl", shard.index, shard.count);
  write_file(fs::path(folder) / name, text, true);
}

Json summary_of(const std::string& folder, const std::vector<BatchItem>& all,
                const std::string& options_hash) {
  std::size_t takes = 0, cleaned = 0, failed = 0, stale = 0, frames = 0, spikes = 0, gaps = 0;
  double duration_s = 0, seconds = 0;
  Json failures = Json::array();
  for (const BatchItem& item : all) {
    if (item.is_copied) continue;
    ++takes;
    const auto record = read_record(folder, item.name);
    if (!record || record->key.options != options_hash ||
        record->row.value("status", "") == "begun") {
      ++stale;
      continue;
    }
    const Json& row = record->row;
    if (record->output.empty()) {
      ++failed;
      failures.push_back({{"name", item.name}, {"error", row.value("error", "")}});
      continue;
    }
    ++cleaned;
    frames += whole(row, "frames");
    spikes += whole(row, "spikes");
    gaps += whole(row, "gaps");
    const double rate = number(row, "frame_rate_hz");
    if (rate > 0) duration_s += static_cast<double>(whole(row, "frames")) / rate;
    seconds += number(row, "seconds");
  }
  return {{"kinemend", version()}, {"options_hash", options_hash},
          {"takes", takes},        {"cleaned", cleaned},
          {"failed", failed},      {"to_do", stale},
          {"frames", frames},      {"duration_s", duration_s},
          {"seconds", seconds},    {"spikes", spikes},
          {"gaps", gaps},          {"failures", std::move(failures)}};
}

void write_summary(const std::string& folder, const Json& summary) {
  write_file(fs::path(folder) / "summary.json", json_text(summary), true);
}

std::string summary_text(const BatchCounts& counts, const Json& summary, const Shard& shard) {
  std::string text = fmt::format("{} cleaned, {} done already, {} failed", grouped(counts.cleaned),
                                 grouped(counts.kept), grouped(counts.failed));
  if (counts.copied > 0) text += fmt::format(", {} copied", counted(counts.copied, "skeleton"));
  if (shard.count > 1) text += fmt::format(" (part {} of {})", shard.index, shard.count);
  text += fmt::format("\nall parts: {} of {} done, {} failed, {} to do; {:.1f} minutes of motion\n",
                      grouped(whole(summary, "cleaned")), counted(whole(summary, "takes"), "take"),
                      grouped(whole(summary, "failed")), grouped(whole(summary, "to_do")),
                      number(summary, "duration_s") / 60);
  return text;
}

}  // namespace kinemend::cli
