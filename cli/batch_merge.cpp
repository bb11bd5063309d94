// Reads files of rows, checks that they belong together, and writes their rows and sums.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch_record.hpp"
#include "json.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/pages.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"
#include "takes.hpp"
#include "terminal.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

/// A row with the file it was read from.
struct FoundRow {
  std::string json;
  std::size_t file = 0;  ///< index of the file
};
using FoundRows = std::map<std::string, FoundRow>;

/// Facts about the whole batch in the summaries beside the rows.
struct WholeBatch {
  std::string options_hash;
  std::string from;       ///< the summary that stated it
  std::size_t takes = 0;  ///< of all shards; 0 if no summary is there
};

/// The row without its times, which differ between runs of the same work.
Json without_times(std::string_view row) {
  Json json = parse_json<Json>(row);
  if (const auto figures = json.find("figures"); figures != json.end() && figures->is_object()) {
    figures->erase("seconds");
    figures->erase("frames_per_second");
  }
  return json;
}

/// Reads the rows of one file; the last row of a take is kept. Returns the number of malformed
/// lines.
std::size_t read_rows(const std::string& path, std::size_t file, FoundRows& rows) {
  const std::string text = read_file(path);
  std::size_t malformed = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = std::string_view(text).substr(begin, end - begin);
    begin = end + 1;
    std::optional<BatchRow> row = parse_row(line);
    if (!row || row->name.empty())
      malformed += line.empty() ? 0 : 1;
    else
      rows[row->name] = {std::move(row->json), file};
  }
  return malformed;
}

void add_rows(const std::vector<std::string>& paths, std::size_t file, FoundRows& all) {
  FoundRows own;
  const std::size_t malformed = read_rows(paths[file], file, own);
  // A shard without takes has an empty file.
  if (own.empty() && malformed > 0)
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: holds no row", paths[file]));
  if (malformed > 0)
    say_warning(fmt::format("{}: ignored {}", paths[file], counted(malformed, "malformed line")));
  for (auto& [name, row] : own) {
    const auto known = all.find(name);
    if (known != all.end() && without_times(known->second.json) != without_times(row.json)) {
      throw Error(ErrorKind::unreadable_input,
                  fmt::format("{} and {} tell {} differently; give only the rows of one batch",
                              paths[known->second.file], paths[file], printable_name(name)));
    }
    all[name] = std::move(row);
  }
}

/// "rows.3-of-8.jsonl" is part 3 of 8; returns nullopt for other names.
std::optional<Shard> shard_of(const std::string& path) {
  const std::string name = fs::path(path).filename().string();
  constexpr std::string_view start = "rows.", between = "-of-", end = ".jsonl";
  const std::size_t middle = name.find(between);
  if (!name.starts_with(start) || !name.ends_with(end) || middle == std::string::npos)
    return std::nullopt;
  const std::string index = name.substr(start.size(), middle - start.size());
  const std::size_t after = middle + between.size();
  try {
    return parse_shard(index + "/" + name.substr(after, name.size() - end.size() - after));
  } catch (const Error&) {
    return std::nullopt;
  }
}

/// The shards without rows, by the names of the files; empty if the names are not those of shards.
std::vector<std::string> missing_shards(const std::vector<std::string>& paths) {
  std::map<std::uint64_t, std::set<std::uint64_t>> given;
  for (const std::string& path : paths) {
    if (const std::optional<Shard> shard = shard_of(path)) given[shard->count].insert(shard->index);
  }
  std::vector<std::string> missing;
  constexpr std::uint64_t most = 1000000;
  for (const auto& [count, indices] : given) {
    for (std::uint64_t i = 1; i <= std::min(count, most); ++i) {
      if (indices.count(i) == 0) missing.push_back(fmt::format("{}/{}", i, count));
    }
  }
  return missing;
}

void add_summary(const fs::path& path, WholeBatch& whole) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return;
  std::string options_hash;
  std::size_t takes = 0;
  try {
    const Json summary = parse_json<Json>(read_file(path));
    options_hash = summary.at("options_hash").get<std::string>();
    takes = summary.at("figures").at("takes").get<std::size_t>();
  } catch (const Json::exception&) {
    throw Error(ErrorKind::unreadable_input, path.string() + ": is not the summary of a batch");
  }
  if (!whole.from.empty() && options_hash != whole.options_hash) {
    throw Error(
        ErrorKind::unreadable_input,
        fmt::format("{} and {} were made with different settings", whole.from, path.string()));
  }
  whole = {std::move(options_hash), path.string(), std::max(takes, whole.takes)};
}

WholeBatch whole_batch(const std::vector<std::string>& paths) {
  std::set<fs::path> folders;
  for (const std::string& path : paths) folders.insert(fs::path(path).parent_path());
  WholeBatch whole;
  for (const fs::path& folder : folders) add_summary(folder / "summary.json", whole);
  return whole;
}

