// The comparisons of Lou & Chai 2010, Example-based Human Motion Denoising: error against noise and
// against the share of outliers (figure 7).
#include <algorithm>

#include "kinemend/extend/figures.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

struct Damaged {
  std::string label;
  double std_deg = 0, share_of_outliers = 0;
};

std::size_t seeds(const Arguments& arguments) { return arguments.quick ? 1 : 3; }

// Errors of every method for one damage, over groups, tests and seeds; those of the input come
// last.
LouErrors errors_of(const Arguments& arguments, const std::vector<LouGroup>& groups,
                    const std::vector<std::vector<LouMethod>>& methods, const Damaged& damage) {
  LouErrors errors;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const Take& truth : groups[g].tests) {
      for (std::size_t seed = 1; seed <= seeds(arguments); ++seed) {
        const Take noisy = lou_noise(truth, damage.std_deg, damage.share_of_outliers, seed);
        for (std::size_t m = 0; m < methods[g].size(); ++m) {
          for (std::size_t c = 0; c < methods[g][m].cleaners.size(); ++c)
            errors.add(m, c, rms_deg(truth, cleaned(*methods[g][m].cleaners[c], noisy)));
        }
        errors.add(methods[g].size(), 0, rms_deg(truth, noisy));
      }
    }
  }
  return errors;
}

void figure_7(const Arguments& arguments, const std::vector<LouGroup>& groups,
              const std::vector<std::vector<LouMethod>>& methods,
              const std::vector<Damaged>& damages, const std::string& file,
              const std::string& title) {
  Table table(arguments, file, "method,of_the_paper,level,rms_deg");
  std::vector<std::string> columns;
  std::vector<LouErrors> errors;
  for (const Damaged& damage : damages) {
    columns.push_back(damage.label);
    errors.push_back(errors_of(arguments, groups, methods, damage));
  }
  const TextTable text(columns);
  for (std::size_t m = 0; m <= methods[0].size(); ++m) {
    const bool is_input = m == methods[0].size();
    std::vector<double> row;
    for (std::size_t d = 0; d < damages.size(); ++d) {
      row.push_back(errors[d].of(m));
      const double level = damages[d].share_of_outliers > 0 || damages[d].std_deg == 0
                               ? 100 * damages[d].share_of_outliers
                               : damages[d].std_deg;
      table.add({is_input ? "\"(noisy)\"" : "\"" + methods[0][m].name + "\"",
                 !is_input && methods[0][m].is_of_the_paper ? "1" : "0", fmt::format("{:g}", level),
                 fmt::format("{:.5g}", row.back())});
    }
    text.add(is_input ? "(noisy)" : methods[0][m].name, row);
  }
  fmt::print("{}\n\n", title);
  table.close();
}

void comparisons(const Arguments& arguments) {
  const std::vector<LouGroup> groups = walking_groups(arguments);
  std::vector<std::vector<LouMethod>> methods;
  for (const LouGroup& group : groups) methods.push_back(lou_methods(lou_models(group.training)));
  std::vector<Damaged> noise, outliers;
  for (const int std_deg : {1, 2, 3, 4, 5, 6}) {
    if (arguments.quick && std_deg % 3 != 0) continue;
    noise.push_back({fmt::format("{} deg", std_deg), static_cast<double>(std_deg), 0});
  }
  for (const int percent : {0, 1, 5, 10, 15, 20}) {
    if (arguments.quick && percent % 10 != 0) continue;
    outliers.push_back({fmt::format("{} %", percent), 0, percent / 100.0});
  }
  figure_7(arguments, groups, methods, noise, "lou_noise.csv",
           "Figure 7, left: walks at 30 Hz with Gaussian noise on every joint angle. Degrees per "
           "joint angle and frame.");
  figure_7(arguments, groups, methods, outliers, "lou_outliers.csv",
           "Figure 7, right: the same walks with jumps (25 degrees about each axis) in a share of "
           "the joints' samples.");
}

const Registration lou_comparison_entry("lou_comparison", comparisons);

}  // namespace
}  // namespace kinemend::papers
