// Hold-outs and trained networks for the experiments of Mall et al. 2017.
#pragma once

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiment.hpp"
#include "kinemend/extend/body.hpp"
#include "kinemend/extend/model.hpp"
#include "papers/mall2017_recurrent/filter_network.hpp"

namespace kinemend::papers {

struct HeldOut {
  std::string name, action;
  int holdout = 0;  ///< 1 to 5
};

/// The hold-outs of cmu/recurrent-100.csv; none without data.
inline std::vector<HeldOut> hold_outs_of(const Arguments& arguments) {
  std::vector<HeldOut> takes;
  std::ifstream list(arguments.data / "cmu" / "recurrent-100.csv");
  for (std::string line; std::getline(list, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || line.back() < '1' || line.back() > '5') continue;
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    takes.push_back(
        {line.substr(0, first), line.substr(first + 1, second - first - 1), line.back() - '0'});
  }
  return takes;
}

/// A trained network with the body it was trained on.
struct PaperNetwork {
  BodyLayout layout;
  FilterNetwork network;
};

/// `<models>/<name>.kmodel`, written by `tools/train_paper`; without that file, `ebf` is the
/// shipped model.
inline std::optional<PaperNetwork> paper_network(const Arguments& arguments,
                                                 const std::string& name) {
  const std::filesystem::path path = arguments.models / (name + ".kmodel");
  const bool is_file = std::filesystem::is_regular_file(path);
  if (!is_file && name != "ebf") return std::nullopt;
  const Model model = is_file ? read_model(path) : *shipped_model("recurrent");
  return PaperNetwork{model.layout, filter_network_of(model)};
}

/// A network of `tools/train_study`, NETWORK-LEFT_OUT-SEED.kmodel.
struct StudyNetwork {
  std::string network, left_out, seed;
  std::string passes;  ///< of its training, from its card; empty if that does not say it
  PaperNetwork paper;
};

/// The parts of the name; nullopt for other files.
inline std::optional<StudyNetwork> study_name(const std::string& stem) {
  const std::size_t first = stem.find('-'), last = stem.rfind('-');
  if (first == std::string::npos || first == last) return std::nullopt;
  return StudyNetwork{stem.substr(0, first),
                      stem.substr(first + 1, last - first - 1),
                      stem.substr(last + 1),
                      {},
                      {}};
}

/// The files of a folder with that ending, in order.
inline std::set<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                                std::string_view ending) {
  std::set<std::filesystem::path> paths;
  if (!std::filesystem::is_directory(folder)) return paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().string().ends_with(ending)) paths.insert(entry.path());
  }
  return paths;
}

/// The networks of a folder whose training is done.
inline std::vector<StudyNetwork> networks_in(const std::filesystem::path& folder) {
  std::vector<StudyNetwork> networks;
  for (const std::filesystem::path& path : files_in(folder, ".kmodel")) {
    std::optional<StudyNetwork> network = study_name(path.stem().string());
    std::filesystem::path checkpoint = path;
    if (!network || std::filesystem::exists(checkpoint.replace_extension("checkpoint"))) continue;
    const Model model = read_model(path);
    // The card says `tools/train_study DATA NETWORK --passes N`.
    const std::string& command = model.card.command;
    if (command.find("--passes ") != std::string::npos)
      network->passes = command.substr(command.rfind(' ') + 1);
    network->paper = {model.layout, filter_network_of(model)};
    networks.push_back(std::move(*network));
  }
  return networks;
}

/// For the quick form: those of lab/experiments/models, as if they were of hold-out 1.
inline std::vector<StudyNetwork> quick_networks(const Arguments& arguments) {
  std::vector<StudyNetwork> networks;
  for (const char* name : {"ebf", "bf", "nn"}) {
    if (auto network = paper_network(arguments, name))
      networks.push_back({name, "1", "1", "", *network});
  }
  return networks;
}

inline void say_no_networks(const Arguments& arguments) {
  fmt::print(
      "skipped: no networks in {}; tools/train_study DATA trains them, --models names their "
      "folder\n",
      arguments.models.string());
}

/// Differences of one method's errors to another's on the same takes.
struct PairedDifference {
  std::size_t count = 0;
  double mean = 0, standard_error = 0;
  std::size_t positive = 0;  ///< how often the other method is better
};

/// `differences`: two or more.
inline PairedDifference paired_difference(std::span<const double> differences) {
  PairedDifference pair{differences.size()};
  const auto count = static_cast<double>(pair.count);
  double square = 0;
  for (const double difference : differences) {
    pair.mean += difference / count;
    pair.positive += difference > 0 ? 1 : 0;
  }
  for (const double difference : differences) square += std::pow(difference - pair.mean, 2);
  pair.standard_error = std::sqrt(square / (count - 1) / count);
  return pair;
}

/// Applies a network to a take at its rate; the root is unchanged.
inline Take by_network(const PaperNetwork& paper, const Take& clip) {
  const BodyMatch match = match_body(paper.layout, clip);
  BodyChannels channels = encode_body(clip, paper.layout, match);
  put_filtered(filtered(paper.network, filter_take_of(channels, paper.layout)), channels.poses);
  std::vector<std::uint8_t> chosen(paper.layout.track_count() + 1, 1);
  chosen.front() = chosen.back() = 0;
  Take result = clip;
  decode_body(channels, paper.layout, match, result, chosen);
  return result;
}

/// The take of a hold-out, or a synthetic one without data.
inline Take take_of(const Arguments& arguments, const HeldOut& take) {
  return load_take(arguments, take.name + ".bvh", {.motion = take.name, .duration_s = 2}).clip;
}

/// The takes of some hold-outs ("12345"); in the quick form and without data, two synthetic ones.
inline std::vector<HeldOut> takes_of_hold_outs(const Arguments& arguments,
                                               std::string_view holdouts) {
  std::vector<HeldOut> takes;
  if (arguments.quick || arguments.data.empty()) return {{"walk", "walk", 1}, {"run", "run", 1}};
  for (const HeldOut& take : hold_outs_of(arguments)) {
    if (holdouts.find(static_cast<char>('0' + take.holdout)) != std::string_view::npos)
      takes.push_back(take);
  }
  return takes;
}

}  // namespace kinemend::papers
