// Arguments, takes and tables shared by the programs that repeat a paper's experiments.
#pragma once

#include <fmt/core.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "kinemend/error.hpp"
#include "kinemend/feet.hpp"
#include "kinemend/io.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"

namespace kinemend::papers {

struct Arguments {
  std::filesystem::path data;          ///< folder of real takes; empty: uses synthetic takes
  std::filesystem::path output = ".";  ///< folder for CSV files
  std::filesystem::path models = "lab/experiments/models";  ///< networks for a paper's tables
  bool quick = false;                                       ///< short takes and coarse grids
};

/// --data FOLDER (default: the environment variable KINEMEND_DATA), --output FOLDER,
/// --models FOLDER (default: that of the source tree, from its root), --quick.
inline Arguments parse_arguments(const std::vector<std::string>& words) {
  Arguments arguments;
  if (const char* data = std::getenv("KINEMEND_DATA")) arguments.data = data;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& name = words[i];
    if (name == "--quick") {
      arguments.quick = true;
    } else if (name == "--data" && i + 1 < words.size()) {
      arguments.data = words[++i];
    } else if (name == "--output" && i + 1 < words.size()) {
      arguments.output = words[++i];
    } else if (name == "--models" && i + 1 < words.size()) {
      arguments.models = words[++i];
    } else {
      throw Error(ErrorKind::usage,
                  "unknown argument " + name +
                      " (--data FOLDER, --output FOLDER, --models FOLDER, --quick)");
    }
  }
  std::filesystem::create_directories(arguments.output);
  return arguments;
}

/// Finds a file by name anywhere below the folder.
inline std::optional<std::filesystem::path> find_take(const std::filesystem::path& folder,
                                                      const std::string& name) {
  if (folder.empty() || !std::filesystem::is_directory(folder)) return std::nullopt;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().filename() == name) return entry.path();
  }
  return std::nullopt;
}

struct NamedTake {
  std::string name;
  Take clip;
};

/// The real take without its calibration frames, or a synthetic one if it does not exist.
inline NamedTake load_take(const Arguments& arguments, const std::string& file,
                           const SynthOptions& otherwise) {
  if (const auto path = find_take(arguments.data, file)) {
    const Take clip = read_joints(*path).take;
    return {"CMU " + path->stem().string(),
            slice(clip, leading_calibration_frames(clip), clip.frame_count())};
  }
  return {"synthetic " + otherwise.motion, synthesize(otherwise)};
}

/// The contacts of a clean take by thresholds, which are the truth of tables.
inline std::vector<FootContact> true_contacts(const Take& truth) {
  ContactSettings settings;
  settings.finder = ContactFinder::thresholds;
  return find_contacts(truth, settings);
}

/// Every step-th frame of a part of the clip.
inline Take thinned(const Take& clip, std::size_t first, std::size_t step, std::size_t frames) {
  const std::size_t have = clip.frame_count() > first ? (clip.frame_count() - first) / step : 0;
  Take result = slice(clip, first, first + std::min(frames, have));
  for (std::size_t f = 0; f < result.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      result.rotation(f, j) = clip.rotation(first + f * step, j);
    }
    result.root_position(f) = clip.root_position(first + f * step);
  }
  result.frame_rate_hz = clip.frame_rate_hz / static_cast<double>(step);
  return result;
}

/// A cell of a table that may hold commas.
inline std::string quoted(const std::string& text) { return '"' + text + '"'; }

/// A table of comma-separated values in the output folder.
class Table {
 public:
  Table(const Arguments& arguments, const std::string& name, const std::string& header)
      : path_(arguments.output / name), file_(path_) {
    file_ << header << '\n';
  }
  void add(const std::vector<std::string>& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) file_ << (i ? "," : "") << cells[i];
    file_ << '\n';
  }
  void close() {
    file_.close();
    if (!file_) throw Error(ErrorKind::cannot_write, path_.string() + ": cannot write");
    fmt::print("wrote {}\n", path_.string());
  }

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

/// An experiment of the program `kinemend_papers`, with the name that runs it.
struct Experiment {
  std::string name;
  void (*run)(const Arguments&);
};

/// All experiments in the program, in no particular order.
inline std::vector<Experiment>& experiments() {
  static std::vector<Experiment> all;
  return all;
}

/// Registers an experiment; each file ends with one constant of this type.
struct Registration {
  Registration(const char* name, void (*run)(const Arguments&)) {
    experiments().push_back({name, run});
  }
};

}  // namespace kinemend::papers
