// The comparison of Xiao et al. 2015, Sparse motion bases selection for human motion denoising:
// figures 6 and 7 and table 1 (noise, outliers, both). Each method has the settings that are best
// on two clips of the training, by models that have not seen these two.
#include <functional>

#include "xiao.hpp"

namespace kinemend::papers {
namespace {

/// What the learned methods know: `example` with windows of several lengths.
struct Models {
  std::shared_ptr<const Model> sparse;
  std::vector<std::shared_ptr<const Model>> example;
};

/// A method with the settings that it is tuned over.
struct Method {
  std::string name;
  struct Setting {
    std::string name;
    std::function<std::unique_ptr<Cleaner>(const Models&)> make;
  };
  std::vector<Setting> settings;

  template <class Make>
  void add(const std::string& setting, const Make& make) {
    settings.push_back({setting, make});
  }
};

std::vector<double> window_lengths_s(const Arguments& arguments) {
  return arguments.quick ? std::vector<double>{0.5} : std::vector<double>{1.0 / 3, 2.0 / 3, 1};
}

Models models_of(const Arguments& arguments, const std::vector<MarkerClip>& clips) {
  Models models{xiao_model("sparse", clips, xiao_training(arguments)), {}};
  for (const double window_s : window_lengths_s(arguments))
    models.example.push_back(xiao_model("example", clips, {{"window_s", window_s}}));
  return models;
}

Method gaussian_method() {
  Method method{"gaussian", {}};
  for (const double width_s : {0.005, 0.008, 0.012, 0.016, 0.022, 0.03, 0.05, 0.08})
    method.add(fmt::format("{} s", width_s),
               [=](const Models&) { return make_gaussian({width_s}); });
  return method;
}

Method wavelet_method() {
  Method method{"wavelet", {}};
  for (const char* family : {"db4", "sym8"}) {
    for (const char* threshold : {"sure", "universal"}) {
      for (const char* shrinkage : {"soft", "hard"})
        method.add(fmt::format("{} {} {}", family, threshold, shrinkage), [=](const Models&) {
          return make_wavelet({family, threshold, shrinkage});
        });
    }
  }
  return method;
}

// The paper's is causal; with the smoother it is stronger.
Method kalman_method() {
  Method method{"kalman", {}};
  for (const char* model : {"position", "velocity"}) {
    for (const bool smoother : {false, true}) {
      for (const double agility : {0.05, 0.2, 1.0, 4.0})
        method.add(fmt::format("{} {} {}", model, smoother ? "smoother" : "filter", agility),
                   [=](const Models&) {
                     return make_kalman({.model = model, .smoother = smoother, .agility = agility});
                   });
    }
  }
  return method;
}

// The paper's parameters are the window, K and p; by default the last two come from noise and
// model.
Method example_method(const Arguments& arguments) {
  Method method{"example", {}};
  for (std::size_t w = 0; w < window_lengths_s(arguments).size(); ++w) {
    const std::string window = fmt::format("{:.2f} s", window_lengths_s(arguments)[w]);
    const auto add = [&](const std::string& name, const ExampleOptions& options) {
      method.add(window + " " + name,
                 [=](const Models& models) { return make_example(options, models.example[w]); });
    };
    add("own", {});
    for (const double welsch_deg : {1.0, 3.0, 7.0}) {
      ExampleOptions options;
      options.solver = "paper";
      options.welsch_deg = welsch_deg;
      add(fmt::format("paper p {}", welsch_deg), options);
    }
  }
  return method;
}

Method sparse_method() {
  Method method{"sparse", {}};
  for (const char* loss : {"l2", "l1", "mixed"}) {
    for (const double lambda : {0.02, 0.1})
      method.add(fmt::format("{} {}", loss, lambda), [=](const Models& models) {
        SparseOptions options;
        options.loss = loss;
        options.lambda = lambda;
        return make_sparse(options, models.sparse);
      });
  }
  return method;
}

std::vector<Method> methods_of(const Arguments& arguments) {
  Method automatic{"auto", {}};
  automatic.add("", [](const Models&) { return make_auto(); });
  return {gaussian_method(),         wavelet_method(), kalman_method(),
          example_method(arguments), sparse_method(),  std::move(automatic)};
}

/// The training in two: a second of two clips to choose settings by, and the others.
struct Fold {
  std::vector<MarkerClip> training, tuning;
};

Fold fold_of(const XiaoGroup& group) {
  Fold fold;
  const std::size_t count = group.training.size();
  for (std::size_t i = 0; i < count; ++i) {
    const MarkerClip& clip = group.training[i];
    const bool is_held = count > 4 ? i == count / 4 || i == 3 * count / 4 : i + 1 == count;
    if (!is_held) {
      fold.training.push_back(clip);
      continue;
    }
    const std::size_t frames = std::min<std::size_t>(120, clip.frame_count());
    const std::size_t first = (clip.frame_count() - frames) / 2;
    fold.tuning.push_back(slice(clip, first, first + frames));
  }
  return fold;
}

/// The setting with the least mean error on the clips with that noise.
const Method::Setting& tuned(const Method& method, const Models& models,
                             const std::vector<MarkerClip>& clips, const XiaoNoise& noise) {
  const Method::Setting* best = &method.settings.front();
  double least = 1e300;
  for (const Method::Setting& setting : method.settings) {
    if (method.settings.size() == 1) break;
    const auto cleaner = setting.make(models);
    double sum = 0;
    for (std::size_t c = 0; c < clips.size(); ++c)
      sum += xiao_error(*cleaner, clips[c], xiao_noise(clips[c], noise, 1000 + c)).mean;
    if (sum < least) least = sum, best = &setting;
  }
  return *best;
}

/// Of the paper's own sequence, and the mean of all that are tried.
struct Errors {
  MeanAndDeviation own, all;
};

template <class ErrorOf>
Errors errors_of(const XiaoGroup& group, const XiaoNoise& noise, const ErrorOf& error_of) {
  Errors errors{};
  const auto count = static_cast<double>(group.tests.size());
  for (std::size_t t = 0; t < group.tests.size(); ++t) {
    const MeanAndDeviation error =
        error_of(group.tests[t], xiao_noise(group.tests[t], noise, t + 1));
    if (t == 0) errors.own = error;
    errors.all.mean += error.mean / count;
    errors.all.deviation += error.deviation / count;
  }
  return errors;
}

void compare(const Arguments& arguments, const XiaoGroup& group, Table& table) {
  const Fold fold = fold_of(group);
  const Models tuning = models_of(arguments, fold.training);
  const Models models = models_of(arguments, group.training);
  for (const XiaoNoise& noise : xiao_noises()) {
    const auto add = [&](const std::string& name, const std::string& setting,
                         const Errors& errors) {
      const auto cm = [](double metres) { return fmt::format("{:.3f}", 100 * metres); };
      table.add({noise.name, name, cm(errors.own.mean), cm(errors.own.deviation),
                 cm(errors.all.mean), cm(errors.all.deviation)});
      fmt::print("{:<11}{:<7}{:<10}{:9.5f}{:9.5f}{:9.5f}{:9.5f}  {}\n", group.name, noise.name,
                 name, errors.own.mean, errors.own.deviation, errors.all.mean, errors.all.deviation,
                 setting);
      std::fflush(stdout);
    };
    add("(noisy)", "",
        errors_of(group, noise, [](const MarkerClip& truth, const MarkerClip& noisy) {
          return rmse_per_marker(truth.positions, noisy.positions, truth.marker_count());
        }));
    for (const Method& method : methods_of(arguments)) {
      const Method::Setting& setting = tuned(method, tuning, fold.tuning, noise);
      const auto cleaner = setting.make(models);
      add(method.name, setting.name,
          errors_of(group, noise, [&](const MarkerClip& truth, const MarkerClip& noisy) {
            return xiao_error(*cleaner, truth, noisy);
          }));
    }
  }
}

void experiment(const Arguments& arguments) {
  for (const XiaoGroup& group : xiao_groups(arguments)) {
    Table table(arguments, "xiao_" + group.name + ".csv",
                "noise,method,own_mean_cm,own_deviation_cm,mean_cm,deviation_cm");
    compare(arguments, group, table);
    table.close();
  }
}

const Registration registration("xiao_sparse", experiment);

}  // namespace
}  // namespace kinemend::papers
