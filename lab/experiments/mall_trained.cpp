// Mall et al. 2017: EBF, BF and NN trained until their error on takes left out no longer falls, as
// in the paper and with one thing changed at a time. --models names the folder of the networks and
// curves of `tools/train_study DATA ebfdrawn:1:1 ebfplain:1:1 ...`.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mall_errors.hpp"
#include "mall_networks.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

// NETWORK-LEFT_OUT-SEED: `ebfdrawn-1-1` is an EBF of the variant `drawn`.
struct TrainedName {
  std::string network, variant, left_out, seed, passes;
};

std::optional<TrainedName> trained_name(const std::string& stem) {
  const std::size_t first = stem.find('-'), last = stem.rfind('-');
  if (first == std::string::npos || first == last) return std::nullopt;
  const std::string whole = stem.substr(0, first);
  for (const char* network : {"ebf", "bf", "nn"}) {
    if (!whole.starts_with(network)) continue;
    return TrainedName{network, whole.substr(std::string(network).size()),
                       stem.substr(first + 1, last - first - 1), stem.substr(last + 1), ""};
  }
  return std::nullopt;
}

struct TrainedNetwork {
  TrainedName name;
  PaperNetwork paper;
};

std::set<std::filesystem::path> files_below(const std::filesystem::path& folder,
                                            const std::string& ending) {
  std::set<std::filesystem::path> paths;
  if (!std::filesystem::is_directory(folder)) return paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().string().ends_with(ending)) paths.insert(entry.path());
  }
  return paths;
}

// The networks whose training is done; in the quick form those of lab/experiments/models.
std::vector<TrainedNetwork> trained_networks(const Arguments& arguments) {
  std::vector<TrainedNetwork> networks;
  if (arguments.quick) {
    for (const char* name : {"ebf", "bf", "nn"}) {
      if (auto network = paper_network(arguments, name))
        networks.push_back({{name, "drawn", "1", "1", ""}, *network});
    }
    return networks;
  }
  for (const std::filesystem::path& path : files_below(arguments.models, ".kmodel")) {
    auto name = trained_name(path.stem().string());
    std::filesystem::path checkpoint = path;
    if (!name || std::filesystem::exists(checkpoint.replace_extension("checkpoint"))) continue;
    const Model model = read_model(path);
    // The card says `tools/train_study DATA NETWORK --passes N`.
    name->passes = model.card.command.substr(model.card.command.rfind(' ') + 1);
    networks.push_back({*name, {model.layout, filter_network_of(model)}});
  }
  return networks;
}

// The error of each take of a hold-out, the mean over draws of noise of k = 0.5, degrees, without
// the joints that turn over.
using TakesErrors = std::vector<double>;

double mean_of(const TakesErrors& errors) {
  double sum = 0;
  for (const double error : errors) sum += error;
  return sum / static_cast<double>(errors.size());
}

class HoldOutErrors {
 public:
  HoldOutErrors(const Arguments& arguments, const std::string& holdout)
      : draws_(arguments.quick ? 1 : 5) {
    const std::vector<HeldOut> takes = takes_of_hold_outs(arguments, holdout);
    for (std::size_t i = 0; i < takes.size(); ++i) {
      takes_.emplace_back(take_of(arguments, takes[i]));
      for (std::uint64_t draw = 0; draw < draws_; ++draw)
        noisy_.push_back(
            damaged(takes_.back().truth(), "gaussian-channels", {{"k", 0.5}}, 100 * draw + i));
    }
  }

  template <class Filter>
  TakesErrors of(const Filter& filter) const {
    TakesErrors errors(takes_.size());
    for (std::size_t i = 0; i < noisy_.size(); ++i)
      errors[i / draws_] +=
          takes_[i / draws_].mean(filter(noisy_[i]), true) / static_cast<double>(draws_);
    return errors;
  }

 private:
  std::size_t draws_;
  std::vector<TakeErrors> takes_;
  std::vector<Take> noisy_;  // takes x draws
};

// Writes the difference to the EBF of the same variant, hold-out and seed, paired by take.
void write_difference(Table& table, const TrainedName& name, const TakesErrors& own,
                      const TakesErrors& base) {
  const auto count = static_cast<double>(own.size());
  double mean = 0, square = 0, better = 0;
  for (std::size_t i = 0; i < own.size(); ++i) mean += (own[i] - base[i]) / count;
  for (std::size_t i = 0; i < own.size(); ++i) {
    square += std::pow(own[i] - base[i] - mean, 2);
    better += own[i] > base[i] ? 1 : 0;
  }
  const double error = std::sqrt(square / std::max(1.0, count - 1) / count);
  table.add({name.network, name.variant, name.left_out, name.seed, name.passes,
             fmt::format("{:.0f}", count), figure(mean), figure(error),
             fmt::format("{:.0f}", better)});
  fmt::print("  {:4} less ebf, {}: {:+.4f} +- {:.4f} deg, ebf better in {:.0f} of {:.0f}\n",
             name.network, name.variant, mean, error, better, count);
}

