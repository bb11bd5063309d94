// Mall et al. 2017, figures 5 and 6: noise in proportion to the deviation of each channel on the
// hold-outs of cmu/recurrent-100.csv, with the paper's two Gaussians, the best constant Gaussian,
// and methods of this project; then other kinds of noise, and clean takes. The paper's networks are
// left out, because they were trained on all hold-outs but the first (mall_ebf.cpp).
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "kinemend/extend/figures.hpp"
#include "page.hpp"
#include "quality/lower_rate.hpp"

namespace kinemend::papers {
namespace {

struct NoisyHoldOut {
  std::string name, action;
};

// The hold-outs of all five draws.
std::vector<NoisyHoldOut> hold_outs(const Arguments& arguments) {
  std::vector<NoisyHoldOut> takes;
  std::ifstream list(arguments.data / "cmu" / "recurrent-100.csv");
  for (std::string line; std::getline(list, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool held_out = !line.empty() && line.back() >= '1' && line.back() <= '5';
    if (!held_out) continue;
    const std::size_t first = line.find(','), second = line.find(',', first + 1);
    takes.push_back({line.substr(0, first), line.substr(first + 1, second - first - 1)});
  }
  if (takes.empty()) takes = {{"walk", "walk"}, {"run", "run"}};
  return takes;
}

Take clip_of(const Arguments& arguments, const std::string& name) {
  const Take clip = load_take(arguments, name + ".bvh", {.motion = name, .duration_s = 3}).clip;
  if (!arguments.quick) return clip;
  return slice(clip, 0, std::min<std::size_t>(clip.frame_count(), 240));
}

using DenoisingErrors =
    std::map<std::string, std::vector<double>>;  // errors of each method, by take

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

const std::vector<std::string> learned_and_auto{"auto", "wiener", "learned"};

// The errors of all methods on all takes for one noise. The Gaussian with the least error over all
// takes is the best constant one.
DenoisingErrors errors_of(const Arguments& arguments, const std::vector<NoisyHoldOut>& takes,
                          double k) {
  const std::vector<double> widths{0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045};
  DenoisingErrors errors;
  std::map<double, std::vector<double>> gaussians;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    const Take truth = clip_of(arguments, takes[i].name);
    const Take clip = damaged(truth, "gaussian-channels", {{"k", k}}, 100 + i);
    const auto gaussian = [&](double width_s) {
      return rms_deg(truth, cleaned(clip, "gaussian", {{"width_s", width_s}}));
    };
    errors["noisy"].push_back(rms_deg(truth, clip));
    errors["gaussian 58 ms"].push_back(gaussian(0.058));
    errors["gaussian 125 ms"].push_back(gaussian(0.125));
    gaussians[0.058].push_back(errors["gaussian 58 ms"].back());
    for (const double width_s : widths) gaussians[width_s].push_back(gaussian(width_s));
    for (const std::string& method : learned_and_auto)
      errors[method].push_back(rms_deg(truth, cleaned(clip, method)));
  }
  const auto best = std::min_element(
      gaussians.begin(), gaussians.end(),
      [](const auto& a, const auto& b) { return mean_of(a.second) < mean_of(b.second); });
  errors["best constant gaussian"] = best->second;
  return errors;
}

std::vector<double> of_action(const std::vector<double>& values,
                              const std::vector<NoisyHoldOut>& takes, const std::string& action) {
  std::vector<double> chosen;
  for (std::size_t i = 0; i < takes.size(); ++i) {
    if (action == "all" || takes[i].action == action) chosen.push_back(values[i]);
  }
  return chosen;
}

void amplitudes(const Arguments& arguments) {
  Table table(arguments, "mall_denoising.csv", "k,action,method,takes,rms_deg,of_gaussian_58");
  const std::vector<NoisyHoldOut> takes = hold_outs(arguments);
  for (const double k : {0.1, 0.5, 0.9}) {
    if (arguments.quick && k != 0.5) continue;
    const DenoisingErrors errors = errors_of(arguments, takes, k);
    for (const char* action : {"all", "walk", "jog", "run", "jump", "kick"}) {
      const double gaussian = mean_of(of_action(errors.at("gaussian 58 ms"), takes, action));
      for (const auto& [method, values] : errors) {
        const std::vector<double> chosen = of_action(values, takes, action);
        if (chosen.empty()) continue;
        const double mean = mean_of(chosen);
        table.add({fmt::format("{}", k), action, method, fmt::format("{}", chosen.size()),
                   figure(mean), figure(mean / gaussian)});
        if (std::string(action) == "all")
          fmt::print("k {} {:24} {:.3f} deg, {:.3f} of the 58 ms Gaussian\n", k, method, mean,
                     mean / gaussian);
      }
    }
  }
  table.close();
}

struct DenoisingKind {
  std::string name;
  std::function<Take(const Take&, std::uint64_t)> damage;
};

std::vector<DenoisingKind> denoising_kinds() {
  using quality::of_lower_rate;
  const auto of = [](const std::string& name, const OptionValues& options) {
    return [name, options](const Take& c, std::uint64_t s) { return damaged(c, name, options, s); };
  };
  return {
      {"clean", [](const Take& c, std::uint64_t) { return c; }},
      {"white 1", of("gaussian", {{"std_deg", 1.0}})},
      {"white 4 and spikes", [](const Take& c, std::uint64_t s) { return noisy(c, 4, 0.004, s); }},
      {"ar1 0.5", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.5}})},
      {"ar1 0.8", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.8}})},
      {"ar1 0.95", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.95}})},
      {"held 60",
       [](const Take& c, std::uint64_t s) { return of_lower_rate(noisy(c, 1.5, 0, s), 2, true); }},
      {"linear 30",
       [](const Take& c, std::uint64_t s) { return of_lower_rate(noisy(c, 1.5, 0, s), 4, false); }},
      {"video", of("system", {{"kind", std::string("video")}})},
      {"inertial", of("system", {{"kind", std::string("inertial")}})}};
}