void refuse_other_options(const Arguments& arguments) {
  static constexpr std::array<std::string_view, 5> allowed{"merge", "output_dir", "force", "json",
                                                           "quiet"};
  const auto refuse = [&](const std::string& name) {
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) return;
    throw Error(ErrorKind::usage,
                fmt::format("batch: --{} has no effect with --merge", dashed(name)));
  };
  for (const auto& [name, value] : arguments.values) refuse(name);
  for (const auto& [name, list] : arguments.lists) refuse(name);
  for (const auto& [name, text] : arguments.group_texts) refuse(name);
}

/// Returns whether the existing file holds rows, which a batch may have written.
bool are_rows(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) return false;
  const std::string text = read_file(path);
  return text.empty() || parse_row(std::string_view(text).substr(0, text.find('\n'))).has_value();
}

void check_outputs(const std::vector<std::string>& paths, const std::string& folder,
                   const Arguments& arguments) {
  const std::string rows = (fs::path(folder) / "rows.jsonl").string();
  RunFiles().reads("ROWS", paths).writes("--output-dir", rows).check(arguments.flag("json"));
  // The folder is created only after the rows are known to belong together.
  std::error_code ignored;
  if (fs::is_directory(folder, ignored))
    check_free(rows, arguments.flag("force") || are_rows(rows));
}

int code_of(const BatchRow& row) {
  if (row.status != "failed") return 0;
  const Json json = parse_json<Json>(row.json);
  const auto code = json.find("exit_code");
  const bool is_known = code != json.end() && code->is_number_integer();
  return is_known ? code->get<int>() : static_cast<int>(ErrorKind::unreadable_input);
}

/// Rows and sums in the order of a single run.
struct Merged {
  std::string text;
  BatchSums sums;
  BatchCounts counts;
  std::vector<BatchRow> worst;  ///< at most ten, without rows that are not shown
};

Merged merged(FoundRows& rows, std::size_t takes) {
  constexpr std::size_t most_waiting = 1000;
  Merged result;
  for (auto& [name, found] : rows) {
    std::optional<BatchRow> row = parse_row(found.json);
    result.text += found.json + "\n";
    found.json = {};
    result.counts.add(*row, true, code_of(*row));
    if (row->status == "copied") continue;
    result.sums.add(name, row->status == "begun" ? nullptr : &*row);
    result.worst.push_back(std::move(*row));
    if (result.worst.size() >= most_waiting) result.worst = worst_rows(result.worst);
  }
  result.worst = worst_rows(result.worst);
  for (std::size_t known = result.sums.takes; known < takes; ++known) result.sums.add("", nullptr);
  return result;
}

int say_missing(const std::vector<std::string>& paths, const BatchSums& sums) {
  const std::vector<std::string> missing = missing_shards(paths);
  constexpr std::size_t most = 10;
  if (!missing.empty()) {
    const std::vector<std::string> first(
        missing.begin(),
        missing.begin() + static_cast<std::ptrdiff_t>(std::min(most, missing.size())));
    say_error(fmt::format("batch: no rows of {}: {}{}", counted(missing.size(), "shard"),
                          fmt::join(first, ", "), missing.size() > most ? ", ..." : ""));
  }
  if (sums.to_do > 0) {
    say_error(
        fmt::format("batch: {} not done yet; run the shards again", counted(sums.to_do, "take")));
  }
  return missing.empty() && sums.to_do == 0 ? 0 : static_cast<int>(ErrorKind::unreadable_input);
}

}  // namespace

int merge_batch(const Arguments& arguments) {
  refuse_other_options(arguments);
  const std::vector<std::string>& paths = arguments.positionals;
  const std::string folder = arguments.text("output_dir");
  if (paths.empty())
    throw Error(ErrorKind::usage, "batch: --merge needs the files of rows of the shards");
  check_outputs(paths, folder, arguments);
  FoundRows rows;
  for (std::size_t file = 0; file < paths.size(); ++file) add_rows(paths, file, rows);
  if (rows.empty())
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: holds no row", paths.front()));
  const WholeBatch whole = whole_batch(paths);
  const Merged result = merged(rows, whole.takes);
  make_folder(folder);
  write_file(fs::path(folder) / "rows.jsonl", result.text, true);
  const std::string summary = to_json(result.sums, whole.options_hash);
  write_summary(folder, summary);
  const int missing = say_missing(paths, result.sums);
  if (arguments.flag("json")) {
    write_out(summary);
  } else if (!arguments.flag("quiet")) {
    write_out(to_text(result.counts, result.sums, result.worst));
  }
  return std::max(result.counts.exit_code, missing);
}

}  // namespace kinemend::cli
