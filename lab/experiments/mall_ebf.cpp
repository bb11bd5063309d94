// Mall et al. 2017, figures 6 and 8: EBF, its ablations BF and NN, and forms of EBF, on the takes
// of a hold-out outside their training, beside the paper's two Gaussians, the best constant
// Gaussian for each noise, and the methods of this project. tools/train_paper makes the networks.
#include <cmath>
#include <map>

#include "mall_errors.hpp"
#include "mall_networks.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Noise {
  std::string words;
  std::string damage;
  OptionValues options;
};

// EBD, which outputs poses, is used as a denoiser here, as in the paper's figures 4 and 5.
const std::vector<std::string> network_names{"ebf", "ebf-biased", "ebf-shape", "ebf-spatial",
                                             "bf",  "nn",         "ebd"};
const std::vector<std::string> other_methods{"auto", "example", "wiener"};

std::vector<Noise> noises() {
  std::vector<Noise> all;
  for (const double k : {0.1, 0.5, 0.9})
    all.push_back({fmt::format("angular {}", k), "gaussian-channels", {{"k", k}}});
  for (const double std_cm : {0.1, 0.5, 1.0, 3.0})
    all.push_back({fmt::format("spatial {} cm", std_cm), "position-noise", {{"std_cm", std_cm}}});
  all.push_back({"spatial 0.5 cm, ends",
                 "position-noise",
                 {{"std_cm", 0.5}, {"spread", std::string("ends")}}});
  return all;
}

struct EbfSums {
  double moving = 0, all = 0;
  std::size_t count = 0;
};

using EbfErrors = std::map<std::string, EbfSums>;

class Comparison {
 public:
  explicit Comparison(const Arguments& arguments)
      : arguments_(arguments), takes_(takes_of_hold_outs(arguments, "1")) {
    for (const std::string& name : network_names) {
      if (auto network = paper_network(arguments, name)) networks_.emplace(name, *network);
    }
  }

  void run(Table& table, const Noise& noise) {
    const std::uint64_t draws = arguments_.quick ? 1 : 2;
    std::map<std::string, EbfErrors> groups;
    for (std::size_t i = 0; i < takes_.size(); ++i) {
      const TakeErrors errors(take_of(arguments_, takes_[i]));
      for (std::uint64_t draw = 0; draw < draws; ++draw)
        measure(errors, damaged(errors.truth(), noise.damage, noise.options, 100 * draw + i),
                groups);
    }
    for (auto& [group, errors] : groups) write(table, noise, group, errors);
  }

 private:
  // The group "plain" excludes joints that turn over.
  void measure(const TakeErrors& errors, const Take& clip,
               std::map<std::string, EbfErrors>& groups) const {
    const auto add = [&](const std::string& method, const Take& result) {
      for (const bool plain : {true, false}) {
        EbfSums& sums = groups[plain ? "plain" : "all joints"][method];
        const double error = errors.mean(result, plain);
        sums.moving += error;
        sums.all += error * std::sqrt(errors.share_that_moves(plain));
        ++sums.count;
      }
    };
    add("noisy", clip);
    for (const double width_s : {0.004, 0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045, 0.058})
      add(fmt::format("constant {}", width_s), cleaned(clip, "gaussian", {{"width_s", width_s}}));
    add("gaussian 58 ms", cleaned(clip, "gaussian", {{"width_s", 0.058}}));
    add("gaussian 125 ms", cleaned(clip, "gaussian", {{"width_s", 0.125}}));
    for (const auto& [name, network] : networks_) add(name, by_network(network, clip));
    for (const std::string& method : other_methods) add(method, cleaned(clip, method));
  }

  // Only the best of the constant Gaussians is listed.
  static void write(Table& table, const Noise& noise, const std::string& group, EbfErrors& errors) {
    EbfSums best;
    for (const auto& [method, sums] : errors) {
      if (method.rfind("constant", 0) == 0 && (best.count == 0 || sums.moving < best.moving))
        best = sums;
    }
    std::erase_if(errors, [](const auto& entry) { return entry.first.rfind("constant", 0) == 0; });
    errors["best constant gaussian"] = best;
    const double gaussian = errors.at("gaussian 58 ms").moving;
    for (const auto& [method, sums] : errors) {
      const auto count = static_cast<double>(sums.count);
      table.add({quoted(noise.words), group, method, fmt::format("{}", sums.count),
                 figure(sums.moving / count), figure(sums.all / count),
                 figure(sums.moving / gaussian)});
      fmt::print("{:22} {:8} {:24} {:.3f} deg, all channels {:.3f}, {:.3f} of the 58 ms Gaussian\n",
                 noise.words, group, method, sums.moving / count, sums.all / count,
                 sums.moving / gaussian);
    }
  }

  const Arguments& arguments_;
  std::vector<HeldOut> takes_;
  std::map<std::string, PaperNetwork> networks_;
};

void mall_ebf(const Arguments& arguments) {
  Comparison comparison(arguments);
  Table table(arguments, "mall_ebf.csv",
              "noise,group,method,clips,rms_deg,all_channels_deg,of_gaussian_58");
  for (const Noise& noise : noises()) {
    if (!arguments.quick || noise.words == "angular 0.5" || noise.words == "spatial 0.5 cm")
      comparison.run(table, noise);
  }
  table.close();
}

const Registration mall_ebf_entry("mall_ebf", mall_ebf);

}  // namespace
}  // namespace kinemend::papers