// The takes of page_noise's held-out set.
void other_noise(const Arguments& arguments) {
  std::vector<std::string> names{"01_13",  "02_10",  "05_14", "06_11", "08_08",
                                 "131_07", "135_09", "16_24", "35_14", "49_17"};
  if (arguments.quick || arguments.data.empty()) names = {"walk"};
  Table table(arguments, "mall_kinds.csv", "kind,method,takes,rms_deg,of_auto");
  for (const DenoisingKind& kind : denoising_kinds()) {
    DenoisingErrors errors;
    for (const std::string& name : names) {
      const Take whole = clip_of(arguments, name);
      const Take take = slice(whole, 0, std::min<std::size_t>(whole.frame_count(), 721));
      const Take clip = kind.damage(take, 5);
      const Take truth = slice(take, 0, clip.frame_count());
      for (const std::string& method : learned_and_auto)
        errors[method].push_back(geodesic_rms_deg(truth, cleaned(clip, method)));
    }
    for (const auto& [method, values] : errors) {
      double share = 0;
      std::size_t count = 0;
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (errors["auto"][i] <= 0 || values[i] <= 0) continue;
        share += std::log(values[i] / errors["auto"][i]);
        ++count;
      }
      const double of_auto = count > 0 ? std::exp(share / static_cast<double>(count)) : 1;
      table.add({kind.name, method, fmt::format("{}", values.size()), figure(mean_of(values)),
                 figure(of_auto)});
      fmt::print("{:16} {:10} {:.4f} deg, {:.3f} of auto\n", kind.name, method, mean_of(values),
                 of_auto);
    }
  }
  table.close();
}

void mall_denoising(const Arguments& arguments) {
  amplitudes(arguments);
  other_noise(arguments);
}

const Registration mall_denoising_entry("mall_denoising", mall_denoising);

}  // namespace
}  // namespace kinemend::papers
