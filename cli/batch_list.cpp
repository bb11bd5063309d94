// Walks folders, reads lists, and keeps the takes that belong to a shard.
#include "batch_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "kinemend/error.hpp"
#include "kinemend/extend/system.hpp"
#include "kinemend/extend/text.hpp"
#include "kinemend/io.hpp"
#include "run_files.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

bool is_hidden(const fs::path& path) {
  const std::string name = path.filename().string();
  return !name.empty() && name.front() == '.';
}

bool is_skeleton(const fs::path& path) {
  const Format* format = format_of_path(path);
  return format != nullptr && format->name == "asf";
}

// Many programs write CSV and npz files, so these must begin like a take.
bool looks_like_take(const fs::path& path) {
  const Format* format = format_of_path(path);
  if (format == nullptr || format->read == nullptr) return false;
  if (format->name != "csv" && format->name != "npz") return true;
  std::string head(4096, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  constexpr int likely = 50;
  return format->sniff(head) >= likely;
}

void add_folder(const fs::path& folder, const fs::path& output, const std::string& pattern,
                std::vector<BatchItem>& items) {
  std::error_code error;
  fs::recursive_directory_iterator entries(folder, error);
  if (error) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}: {}", folder.string(), error.message()));
  }
  for (; entries != fs::recursive_directory_iterator(); entries.increment(error)) {
    const fs::path& path = entries->path();
    if (entries->is_directory(error)) {
      if (is_hidden(path) || fs::equivalent(path, output, error))
        entries.disable_recursion_pending();
      continue;
    }
    if (is_hidden(path) || !entries->is_regular_file(error)) continue;
    const std::string name = path.filename().string();
    if (is_skeleton(path)) {
      items.push_back({path.string(), path.lexically_relative(folder).generic_string(), true});
    } else if ((pattern.empty() || matches_wildcards(pattern, name)) && looks_like_take(path)) {
      items.push_back({path.string(), path.lexically_relative(folder).generic_string(), false});
    }
  }
}

void add_file(const std::string& input, std::vector<BatchItem>& items) {
  const fs::path name = fs::path(input).lexically_normal();
  std::error_code error;
  if (name.is_absolute() && !fs::exists(name, error)) {
    throw Error(ErrorKind::unreadable_input, fmt::format("{}: No such file or directory", input));
  }
  if (name.is_absolute() || name.empty() || *name.begin() == "..") {
    throw Error(
        ErrorKind::usage,
        fmt::format("batch: {} has no place below the output folder; give its folder, or a path "
                    "below the current folder",
                    input));
  }
  items.push_back({input, name.generic_string(), is_skeleton(name)});
}

}  // namespace

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard.index);
  const bool slash = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = slash ? std::from_chars(first.ptr + 1, end, shard.count) : first;
  const bool valid = slash && second.ec == std::errc() && second.ptr == end && shard.index >= 1 &&
                     shard.index <= shard.count;
  if (!valid) {
    throw Error(ErrorKind::usage,
                fmt::format("--shard: \"{}\" is not I/N with I from 1 to N", text));
  }
  return shard;
}

bool in_shard(std::string_view name, const Shard& shard) {
  const std::string digits = content_hash(name).substr(0, 16);
  std::uint64_t value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  return value % shard.count == shard.index - 1;
}

std::vector<std::string> empty_folders(const std::vector<std::string>& inputs,
                                       const std::string& output, const std::string& pattern) {
  std::vector<std::string> empty;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error)) continue;
    std::vector<BatchItem> items;
    add_folder(input, output, pattern, items);
    if (std::all_of(items.begin(), items.end(), [](const BatchItem& i) { return i.is_copied; }))
      empty.push_back(input);
  }
  return empty;
}

std::vector<BatchItem> find_items(const std::vector<std::string>& inputs, const std::string& output,
                                  const std::string& pattern) {
  std::vector<BatchItem> items;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (fs::is_directory(input, error)) {
      add_folder(input, output, pattern, items);
    } else {
      add_file(input, items);
    }
  }
  ResultPaths results("batch");
  for (const BatchItem& item : items) results.add(item.name, item.input);
  std::sort(items.begin(), items.end(),
            [](const BatchItem& a, const BatchItem& b) { return a.name < b.name; });
  return items;
}

std::vector<std::string> takes_below(const std::vector<std::string>& inputs) {
  std::vector<std::string> takes;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!fs::is_directory(input, error)) {
      takes.push_back(input);
      continue;
    }
    std::vector<BatchItem> items;
    add_folder(input, {}, "", items);
    std::sort(items.begin(), items.end(),
              [](const BatchItem& a, const BatchItem& b) { return a.name < b.name; });
    for (const BatchItem& item : items) {
      if (!item.is_copied) takes.push_back(item.input);
    }
  }
  return takes;
}

std::vector<std::string> listed_inputs(std::string_view text, std::string_view name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw Error(ErrorKind::unreadable_input,
                fmt::format("{}: the list is in UTF-16; save it as UTF-8", name));
  }
  text = without_byte_order_mark(text);
  std::vector<std::string> inputs;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    if (text.substr(0, end).find('\0') != text.npos) {
      throw Error::at_line(name, number,
                           "found a NUL byte; a list is UTF-8 text with one path per line (find "
                           "-print, not -print0)");
    }
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (!line.empty() && line.front() != '#') inputs.emplace_back(line);
  }
  return inputs;
}

}  // namespace kinemend::cli
