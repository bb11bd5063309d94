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

// A folder and all below it.
std::set<std::filesystem::path> folders_below(const std::filesystem::path& folder) {
  std::set<std::filesystem::path> folders{folder};
  if (!std::filesystem::is_directory(folder)) return folders;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.is_directory()) folders.insert(entry.path());
  }
  return folders;
}

// `ebfdrawn` is an EBF of the variant `drawn`.
struct Variant {
  std::string network, variant;
};

std::optional<Variant> variant_of(const std::string& name) {
  for (const std::string network : {"ebf", "bf", "nn"}) {
    if (name.starts_with(network)) return Variant{network, name.substr(network.size())};
  }
  return std::nullopt;
}

struct TrainedNetwork {
  Variant kind;
  StudyNetwork study;
};

// In the quick form the networks of lab/experiments/models stand for `drawn` ones.
std::vector<TrainedNetwork> trained_networks(const Arguments& arguments) {
  std::vector<TrainedNetwork> networks;
  if (arguments.quick) {
    for (const StudyNetwork& network : quick_networks(arguments))
      networks.push_back({{network.network, "drawn"}, network});
    return networks;
  }
  for (const std::filesystem::path& folder : folders_below(arguments.models)) {
    for (const StudyNetwork& network : networks_in(folder)) {
      if (const auto kind = variant_of(network.network)) networks.push_back({*kind, network});
    }
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

// Writes the difference to the EBF of the same variant, hold-out, seed and passes, paired by take.
void write_difference(Table& table, const TrainedNetwork& network, const TakesErrors& own,
                      const TakesErrors& base) {
  if (own.size() < 2) return;
  std::vector<double> differences;
  for (std::size_t i = 0; i < own.size(); ++i) differences.push_back(own[i] - base[i]);
  const PairedDifference pair = paired_difference(differences);
  const auto& [kind, study] = network;
  table.add({kind.network, kind.variant, study.left_out, study.seed, study.passes,
             fmt::format("{}", pair.count), figure(pair.mean), figure(pair.standard_error),
             fmt::format("{}", pair.positive)});
  fmt::print("  {:4} less ebf, {}: {:+.4f} +- {:.4f} deg, ebf better in {} of {}\n", kind.network,
             kind.variant, pair.mean, pair.standard_error, pair.positive, pair.count);
}

void errors_of_networks(const Arguments& arguments, const std::vector<TrainedNetwork>& networks) {
  Table table(arguments, "mall_trained.csv",
              "network,variant,left_out,seed,passes,takes,rms_deg,of_gaussian_58");
  Table pairs(arguments, "mall_trained_pairs.csv",
              "network,variant,left_out,seed,passes,takes,difference_deg,standard_error_deg,"
              "ebf_is_better_in");
  std::map<std::string, std::vector<const TrainedNetwork*>> by_holdout;
  for (const TrainedNetwork& network : networks)
    by_holdout[network.study.left_out].push_back(&network);
  for (const auto& [holdout, own] : by_holdout) {
    const HoldOutErrors errors(arguments, holdout);
    const double gaussian = mean_of(errors.of([](const Take& noisy) {
      return cleaned(noisy, "gaussian", {{"width_s", 0.058}});
    }));
    const auto training_of = [](const TrainedNetwork& network) {
      return network.kind.variant + " " + network.study.seed + " " + network.study.passes;
    };
    std::map<std::string, TakesErrors> of_ebf;  // by training
    std::vector<TakesErrors> all;
    for (const TrainedNetwork* network : own) {
      const auto& [kind, study] = *network;
      const TakesErrors found =
          errors.of([&](const Take& noisy) { return by_network(study.paper, noisy); });
      const double mean = mean_of(found);
      table.add({kind.network, kind.variant, holdout, study.seed, study.passes,
                 fmt::format("{}", found.size()), figure(mean), figure(mean / gaussian)});
      fmt::print(
          "{:4} {:9} without {} seed {}, {} passes: {:.3f} deg, {:.3f} of the 58 ms Gaussian\n",
          kind.network, kind.variant, holdout, study.seed, study.passes, mean, mean / gaussian);
      std::fflush(stdout);
      if (kind.network == "ebf") of_ebf[training_of(*network)] = found;
      all.push_back(found);
    }
    for (std::size_t i = 0; i < own.size(); ++i) {
      const auto base = of_ebf.find(training_of(*own[i]));
      if (own[i]->kind.network != "ebf" && base != of_ebf.end())
        write_difference(pairs, *own[i], all[i], base->second);
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
  for (const std::filesystem::path& folder : folders_below(arguments.models)) {
    for (const std::filesystem::path& path : files_in(folder, ".curve.csv")) {
      const auto study = study_name(path.stem().stem().string());
      const auto kind = study ? variant_of(study->network) : std::nullopt;
      const std::vector<CurvePoint> curve = curve_of(path);
      if (!kind || curve.empty()) continue;
      for (const double passes : {2, 5, 10, 15, 20, 25, 30, 35, 40, 60, 80, 100, 120}) {
        if (passes > curve.back().passes) break;
        table.add({kind->network, kind->variant, study->left_out, study->seed,
                   fmt::format("{:.0f}", curve.back().passes), fmt::format("{:.0f}", passes),
                   fmt::format("{:.4f}", at_passes(curve, passes))});
      }
    }
  }
  table.close();
}

void mall_trained(const Arguments& arguments) {
  const std::vector<TrainedNetwork> networks = trained_networks(arguments);
  if (networks.empty()) return say_no_networks(arguments);
  errors_of_networks(arguments, networks);
  if (!arguments.quick) curves(arguments);
}

const Registration mall_trained_entry("mall_trained", mall_trained);

}  // namespace
}  // namespace kinemend::papers
