// Looks for the skeleton's file by the likely names, then by the subject of the take.
#include "io/acclaim/amc_skeleton_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>
#include <vector>

#include "io/text/text.hpp"
#include "kinemend/error.hpp"

namespace kinemend {

namespace {

namespace fs = std::filesystem;

bool is_asf(const fs::path& path) { return equal_ignoring_case(path.extension().string(), ".asf"); }

// Returns the part before the number of the take: 35 for 35_01.
std::string subject_of(const std::string& stem) { return stem.substr(0, stem.find('_')); }

// Returns file names, the most likely first. A path inside the file is from the machine that wrote
// it, so only its last part is used.
std::vector<std::string> likely_names(const std::string& stem, std::string_view named_inside) {
  std::vector<std::string> names;
  const auto add = [&](std::string name) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  };
  const std::string_view inside = named_inside.substr(named_inside.find_last_of("\\/") + 1);
  if (is_asf(fs::path(inside))) add(std::string(inside));
  add(stem + ".asf");
  if (!subject_of(stem).empty()) add(subject_of(stem) + ".asf");
  return names;
}

// Whether a file belongs to a subject, as 35-walk.asf belongs to 35.
bool names_subject(const fs::path& file, const std::string& subject) {
  const std::string stem = file.stem().string();
  if (subject.empty() || stem.size() <= subject.size()) return false;
  const auto next = static_cast<unsigned char>(stem[subject.size()]);
  return equal_ignoring_case(stem.substr(0, subject.size()), subject) && std::isalnum(next) == 0;
}

std::vector<fs::path> asf_files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_asf(entry->path())) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

fs::path find_skeleton_file(std::string_view amc_name, std::string_view named_inside,
                            const ReadOptions& options) {
  if (!options.skeleton.empty()) return options.skeleton;
  const fs::path parent = fs::path(amc_name).parent_path();
  const fs::path folder = parent.empty() ? fs::path(".") : parent;
  const std::string stem = fs::path(amc_name).stem().string();
  const std::vector<std::string> names = likely_names(stem, named_inside);
  const std::vector<fs::path> files = asf_files_in(folder);
  for (const std::string& name : names) {
    const auto same = [&](const fs::path& file) {
      return equal_ignoring_case(file.filename().string(), name);
    };
    const auto found = std::find_if(files.begin(), files.end(), same);
    if (found != files.end()) return parent / found->filename();
  }
  std::vector<fs::path> of_subject;
  for (const fs::path& file : files) {
    if (names_subject(file, subject_of(stem))) of_subject.push_back(file);
  }
  if (of_subject.size() == 1) return parent / of_subject[0].filename();
  if (files.size() == 1) return parent / files[0].filename();
  throw Error(
      ErrorKind::unreadable_input,
      fmt::format(
          "{}: an AMC file needs its skeleton: its folder has no {}, and {}; name one "
          "with --asf",
          amc_name, fmt::join(names, ", "),
          files.empty() ? "no other ASF file" : fmt::format("{} other ASF files", files.size())));
}

fs::path skeleton_place(const fs::path& output, std::string_view named_inside,
                        std::string_view asf_bytes, const std::string& usual_name) {
  const fs::path parent = output.parent_path();
  const std::string stem = output.stem().string();
  // Lists the files before reading them, because a take written meanwhile may add this skeleton.
  const std::vector<fs::path> files = asf_files_in(parent.empty() ? fs::path(".") : parent);
  const auto holds_it = [&](const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    return !error && size == asf_bytes.size() && read_file(path) == asf_bytes;
  };
  try {
    if (holds_it(find_skeleton_file(output.string(), named_inside, {}))) return {};
  } catch (const Error&) {
    // The file does not exist yet.
  }
  const auto is_there = [&](const std::string& name) {
    return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
      return equal_ignoring_case(file.filename().string(), name);
    });
  };
  // A reader uses the first likely name that exists. Names before it are free and would be found
  // first.
  const std::vector<std::string> names = likely_names(stem, named_inside);
  const auto taken = std::find_if(names.begin(), names.end(), is_there);
  for (const std::string& wanted : {usual_name, stem + ".asf"}) {
    const auto found = std::find_if(names.begin(), taken, [&](const std::string& name) {
      return equal_ignoring_case(name, wanted);
    });
    if (found != taken) return parent / *found;
  }
  return parent / *taken;
}

}  // namespace kinemend
