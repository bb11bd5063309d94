// Errors that `auto` leaves for six kinds of noise, as a share of those of the best Gaussian:
// white, correlated from frame to frame, and samples of a lower rate, held or interpolated.
#include <algorithm>
#include <cmath>
#include <functional>

#include "kinemend/extend/figures.hpp"
#include "page.hpp"
#include "quality/lower_rate.hpp"

namespace kinemend::papers {
namespace {

constexpr double noise_deg = 1.5;

struct NoiseKind {
  std::string name;
  std::function<Take(const Take&, std::uint64_t)> damage;
};

std::vector<NoiseKind> noise_kinds() {
  using quality::of_lower_rate;
  const auto correlated = [](double correlation) {
    return [correlation](const Take& clip, std::uint64_t seed) {
      return damaged(clip, "ar1", {{"std_deg", noise_deg}, {"correlation", correlation}}, seed);
    };
  };
  return {{"white", [](const Take& c, std::uint64_t s) { return noisy(c, noise_deg, 0, s); }},
          {"ar1 0.5", correlated(0.5)},
          {"ar1 0.8", correlated(0.8)},
          {"ar1 0.95", correlated(0.95)},
          {"held 60",
           [](const Take& c, std::uint64_t s) {
             return of_lower_rate(noisy(c, noise_deg, 0, s), 2, true);
           }},
          {"linear 30", [](const Take& c, std::uint64_t s) {
             return of_lower_rate(noisy(c, noise_deg, 0, s), 4, false);
           }}};
}

double best_gaussian(const Take& truth, const Take& clip) {
  double best = 1e300;
  for (const double width_s : {0.006, 0.01, 0.015, 0.02, 0.03, 0.04, 0.05, 0.065, 0.085, 0.11})
    best =
        std::min(best, geodesic_rms_deg(truth, cleaned(clip, "gaussian", {{"width_s", width_s}})));
  return best;
}

void noise_auto(const Arguments& arguments) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> sets{
      {"dev", {"02_09", "05_08", "06_06", "131_02", "16_11", "27_01", "35_33", "49_14", "135_05"}},
      {"held-out",
       {"01_13", "02_10", "05_14", "06_11", "08_08", "131_07", "135_09", "16_24", "35_14",
        "49_17"}}};
  Table table(arguments, "page_noise.csv", "set,kind,untouched,auto");
  for (const auto& [set, takes] : sets) {
    std::vector<NamedTake> truths;
    for (const std::string& take : takes) {
      if (arguments.quick && !truths.empty()) break;
      truths.push_back(load_take(arguments, take + ".bvh", {.motion = "walk"}));
      Take& clip = truths.back().clip;
      clip = slice(clip, 0, std::min<std::size_t>(clip.frame_count(), 721));
    }
    for (const NoiseKind& kind : noise_kinds()) {
      double untouched = 0, ours = 0;
      for (const NamedTake& take : truths) {
        const Take clip = kind.damage(take.clip, 5);
        const Take truth = slice(take.clip, 0, clip.frame_count());
        const double best = best_gaussian(truth, clip);
        const double u = geodesic_rms_deg(truth, clip) / best;
        const double a = geodesic_rms_deg(truth, cleaned(clip, "auto")) / best;
        untouched += std::log(u) / static_cast<double>(truths.size());
        ours += std::log(a) / static_cast<double>(truths.size());
      }
      fmt::print("{} {} untouched {:.3f} auto {:.3f}\n", set, kind.name, std::exp(untouched),
                 std::exp(ours));
      table.add({set, kind.name, figure(std::exp(untouched)), figure(std::exp(ours))});
    }
  }
  table.close();
}

const Registration noise_auto_entry("noise_auto", noise_auto);

}  // namespace
}  // namespace kinemend::papers
