// Reads and writes records, locks takes against other processes, and removes temporary files of
// ended processes. Appends rows under a lock, merges them with those of earlier runs, and adds up
// the records.
#include "batch_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <system_error>
#include <utility>

#include "json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view records_folder = ".kinemend", record_extension = ".json";
constexpr std::size_t longest_file_name = 255;  // bytes

// The id of the process that made `.kinemend-PID-N.tmp`; 0 for any other name.
int maker_of(const std::string& name) {
  constexpr std::string_view start = ".kinemend-", end = ".tmp";
  if (name.size() <= start.size() + end.size() || name.compare(0, start.size(), start) != 0 ||
      name.compare(name.size() - end.size(), end.size(), end) != 0) {
    return 0;
  }
  int process = 0;
  std::from_chars(name.data() + start.size(), name.data() + name.size(), process);
  return process;
}

}  // namespace

std::string extended_name(const std::string& name, std::string_view extension) {
  const std::size_t begin = name.rfind('/') + 1;  // 0 without a folder
  if (name.size() - begin + extension.size() <= longest_file_name)
    return name + std::string(extension);
  const std::string hash = "~" + content_hash(name).substr(0, 16);
  std::size_t end = begin + longest_file_name - extension.size() - hash.size();
  // Cutting within a UTF-8 character would give a name that some file systems refuse.
  while (end > begin && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;
  return name.substr(0, end) + hash + std::string(extension);
}

std::string record_path(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / records_folder / extended_name(name, record_extension)).string();
}

std::optional<BatchRecord> read_record(const std::string& folder, const std::string& name) {
  const std::string path = record_path(folder, name);
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return std::nullopt;
  try {
    const Json json = parse_json<Json>(read_file(path));
    BatchRecord record;
    record.key = {json.at("input_hash").get<std::string>(),
                  json.at("options_hash").get<std::string>(),
                  json.at("kinemend").get<std::string>()};
    record.output = json.at("output_hash").get<std::string>();
    record.input = json.value("input", "");
    std::optional<BatchRow> row = parse_row(json.at("row").dump());
    if (!row) return std::nullopt;
    record.row = std::move(*row);
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<std::string> recorded_names(const std::string& folder) {
  const fs::path records = fs::path(folder) / records_folder;
  std::vector<std::string> names;
  std::error_code error;
  for (fs::recursive_directory_iterator entries(records, error), end; !error && entries != end;
       entries.increment(error)) {
    std::error_code ignored;
    const fs::path& path = entries->path();
    if (path.extension() != record_extension || !entries->is_regular_file(ignored)) continue;
    std::string name = path.lexically_relative(records).generic_string();
    name.resize(name.size() - record_extension.size());
    // Only the record has the whole name if the file name was cut.
    if (path.filename().string().size() > longest_file_name - 4) {
      if (const auto record = read_record(folder, name)) name = record->row.name;
    }
    names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

bool still_counts(const std::string& folder, const std::string& name, const BatchRecord& record) {
  std::error_code ignored;
  if (!record.output.empty()) return fs::is_regular_file(fs::path(folder) / name, ignored);
  return fs::exists(record.row.input, ignored);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder, error))
    error = std::make_error_code(std::errc::not_a_directory);
  if (error) {
    throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", folder.string(), error.message()));
  }
}

std::vector<fs::path> missing_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path path = fs::absolute(folder, error).lexically_normal();
       !path.empty() && !fs::exists(path, error) && path != path.parent_path();
       path = path.parent_path()) {
    if (path.has_filename()) missing.push_back(path);
  }
  return missing;
}

TakeLock::TakeLock(const std::string& folder, const std::string& name) {
  const fs::path path = fs::path(folder) / records_folder / "lock";
  make_folder(path.parent_path());
  // Each take locks one byte of the file, chosen by a hash of its name.
  constexpr std::uint64_t places = std::uint64_t{1} << 40;
  std::uint64_t place = 0;
  const std::string digits = content_hash(name).substr(0, 16);
  std::from_chars(digits.data(), digits.data() + digits.size(), place, 16);
  lock_.emplace(path, place % places);
}

void write_record(const std::string& folder, const std::string& name, const BatchRecord& record) {
  const fs::path path = record_path(folder, name);
  make_folder(path.parent_path());
  write_file(path,
             json_text({{"kinemend", record.key.version},
                        {"input", record.input},
                        {"input_hash", record.key.input},
                        {"options_hash", record.key.options},
                        {"output_hash", record.output},
                        {"row", parse_json<Json>(record.row.json)}}),
             true);
}

void remove_leftovers(const std::string& folder) {
  constexpr auto old = std::chrono::hours(1);
  std::error_code error;
  for (fs::recursive_directory_iterator entries(folder, error), end; !error && entries != end;
       entries.increment(error)) {
    const int process = maker_of(entries->path().filename().string());
    if (process == 0 || platform::process_is_running(process)) continue;
    std::error_code ignored;
    const auto age = fs::file_time_type::clock::now() - entries->last_write_time(ignored);
    if (!ignored && age > old) fs::remove(entries->path(), ignored);
  }
}

namespace {

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
