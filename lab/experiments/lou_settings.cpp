// The settings of Lou & Chai 2010, Example-based Human Motion Denoising, with the paper's solver:
// p of equation 9 (section 3.2), lambda of equation 10 (section 3.3), and how many iterations it
// takes to converge (section 3.4.3).
#include "kinemend/extend/method_options.hpp"
#include "lou.hpp"

namespace kinemend::papers {
namespace {

// Walks that were not learned from, with noise and outliers.
struct NoisyWalks {
  std::vector<Take> truth, noisy;
};

NoisyWalks noisy_walks(const LouGroup& group, double std_deg, double share) {
  NoisyWalks walks{group.tests, {}};
  for (const Take& truth : walks.truth)
    walks.noisy.push_back(lou_noise(truth, std_deg, share, 1 + walks.noisy.size()));
  return walks;
}

double error_of(const Cleaner& cleaner, const NoisyWalks& walks) {
  double sum = 0;
  for (std::size_t i = 0; i < walks.truth.size(); ++i)
    sum += rms_deg(walks.truth[i], cleaned(cleaner, walks.noisy[i]));
  return sum / static_cast<double>(walks.truth.size());
}

void lou_settings(const Arguments& arguments) {
  const std::vector<LouGroup> groups = walking_groups(arguments);
  std::vector<std::shared_ptr<const Model>> models;
  for (const LouGroup& group : groups) models.push_back(learned("example", group.training));
  Table table(arguments, "lou_settings.csv", "noise,what,value,rms_deg");
  fmt::print("The paper's solver by its settings. Degrees per joint angle.\n\n");
  struct Damage {
    std::string name;
    double std_deg, share;
  };
  for (const Damage& damage :
       {Damage{"3 deg", 3, 0}, Damage{"3 deg, 10 %", 3, 0.1}, Damage{"10 %", 0, 0.1}}) {
    std::vector<NoisyWalks> walks;
    for (const LouGroup& group : groups)
      walks.push_back(noisy_walks(group, damage.std_deg, damage.share));
    const auto add = [&](const std::string& what, const std::string& value,
                         const ExampleOptions& options) {
      double error = 0;
      for (std::size_t g = 0; g < groups.size(); ++g)
        error += error_of(*make_example(options, models[g]), walks[g]);
      error /= static_cast<double>(groups.size());
      table.add({quoted(damage.name), what, value, fmt::format("{:.5g}", error)});
      fmt::print("{:12} {:11} {:6} {:9.4f}\n", damage.name, what, value, error);
      std::fflush(stdout);
    };
    ExampleOptions usual;
    usual.solver = "paper", usual.welsch_deg = 3, usual.lambda = 0.1;
    for (const double p : {1.0, 3.0, 5.0, 7.0, 10.0, 15.0, 25.0}) {
      ExampleOptions options = usual;
      options.welsch_deg = p;
      add("p", fmt::format("{:g}", p), options);
    }
    for (const double lambda : {0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 3.0}) {
      ExampleOptions options = usual;
      options.lambda = lambda;
      add("lambda", fmt::format("{:g}", lambda), options);
    }
    // With a tolerance of 0 all iterations are made.
    for (const std::int64_t iterations : {1, 2, 5, 10, 20, 50, 100, 200}) {
      ExampleOptions options = usual;
      options.iterations = arguments.quick ? std::min<std::int64_t>(iterations, 20) : iterations;
      options.tolerance = 0;
      add("iterations", fmt::format("{}", iterations), options);
    }
  }
  table.close();
}

const Registration lou_settings_entry("lou_settings", lou_settings);

}  // namespace
}  // namespace kinemend::papers
