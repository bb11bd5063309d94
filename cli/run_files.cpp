// Identifies files by device and number, follows symlinks, and compares every output with every
// other file.
#include "run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <unordered_map>

#include "kinemend/error.hpp"
#include "kinemend/extend/text.hpp"
#include "platform/system.hpp"

namespace kinemend::cli {

namespace {

namespace fs = std::filesystem;

// The path behind symlinks. The standard library does not follow a symlink whose target does not
// exist yet, although an output is written there.
fs::path followed(fs::path path) {
  constexpr int most_links = 40;  // as in the kernel; more are a cycle
  std::error_code error;
  for (int i = 0; i < most_links && fs::is_symlink(path, error); ++i) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;
  }
  return path;
}

// The unique identity of a file: device and file number, or the path of a new file. Empty for
// streams, devices and pipes, which cannot be lost.
std::string identity_of(const std::string& path) {
  if (path.empty() || path == "-") return "";
  if (const auto identity = platform::file_identity(path)) return *identity;
  std::error_code error;
  const fs::path absolute = followed(fs::absolute(path, error));
  const fs::path canonical = fs::weakly_canonical(absolute, error);
  return "path:" + (error ? absolute.lexically_normal() : canonical).string();
}

[[noreturn]] void refuse(const std::string& option, const std::string& path,
                         const std::string& what) {
  throw Error(ErrorKind::usage, fmt::format("{}: {} is {} and would be lost; name another file",
                                            option, printable(path), what));
}

}  // namespace

void ResultPaths::add(const std::string& result, const std::string& input) {
  const auto [known, is_new] = inputs_.emplace(result, input);
  if (is_new) return;
  throw Error(ErrorKind::usage, fmt::format("{}: {} and {} would both be written to {}", command_,
                                            known->second, input, result));
}

bool is_same_file(const std::string& a, const std::string& b) {
  const std::string identity = identity_of(a);
  return !identity.empty() && identity == identity_of(b);
}

RunFiles& RunFiles::reads(std::string option, std::string path) {
  if (!path.empty()) inputs_.push_back({std::move(option), std::move(path)});
  return *this;
}

RunFiles& RunFiles::reads(const std::string& option, const std::vector<std::string>& paths) {
  for (const std::string& path : paths) reads(option, path);
  return *this;
}

RunFiles& RunFiles::writes(std::string option, std::string path, std::string replaces) {
  if (!path.empty()) outputs_.push_back({std::move(option), std::move(path), std::move(replaces)});
  return *this;
}

RunFiles& RunFiles::would_write(std::string option, std::string path) {
  if (path.empty()) return *this;
  outputs_.push_back({std::move(option), std::move(path)});
  outputs_.back().is_written = false;
  return *this;
}

void RunFiles::check(bool json_to_out) const {
  check_streams(json_to_out);
  std::unordered_multimap<std::string, const File*> inputs;
  for (const File& input : inputs_) inputs.emplace(identity_of(input.path), &input);
  std::unordered_map<std::string, const File*> outputs;
  for (const File& output : outputs_) {
    const std::string identity = identity_of(output.path);
    if (identity.empty()) continue;
    if (output.is_written) {
      const auto [first, last] = inputs.equal_range(identity);
      for (auto input = first; input != last; ++input) refuse_input(output, *input->second);
    }
    const auto [found, is_new] = outputs.emplace(identity, &output);
    if (is_new) continue;
    // The file named later is usually beside the take: a report, a plan, a card.
    const bool is_other = output.is_written;
    const File &lost = is_other ? *found->second : output,
               &kept = is_other ? output : *found->second;
    if (kept.is_written) refuse(kept.option, kept.path, "also written by " + lost.option);
  }
}

void RunFiles::check_streams(bool json_to_out) const {
  const auto is_stream = [](const File& file) { return file.path == "-"; };
  if (std::count_if(inputs_.begin(), inputs_.end(), is_stream) > 1)
    throw Error(ErrorKind::usage, "standard input can be read only once");
  const auto is_written_stream = [](const File& file) {
    return file.path == "-" && file.is_written;
  };
  if (std::count_if(outputs_.begin(), outputs_.end(), is_written_stream) + (json_to_out ? 1 : 0) >
      1) {
    throw Error(ErrorKind::usage,
                "standard output holds one thing: a take, a report or --json, not several");
  }
}

void RunFiles::refuse_input(const File& output, const File& input) {
  const bool may_replace = !output.replaces.empty() && input.path == output.replaces;
  if (!may_replace)
    refuse(output.option, output.path, "also read by this run (" + input.option + ")");
}

}  // namespace kinemend::cli
