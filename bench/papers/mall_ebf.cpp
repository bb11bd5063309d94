// Mall et al. 2017, figures 4, 5, 6 and 8: EBF, its ablations BF and NN, and forms of EBF, on the
// takes of a hold-out that they have not seen, beside the paper's two Gaussians, the best constant
// Gaussian of each noise, and the methods of this project. The networks are made by
// tools/train_paper.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mall_networks.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Noise {
  std::string words;
  std::string damage;
  OptionValues options;
};

const std::vector<std::string> network_names{"ebf",         "ebf-biased", "ebf-shape",
                                             "ebf-spatial", "bf",         "nn"};
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

// Euler channels of the joints, in degrees, each continued from frame to frame.
std::vector<std::vector<double>> euler_channels(const Clip& clip) {
  std::vector<std::vector<double>> channels;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    const RotationOrder order = clip.skeleton.rotation_order(j);
    if (clip.skeleton.parents[j] < 0 || order.count == 0) continue;
    std::array<std::vector<double>, 3> own;
    std::array<double, 3> angles{};
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      angles = to_euler_near(clip.rotation(f, j), order, angles);
      for (std::size_t c = 0; c < order.count; ++c)
        own[c].push_back(degrees_per_radian * angles[c]);
    }
    for (std::size_t c = 0; c < order.count; ++c) channels.push_back(std::move(own[c]));
  }
  return channels;
}

// What the set of a take is, and by how much its error over all channels is smaller than over those
// that move: the others have none.
struct Facts {
  bool turns_several_times = false;
  double share_that_moves = 1;
};

Facts facts_of(const Clip& clip) {
  constexpr double several_turns_deg = 540, moving_deg = 1e-3;
  Facts facts;
  double moving = 0, all = 0;
  for (const std::vector<double>& channel : euler_channels(clip)) {
    const auto [least, most] = std::minmax_element(channel.begin(), channel.end());
    facts.turns_several_times = facts.turns_several_times || *most - *least > several_turns_deg;
    moving += *most - *least > moving_deg ? 1 : 0;
    ++all;
  }
  facts.share_that_moves = moving / all;
  return facts;
}

struct Sums {
  double moving = 0, all = 0;
  std::size_t count = 0;
};

using Errors = std::map<std::string, Sums>;

class Comparison {
 public:
  Comparison(const Arguments& arguments, int holdout) : arguments_(arguments) {
    for (const HeldOut& take : hold_outs_of(arguments)) {
      if (take.holdout == holdout) takes_.push_back(take);
    }
    for (const std::string& name : network_names) {
      if (auto network = paper_network(arguments, name)) networks_.emplace(name, *network);
    }
  }
  bool is_possible() const { return !takes_.empty(); }

  void run(Table& table, const Noise& noise) {
    constexpr std::uint64_t draws = 2;
    std::map<std::string, Errors> groups;
    for (std::size_t i = 0; i < takes_.size(); ++i) {
      const Clip truth = load_take(arguments_, takes_[i].name + ".bvh", {}).clip;
      const Facts facts = facts_of(truth);
      for (std::uint64_t draw = 0; draw < draws; ++draw) {
        const Clip clip = damaged(truth, noise.damage, noise.options, 100 * draw + i);
        measure(truth, facts, clip, groups[facts.turns_several_times ? "turning" : "plain"]);
      }
    }
    for (auto& [group, errors] : groups) write(table, noise, group, errors);
  }

 private:
  void measure(const Clip& truth, const Facts& facts, const Clip& clip, Errors& errors) const {
    const auto add = [&](const std::string& method, const Clip& result) {
      Sums& sums = errors[method];
      const double error = rms_deg(truth, result);
      sums.moving += error;
      sums.all += error * std::sqrt(facts.share_that_moves);
      ++sums.count;
    };
    add("noisy", clip);
    for (const double width_s : {0.004, 0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045, 0.058})
      add(fmt::format("constant {}", width_s), cleaned(clip, "gaussian", {{"width_s", width_s}}));
    add("gaussian 58 ms", cleaned(clip, "gaussian", {{"width_s", 0.058}}));
    add("gaussian 125 ms", cleaned(clip, "gaussian", {{"width_s", 0.125}}));
    for (const auto& [name, network] : networks_) add(name, by_network(network, clip));
    for (const std::string& method : other_methods) add(method, cleaned(clip, method));
  }

  // Of the constant Gaussians the best stands for all.
  static void write(Table& table, const Noise& noise, const std::string& group, Errors& errors) {
    Sums best;
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

void experiment(const Arguments& arguments) {
  Comparison comparison(arguments, 1);
  if (arguments.quick || !comparison.is_possible()) {
    fmt::print("skipped: real takes are wanted\n");
    return;
  }
  Table table(arguments, "mall_ebf.csv",
              "noise,group,method,clips,rms_deg,all_channels_deg,of_gaussian_58");
  for (const Noise& noise : noises()) comparison.run(table, noise);
  table.close();
}

const Registration registration("mall_ebf", experiment);

}  // namespace
}  // namespace kinemend::papers