void errors_of_networks(const Arguments& arguments, const std::vector<TrainedNetwork>& networks) {
  Table table(arguments, "mall_trained.csv",
              "network,variant,left_out,seed,passes,takes,rms_deg,of_gaussian_58");
  Table pairs(arguments, "mall_trained_pairs.csv",
              "network,variant,left_out,seed,passes,takes,difference_deg,standard_error_deg,"
              "ebf_is_better_in");
  std::map<std::string, std::vector<const TrainedNetwork*>> by_holdout;
  for (const TrainedNetwork& network : networks)
    by_holdout[network.name.left_out].push_back(&network);
  for (const auto& [holdout, own] : by_holdout) {
    const HoldOutErrors errors(arguments, holdout);
    const double gaussian = mean_of(errors.of([](const Take& noisy) {
      return cleaned(noisy, "gaussian", {{"width_s", 0.058}});
    }));
    std::map<std::string, TakesErrors> bases;  // those of EBF by variant, seed and passes
    std::vector<std::pair<TrainedName, TakesErrors>> all;
    for (const TrainedNetwork* network : own) {
      const TakesErrors found =
          errors.of([&](const Take& noisy) { return by_network(network->paper, noisy); });
      const TrainedName& name = network->name;
      table.add({name.network, name.variant, holdout, name.seed, name.passes,
                 fmt::format("{}", found.size()), figure(mean_of(found)),
                 figure(mean_of(found) / gaussian)});
      fmt::print(
          "{:4} {:9} without {} seed {}, {} passes: {:.3f} deg, {:.3f} of the 58 ms Gaussian\n",
          name.network, name.variant, holdout, name.seed, name.passes, mean_of(found),
          mean_of(found) / gaussian);
      std::fflush(stdout);
      if (name.network == "ebf") bases[name.variant + name.seed + name.passes] = found;
      all.emplace_back(name, found);
    }
    for (const auto& [name, found] : all) {
      const auto base = bases.find(name.variant + name.seed + name.passes);
      if (name.network != "ebf" && base != bases.end())
        write_difference(pairs, name, found, base->second);
    }
  }
  table.close();
  pairs.close();
}

struct CurvePoint {
  double passes, kept;
};

// The curve that tools/train_study wrote, a point for about every two passes.
std::vector<CurvePoint> curve_of(const std::filesystem::path& path) {
  std::vector<CurvePoint> curve;
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line))
    curve.push_back({std::stod(line), std::stod(line.substr(line.rfind(',') + 1))});
  return curve;
}

// Between two points of a curve, by a straight line.
double at_passes(const std::vector<CurvePoint>& curve, double passes) {
  const auto next =
      std::ranges::find_if(curve, [&](const CurvePoint& point) { return point.passes >= passes; });
  if (next == curve.begin()) return next->kept;
  const CurvePoint before = *(next - 1);
  const double share = (passes - before.passes) / (next->passes - before.passes);
  return before.kept + share * (next->kept - before.kept);
}

// Writes how much of the error of the takes left out remains after so many passes, as a share of
// that of the 58 ms Gaussian; `of` is how many passes the training had.
void curves(const Arguments& arguments) {
  Table table(arguments, "mall_curve.csv", "network,variant,left_out,seed,of,passes,kept_takes");
  for (const std::filesystem::path& path : files_below(arguments.models, ".curve.csv")) {
    const auto name = trained_name(path.stem().stem().string());
    const std::vector<CurvePoint> curve = curve_of(path);
    if (!name || curve.empty()) continue;
    for (const double passes : {2, 5, 10, 15, 20, 25, 30, 35, 40, 60, 80, 100, 120}) {
      if (passes > curve.back().passes) break;
      table.add({name->network, name->variant, name->left_out, name->seed,
                 fmt::format("{:.0f}", curve.back().passes), fmt::format("{:.0f}", passes),
                 fmt::format("{:.4f}", at_passes(curve, passes))});
    }
  }
  table.close();
}

void mall_trained(const Arguments& arguments) {
  const std::vector<TrainedNetwork> networks = trained_networks(arguments);
  if (networks.empty()) {
    fmt::print(
        "skipped: no networks in {}; tools/train_study DATA trains them, --models names their "
        "folder\n",
        arguments.models.string());
    return;
  }
  errors_of_networks(arguments, networks);
  if (!arguments.quick) curves(arguments);
}

const Registration mall_trained_entry("mall_trained", mall_trained);

}  // namespace
}  // namespace kinemend::papers
