// Figures of docs/methods/learned.md: noise of every kind on takes outside the model's training,
// and the changes to clean takes.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "base/quantiles.hpp"
#include "compared.hpp"
#include "kept_takes.hpp"
#include "kinemend/extend/figures.hpp"
#include "noise_kinds.hpp"
#include "page.hpp"
#include "quality/lower_rate.hpp"

namespace kinemend::papers {
namespace {

const std::vector<Compared> methods_compared{{"auto", "auto"},
                                             {"wiener", "wiener"},
                                             {"learned", "learned"},
                                             {"learned live", "learned", {{"live", true}}}};

double gaussian_error(const Take& truth, const Take& clip, double width_s) {
  return rms_deg(truth, cleaned(clip, "gaussian", {{"width_s", width_s}}));
}

double least_gaussian_error(const Take& truth, const Take& clip) {
  double best = rms_deg(truth, clip);
  for (const double width_s :
       {0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045, 0.058, 0.08, 0.11, 0.16})
    best = std::min(best, gaussian_error(truth, clip, width_s));
  return best;
}

struct AnyNoiseKind {
  std::string name;
  std::function<Take(const Take&, std::uint64_t)> damage;
  std::function<double(const Take&, const Take&)> measure = least_gaussian_error;
};

std::vector<AnyNoiseKind> any_noise_kinds() {
  using quality::of_lower_rate;
  const auto of = [](const std::string& name, const OptionValues& options) {
    return [name, options](const Take& c, std::uint64_t s) { return damaged(c, name, options, s); };
  };
  return {{"half of each channel", of("gaussian-channels", {{"k", 0.5}}),
           [](const Take& truth, const Take& clip) { return gaussian_error(truth, clip, 0.058); }},
          {"white", of("gaussian", {{"std_deg", 1.5}})},
          {"ar1 0.5", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.5}})},
          {"ar1 0.8", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.8}})},
          {"ar1 0.95", of("ar1", {{"std_deg", 1.5}, {"correlation", 0.95}})},
          {"held 60", [](const Take& c,
                         std::uint64_t s) { return of_lower_rate(noisy(c, 1.5, 0, s), 2, true); }},
          {"lines between 30 Hz", noise_of_30_hz},
          {"below 4 Hz", low_passed_noise}};
}

void every_noise(const Arguments& arguments) {
  Table table(arguments, "any_noise.csv", "noise,method,takes,share,rms_deg");
  for (const AnyNoiseKind& kind : any_noise_kinds()) {
    std::map<std::string, double> shares, errors;
    const std::vector<std::string> names = kept_takes(arguments);
    const auto count = static_cast<double>(names.size());
    for (const std::string& name : names) {
      const Take take = kept_take(arguments, name);
      const Take clip = kind.damage(take, 7);
      const Take truth = slice(take, 0, clip.frame_count());
      const double unit = kind.measure(truth, clip);
      const auto add = [&](const std::string& method, const Take& result) {
        const double error = rms_deg(truth, result);
        shares[method] += error / unit / count;
        errors[method] += error / count;
      };
      add("untouched", clip);
      for (const Compared& method : methods_compared) add(method.label, cleaned(clip, method));
    }
    for (const auto& [method, share] : shares) {
      table.add({kind.name, method, fmt::format("{}", names.size()), figure(share),
                 figure(errors[method])});
      fmt::print("{:22} {:12} {:.3f}  {:.3f} deg\n", kind.name, method, share, errors[method]);
    }
  }
  table.close();
}

// Measures white noise of 1.5 degrees with spikes, on the three clips of the project's first
// tables.
void white_and_spikes(const Arguments& arguments) {
  Table table(arguments, "any_spikes.csv", "take,method,rms_deg");
  std::vector<std::string> names{"35_01", "02_05", "09_03"};
  if (arguments.quick || arguments.data.empty()) names = {"walk"};
  for (const std::string& name : names) {
    const Take truth = load_take(arguments, name + ".bvh", {.motion = name}).clip;
    const Take clip = noisy(truth, 1.5, 0.004, 1);
    table.add({name, "untouched", figure(rms_deg(truth, clip))});
    for (const Compared& method : methods_compared)
      table.add({name, method.label, figure(rms_deg(truth, cleaned(clip, method)))});
  }
  table.close();
}

// Measures the changes to clean takes.
void any_noise_on_clean_takes(const Arguments& arguments) {
  Table table(arguments, "any_clean.csv", "method,takes,median_deg,worst_deg");
  std::vector<std::string> names;
  std::ifstream list(arguments.data / "cmu" / "recurrent-100.csv");
  for (std::string line; std::getline(list, line);) {
    const std::string name = line.substr(0, line.find(','));
    if (name.find('_') != std::string::npos) names.push_back(name);
  }
  if (arguments.quick || names.empty()) names = {"walk"};
  for (const Compared& method : methods_compared) {
    std::vector<double> changes;
    for (const std::string& name : names) {
      const Take clip = load_take(arguments, name + ".bvh", {.motion = name}).clip;
      changes.push_back(geodesic_rms_deg(clip, cleaned(clip, method)));
    }
    const auto worst = std::max_element(changes.begin(), changes.end());
    const std::string& worst_name = names[static_cast<std::size_t>(worst - changes.begin())];
    const double most = *worst, median = upper_median_of(changes);
    fmt::print("clean: {:12} median {:.4f} deg, most {:.3f} ({})\n", method.label, median, most,
               worst_name);
    table.add({method.label, fmt::format("{}", names.size()), figure(median), figure(most)});
  }
  table.close();
}

void page_any_noise(const Arguments& arguments) {
  every_noise(arguments);
  white_and_spikes(arguments);
  any_noise_on_clean_takes(arguments);
}

const Registration page_any_noise_entry("page_any_noise", page_any_noise);

}  // namespace
}  // namespace kinemend::papers
