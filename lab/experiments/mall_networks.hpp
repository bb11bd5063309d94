// Hold-outs and trained networks for the experiments of Mall et al. 2017.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
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
