// The comparison of Xiao et al. 2015, Sparse motion bases selection for human motion denoising:
// figures 6 and 7 and table 1 (noise, outliers, both), table 2 (poselets against whole poses),
// figure 9 (training on one action or on all) and figure 10 (M, K and lambda).
#include <chrono>

#include "xiao.hpp"

namespace kinemend::papers {
namespace {

std::vector<std::string> numbered(const std::string& subject, int first, int last) {
  std::vector<std::string> names;
  for (int i = first; i <= last; ++i) names.push_back(fmt::format("{}_{:02}", subject, i));
  return names;
}

std::vector<std::string> joined(std::vector<std::string> names,
                                const std::vector<std::string>& others) {
  names.insert(names.end(), others.begin(), others.end());
  return names;
}

XiaoGroup group_of(const Arguments& arguments, const std::string& name, const std::string& motion,
                   const std::vector<std::string>& training,
                   const std::vector<std::string>& tests) {
  const std::size_t most = arguments.quick ? 150 : 300;
  XiaoGroup group{name, xiao_takes(arguments, training, motion, 1, arguments.quick ? 360 : 3000),
                  xiao_takes(arguments, tests, motion, 101, most)};
  return group;
}

// The paper's three actions, of which its sequences are the first tests; of basketball 13 clips are
// at hand.
std::vector<XiaoGroup> groups_of(const Arguments& arguments) {
  if (arguments.quick)
    return {group_of(arguments, "run", "run", {"quick_1", "quick_2"}, {"quick_3"})};
  return {group_of(arguments, "run", "run",
                   joined(joined(numbered("09", 5, 9), numbered("35", 17, 21)),
                          {"16_35", "16_36", "16_45", "16_46", "38_03", "49_04"}),
                   {"09_04", "35_24"}),
          group_of(arguments, "dance", "walk",
                   joined(joined(numbered("05", 2, 8), numbered("60", 1, 5)),
                          {"05_10", "05_11", "05_12", "49_09"}),
                   {"05_16", "60_08"}),
          group_of(arguments, "basketball", "walk",
                   joined(numbered("06", 3, 7), numbered("06", 10, 12)), {"06_13", "06_14"})};
}

OptionValues training_options(const Arguments& arguments) {
  if (!arguments.quick) return {{"windows", std::int64_t{10'000}}};
  return {{"atoms", std::int64_t{60}}, {"iterations", std::int64_t{4}}};
}

std::vector<XiaoMethod> methods_of(const Arguments& arguments, const XiaoGroup& group) {
  std::vector<XiaoMethod> methods;
  XiaoMethod gaussian{"gaussian", {}}, wavelet{"wavelet", {}}, kalman{"kalman", {}},
      example{"example", {}}, automatic{"auto", {}};
  for (const double width_s : {0.008, 0.016, 0.03, 0.05, 0.08})
    gaussian.cleaners.push_back(make_gaussian({width_s}));
  for (const char* family : {"db4", "sym8"}) {
    for (const char* threshold : {"sure", "universal"}) {
      for (const char* shrinkage : {"soft", "hard"})
        wavelet.cleaners.push_back(make_wavelet({family, threshold, shrinkage}));
    }
  }
  for (const double agility : {0.05, 0.2, 1.0, 4.0})
    kalman.cleaners.push_back(
        make_kalman({.model = "velocity", .smoother = false, .agility = agility}));
  const auto bases = xiao_model("example", group.training);
  for (const char* solver : {"quick", "paper"}) {
    ExampleOptions options;
    options.solver = solver;
    example.cleaners.push_back(make_example(options, bases));
  }
  automatic.cleaners.push_back(make_auto());
  methods.push_back(std::move(gaussian));
  methods.push_back(std::move(wavelet));
  methods.push_back(std::move(kalman));
  methods.push_back(std::move(example));
  methods.push_back(sparse_method(xiao_model("sparse", group.training, training_options(arguments)),
                                  {0.02, 0.1, 0.3}));
  methods.push_back(std::move(automatic));
  return methods;
}

std::vector<MarkerClip> tuning_clips(const XiaoGroup& group) {
  std::vector<MarkerClip> clips;
  for (std::size_t i = 0; i < group.training.size() && clips.size() < 2; i += 7)
    clips.push_back(
        slice(group.training[i], 0, std::min<std::size_t>(120, group.training[i].frame_count())));
  return clips;
}

std::string metres(double value) { return fmt::format("{:.5f}", value); }

void comparison(const Arguments& arguments, const std::vector<XiaoGroup>& groups) {
  Table table(arguments, "xiao_noise.csv", "motion,noise,method,mean_m,deviation_m");
  for (const XiaoGroup& group : groups) {
    const std::vector<XiaoMethod> methods = methods_of(arguments, group);
    const std::vector<MarkerClip> tuning = tuning_clips(group);
    for (const XiaoNoise& noise : xiao_noises()) {
      const auto add = [&](const std::string& name, const auto& error_of) {
        double mean = 0, deviation = 0;
        for (std::size_t t = 0; t < group.tests.size(); ++t) {
          const MeanAndDeviation error =
              error_of(group.tests[t], xiao_noise(group.tests[t], noise, t + 1));
          mean += error.mean / static_cast<double>(group.tests.size());
          deviation += error.deviation / static_cast<double>(group.tests.size());
        }
        table.add({group.name, noise.name, name, metres(mean), metres(deviation)});
        fmt::print("{:<11}{:<7}{:<10}{:9.5f}{:9.5f}\n", group.name, noise.name, name, mean,
                   deviation);
        std::fflush(stdout);
      };
      add("(noisy)", [](const MarkerClip& truth, const MarkerClip& noisy) {
        return rmse_per_marker(truth.positions, noisy.positions, truth.marker_count());
      });
      for (const XiaoMethod& method : methods) {
        const Cleaner& cleaner = method.tuned(tuning, noise);
        add(method.name, [&](const MarkerClip& truth, const MarkerClip& noisy) {
          return xiao_error(cleaner, truth, noisy);
        });
      }
    }
  }
  table.close();
}

double error_on(const XiaoGroup& group, const Cleaner& cleaner, const XiaoNoise& noise) {
  double sum = 0;
  for (std::size_t t = 0; t < group.tests.size(); ++t)
    sum += xiao_error(cleaner, group.tests[t], xiao_noise(group.tests[t], noise, t + 1)).mean;
  return sum / static_cast<double>(group.tests.size());
}

SparseOptions plain_options(double lambda = 0.1) {
  SparseOptions options;
  options.loss = "l2";
  options.lambda = lambda;
  return options;
}

// Table 2 and figures 9 and 10, at 20 dB; but for table 2 on the first action alone.
void variants(const Arguments& arguments, const std::vector<XiaoGroup>& groups) {
  const XiaoNoise noise{"20 dB", 20, 0};
  Table table(arguments, "xiao_variants.csv", "motion,what,value,mean_m");
  std::vector<MarkerClip> all;
  for (const XiaoGroup& group : groups)
    all.insert(all.end(), group.training.begin(), group.training.end());
  for (const XiaoGroup& group : groups) {
    const auto add = [&](const std::string& what, const std::string& value,
                         const Cleaner& cleaner) {
      const auto start = std::chrono::steady_clock::now();
      const double error = error_on(group, cleaner, noise);
      const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
      table.add({group.name, what, value, metres(error)});
      fmt::print("{:<11}{:<16}{:<9}{:9.5f} m {:7.2f} s\n", group.name, what, value, error,
                 time.count());
      std::fflush(stdout);
    };
    const auto add_trained = [&](const std::string& what, const std::string& value,
                                 const OptionValues& extra, double lambda = 0.1) {
      OptionValues options = training_options(arguments);
      for (const auto& [name, setting] : extra) options[name] = setting;
      add(what, value,
          *make_sparse(plain_options(lambda), xiao_model("sparse", group.training, options)));
    };
    add_trained("representation", "poselets", {});
    add_trained("representation", "whole", {{"whole", true}});
    add_trained("coordinates", "local", {{"local", true}});
    if (groups.size() > 1 && &group != &groups.front()) continue;
    if (groups.size() > 1) {
      add("training sparse", "one",
          *make_sparse(plain_options(),
                       xiao_model("sparse", group.training, training_options(arguments))));
      add("training sparse", "all", *make_sparse(plain_options(), xiao_model("sparse", all)));
      add("training example", "one", *make_example({}, xiao_model("example", group.training)));
      add("training example", "all", *make_example({}, xiao_model("example", all)));
    }
    for (const int frames :
         arguments.quick ? std::vector<int>{9, 21} : std::vector<int>{5, 9, 15, 27})
      add_trained("M", std::to_string(frames), {{"window_frames", std::int64_t{frames}}});
    for (const int atoms : arguments.quick ? std::vector<int>{30} : std::vector<int>{125, 250, 500})
      add_trained("K", std::to_string(atoms), {{"atoms", std::int64_t{atoms}}});
    const auto model = xiao_model("sparse", group.training, training_options(arguments));
    for (const double lambda : {0.03, 0.1, 0.3, 1.0, 3.0})
      add("lambda", fmt::format("{}", lambda), *make_sparse(plain_options(lambda), model));
  }
  table.close();
}

void experiment(const Arguments& arguments) {
  const std::vector<XiaoGroup> groups = groups_of(arguments);
  comparison(arguments, groups);
  variants(arguments, groups);
}

}  // namespace
}  // namespace kinemend::papers

int main(int count, char** values) {
  return kinemend::papers::run(count, values, kinemend::papers::experiment);
}
