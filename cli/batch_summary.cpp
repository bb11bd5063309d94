// Appends rows under a lock, merges them with those of earlier runs, and adds up the records.
#include "batch_summary.hpp"

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "batch_record.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "platform/system.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

std::string rows_name(const Shard& shard) {
  return shard.count == 1 ? "rows.jsonl"
                          : fmt::format("rows.{}-of-{}.jsonl", shard.index, shard.count);
}

std::string rows_path(const std::string& folder, const Shard& shard) {
  return (fs::path(folder) / rows_name(shard)).string();
}

/// Reads the rows of earlier runs; the last row of a take is used.
std::vector<BatchRow> known_rows(const std::string& path) {
  std::vector<BatchRow> rows;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return rows;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line);) {
    if (std::optional<BatchRow> row = parse_row(line)) rows.push_back(std::move(*row));
  }
  return rows;
}

}  // namespace

void append_row(const std::string& folder, const Shard& shard, const BatchRow& row) {
  const std::string line = row.json + "\n";
  const std::string path = rows_path(folder, shard);
  // `write_rows` rewrites the file under the same lock.
  const TakeLock lock(folder, rows_name(shard));
  const int error = platform::append_to_file(path, line);
  if (error == 0) return;
  throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", path, std::strerror(error)));
}

void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<BatchRow>& rows) {
  std::map<std::string, std::string> lines;
  const TakeLock lock(folder, rows_name(shard));
  for (const BatchRow& row : known_rows(rows_path(folder, shard))) {
    const std::string& name = row.name;
    const auto record = read_record(folder, name);
    std::error_code ignored;
    const bool counts = record ? still_counts(folder, name, *record)
                               : fs::is_regular_file(fs::path(folder) / name, ignored);
    if (counts) lines[name] = row.json + "\n";
  }
  for (const BatchItem& item : all) lines.erase(item.name);
  for (const BatchRow& row : rows) lines[row.name] = row.json + "\n";
  std::string text;
  for (const auto& [name, line] : lines) text += line;
  write_file(rows_path(folder, shard), text, true);
}

BatchSums sums_of(const std::string& folder, const std::vector<BatchItem>& all,
                  const std::string& options_hash) {
  BatchSums sums;
  std::set<std::string> own;
  for (const BatchItem& item : all) {
    own.insert(item.name);
    if (item.is_copied) continue;
    const auto record = read_record(folder, item.name);
    const bool is_done =
        record && record->key.options == options_hash && record->row.status != "begun";
    sums.add(item.name, is_done ? &record->row : nullptr);
  }
  for (const std::string& name : recorded_names(folder)) {
    const auto record = own.count(name) > 0 ? std::nullopt : read_record(folder, name);
    if (!record || record->row.status == "copied" || !still_counts(folder, name, *record)) continue;
    sums.add(name, record->row.status != "begun" ? &record->row : nullptr);
  }
  return sums;
}

void write_summary(const std::string& folder, const std::string& summary) {
  write_file(fs::path(folder) / "summary.json", summary, true);
}

}  // namespace kinemend::cli
