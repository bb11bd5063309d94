#include "batch_summary.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "batch_record.hpp"
#include "kinemend/error.hpp"
#include "kinemend/io.hpp"
#include "kinemend/version.hpp"
#include "takes.hpp"
#include "terminal.hpp"

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

std::vector<std::string> warnings_of(const Json& row) {
  std::vector<std::string> warnings;
  const auto found = row.find("warnings");
  if (found == row.end() || !found->is_array()) return warnings;
  for (const Json& warning : *found) {
    if (warning.is_string()) warnings.push_back(warning.get<std::string>());
  }
  return warnings;
}

std::string rows_name(const Shard& shard) {
  return shard.count == 1 ? "rows.jsonl"
                          : fmt::format("rows.{}-of-{}.jsonl", shard.index, shard.count);
}

std::string rows_path(const std::string& folder, const Shard& shard) {
  return (fs::path(folder) / rows_name(shard)).string();
}

/// What an earlier run has left; of a take with several rows the last holds.
std::vector<Json> known_rows(const std::string& path) {
  std::vector<Json> rows;
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return rows;
  std::istringstream lines(read_file(path));
  for (std::string line; std::getline(lines, line);) {
    Json row = Json::parse(line, nullptr, false);
    if (row.is_object()) rows.push_back(std::move(row));
  }
  return rows;
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
    return;
  }
  with_warnings += warnings_of(row).empty() ? 0 : 1;
  if (row.at("status") == "copied") {
    ++copied;
  } else {
    ++(is_new ? cleaned : kept);
  }
}

void append_row(const std::string& folder, const Shard& shard, const Json& row) {
  const std::string line = line_of(row);
  const std::string path = rows_path(folder, shard);
  // Found and put back by whoever writes the rows anew.
  const TakeLock lock(folder, rows_name(shard));
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const ssize_t count = file < 0 ? -1 : ::write(file, line.data(), line.size());
  const int error = errno;
  if (file >= 0) ::close(file);
  if (count == static_cast<ssize_t>(line.size())) return;
  throw Error(ErrorKind::cannot_write, fmt::format("{}: {}", path, std::strerror(error)));
}

void write_rows(const std::string& folder, const Shard& shard, const std::vector<BatchItem>& all,
                const std::vector<Json>& rows) {
  std::map<std::string, std::string> lines;
  const TakeLock lock(folder, rows_name(shard));
  for (const Json& row : known_rows(rows_path(folder, shard))) {
    const std::string name = row.value("name", "");
    const auto record = read_record(folder, name);
    std::error_code ignored;
    const bool counts = record ? still_counts(folder, name, *record)
                               : fs::is_regular_file(fs::path(folder) / name, ignored);
    if (counts) lines[name] = line_of(row);
  }
  for (const BatchItem& item : all) lines.erase(item.name);
  for (const Json& row : rows) lines[row.at("name").get<std::string>()] = line_of(row);
  std::string text;
  for (const auto& [name, line] : lines) text += line;
  write_file(rows_path(folder, shard), text, true);
}

namespace {

/// Sums over records.
struct Sums {
  std::size_t takes = 0, cleaned = 0, failed = 0, to_do = 0, frames = 0, spikes = 0, gaps = 0;
  double duration_s = 0, seconds = 0;
  Json failures = Json::array();

  void add(const std::string& name, const std::optional<BatchRecord>& record, bool is_current) {
    ++takes;
    if (!record || !is_current || record->row.value("status", "") == "begun") {
      ++to_do;
      return;
    }
    const Json& row = record->row;
    if (record->output.empty()) {
      ++failed;
      failures.push_back({{"name", name}, {"error", row.value("error", "")}});
      return;
    }
    ++cleaned;
    frames += whole(row, "frames");
    spikes += whole(row, "spikes");
    gaps += whole(row, "gaps");
    const double rate = number(row, "frame_rate_hz");
    if (rate > 0) duration_s += static_cast<double>(whole(row, "frames")) / rate;
    seconds += number(row, "seconds");
  }
};

}  // namespace

Json summary_of(const std::string& folder, const std::vector<BatchItem>& all,
                const std::string& options_hash) {
  Sums sums;
  std::set<std::string> own;
  for (const BatchItem& item : all) {
    own.insert(item.name);
    if (item.is_copied) continue;
    const auto record = read_record(folder, item.name);
    sums.add(item.name, record, record && record->key.options == options_hash);
  }
  for (const std::string& name : recorded_names(folder)) {
    const auto record = own.count(name) > 0 ? std::nullopt : read_record(folder, name);
    if (record && still_counts(folder, name, *record)) sums.add(name, record, true);
  }
  return {{"kinemend", version()},   {"options_hash", options_hash},
          {"takes", sums.takes},     {"cleaned", sums.cleaned},
          {"failed", sums.failed},   {"to_do", sums.to_do},
          {"frames", sums.frames},   {"duration_s", sums.duration_s},
          {"seconds", sums.seconds}, {"spikes", sums.spikes},
          {"gaps", sums.gaps},       {"failures", std::move(sums.failures)}};
}

void write_summary(const std::string& folder, const Json& summary) {
  write_file(fs::path(folder) / "summary.json", json_text(summary), true);
}

std::vector<Json> worst_rows(const std::vector<Json>& rows) {
  constexpr std::size_t most = 10;
  const auto badness = [](const Json& row) {
    const double frames = std::max(number(row, "frames"), 1.0);
    return std::pair(warnings_of(row).size(), number(row, "frames_repaired") / frames);
  };
  std::vector<Json> worst;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(worst), [&](const Json& row) {
    return row.at("status") == "cleaned" && badness(row) > std::pair(std::size_t{0}, 0.0);
  });
  std::stable_sort(worst.begin(), worst.end(),
                   [&](const Json& a, const Json& b) { return badness(a) > badness(b); });
  if (worst.size() > most) worst.resize(most);
  return worst;
}

std::string summary_text(const BatchCounts& counts, const Json& summary, const Shard& shard,
                         const std::vector<Json>& worst) {
  std::string text = fmt::format("{} cleaned, {} done already, {} failed", grouped(counts.cleaned),
                                 grouped(counts.kept), grouped(counts.failed));
  if (counts.copied > 0) text += fmt::format(", {} copied", counted(counts.copied, "skeleton"));
  if (counts.with_warnings > 0)
    text += fmt::format(", {} with warnings", grouped(counts.with_warnings));
  if (shard.count > 1) text += fmt::format(" (part {} of {})", shard.index, shard.count);
  text += fmt::format("\nall parts: {} of {} done, {} failed, {} to do; {:.1f} minutes of motion\n",
                      grouped(whole(summary, "cleaned")), counted(whole(summary, "takes"), "take"),
                      grouped(whole(summary, "failed")), grouped(whole(summary, "to_do")),
                      number(summary, "duration_s") / 60);
  if (worst.empty()) return text;
  text += worst.size() == 1 ? "most to be looked at:\n" : "most to be looked at, worst first:\n";
  for (const Json& row : worst) {
    const std::vector<std::string> warnings = warnings_of(row);
    text += fmt::format("  {}: {}", printable(row.value("name", "")),
                        printable(row.value("verdict", "")));
    if (!warnings.empty()) text += "; " + printable(warnings.front());
    if (warnings.size() > 1) text += fmt::format(" (and {} more)", warnings.size() - 1);
    text += "\n";
  }
  return text;
}

}  // namespace kinemend::cli
