// Builds each method with its settings, fits the models, and chooses the setting with the least
// error.
#include "xiao_methods.hpp"

#include <algorithm>
#include "kinemend/extend/method_options.hpp"

namespace kinemend::papers {

namespace {

// Settings are chosen with fewer windows to save time.
constexpr std::size_t tuning_hop = 4;

XiaoFilter cleaner_filter(std::unique_ptr<Cleaner> cleaner) {
  return [cleaner = std::shared_ptr<const Cleaner>(std::move(cleaner))](Take noisy, const Take&) {
    clean_in_place(*cleaner, noisy);
    return noisy;
  };
}

// A method with the same settings for every noise.
template <class Add>
XiaoMethod of_any_noise(const std::string& name, const Add& add_all) {
  return {name, [=](const XiaoNoise&) {
            std::vector<XiaoSetting> settings;
            add_all([&settings](const std::string& setting, const auto& make) {
              settings.push_back({setting, [=](const XiaoModels& models) {
                                    return cleaner_filter(make(models));
                                  }});
            });
            return settings;
          }};
}

XiaoMethod xiao_gaussian() {
  return of_any_noise("gaussian", [](const auto& add) {
    for (const double width_s : {0.005, 0.008, 0.012, 0.016, 0.022, 0.03, 0.05, 0.08})
      add(fmt::format("{} s", width_s),
          [=](const XiaoModels&) { return make_gaussian({width_s}); });
  });
}

XiaoMethod xiao_wavelet() {
  return of_any_noise("wavelet", [](const auto& add) {
    for (const char* family : {"db4", "sym8"}) {
      for (const char* threshold : {"sure", "universal"}) {
        for (const char* shrinkage : {"soft", "hard"})
          add(fmt::format("{} {} {}", family, threshold, shrinkage), [=](const XiaoModels&) {
            return make_wavelet({family, threshold, shrinkage});
          });
      }
    }
  });
}

// The paper's filter is causal; the smoother makes it stronger.
XiaoMethod xiao_kalman() {
  return of_any_noise("kalman", [](const auto& add) {
    for (const char* model : {"position", "velocity"}) {
      for (const bool smoother : {false, true}) {
        for (const double agility : {0.05, 0.2, 1.0, 4.0})
          add(fmt::format("{} {} {}", model, smoother ? "smoother" : "filter", agility),
              [=](const XiaoModels&) {
                return make_kalman({.model = model, .smoother = smoother, .agility = agility});
              });
      }
    }
  });
}

// The paper's parameters are the window, K and p; by default, the last two come from noise and
// model. Its solver is tried with the middle window.
XiaoMethod xiao_example(const Arguments& arguments) {
  return of_any_noise("example", [=](const auto& add) {
    for (std::size_t w = 0; w < xiao_windows_s(arguments).size(); ++w) {
      const std::string window = fmt::format("{:.2f} s", xiao_windows_s(arguments)[w]);
      const auto add_one = [&](const std::string& name, const ExampleOptions& options) {
        add(window + " " + name,
            [=](const XiaoModels& models) { return make_example(options, models.example[w]); });
      };
      add_one("own", {});
      if (w != xiao_windows_s(arguments).size() / 2) continue;
      for (const double welsch_deg : arguments.quick ? std::vector{3.0} : std::vector{3.0, 7.0}) {
        ExampleOptions options;
        options.solver = "paper";
        options.welsch_deg = welsch_deg;
        add_one(fmt::format("paper p {}", welsch_deg), options);
      }
    }
  });
}

// The kind of noise is known, as in the paper.
XiaoMethod xiao_sparse() {
  return {"sparse", [](const XiaoNoise& noise) {
            const std::vector<double> all{0.02, 0.1, 0.3}, dense{0.1};
            std::vector<XiaoSetting> settings;
            for (std::size_t w = 0; w < xiao_sparse_windows.size(); ++w) {
              for (const double lambda : noise.share > 0 ? dense : all) {
                SparseOptions options;
                options.loss = noise.share > 0 ? "mixed" : "l2";
                options.lambda = lambda;
                settings.push_back(
                    {fmt::format("M {} {} {}", xiao_sparse_windows[w], options.loss, lambda),
                     [=](const XiaoModels& models) {
                       return cleaner_filter(make_sparse(options, models.sparse[w]));
                     }});
              }
            }
            return settings;
          }};
}

// The kind of noise determines the equation; lambda is from the paper's grid.
std::vector<XiaoPaperSettings> paper_settings(const XiaoNoise& noise) {
  std::vector<XiaoPaperSettings> settings;
  if (noise.share == 0) {
    for (const double lambda : {0.01, 0.1, 1.0, 10.0})
      settings.push_back({.loss = XiaoPaperLoss::squares, .lambda_squares = lambda});
  } else if (noise.snr_db == 0) {
    for (const double lambda : {0.1, 1.0})
      settings.push_back({.loss = XiaoPaperLoss::absolute, .lambda_absolute = lambda});
  } else {
    for (const double first : {0.1, 1.0}) {
      for (const double second : {0.1, 1.0})
        settings.push_back(
            {.loss = XiaoPaperLoss::sequence, .lambda_squares = second, .lambda_absolute = first});
    }
  }
  return settings;
}

std::string name_of(const XiaoPaperSizes& sizes, const XiaoPaperSettings& settings) {
  std::string text = fmt::format("M {} K {}", sizes.window_frames, sizes.atoms);
  if (settings.loss != XiaoPaperLoss::squares)
    text += fmt::format(" l1 lambda {}", settings.lambda_absolute);
  if (settings.loss != XiaoPaperLoss::absolute)
    text += fmt::format(" l2 lambda {}", settings.lambda_squares);
  return text;
}

XiaoMethod xiao_algorithm(bool has_true_frames, const XiaoPaperSizes& sizes) {
  const auto filter_of = [=](const XiaoPaperSettings& one) {
    return [=](const XiaoModels& models) {
      return [=](const Take& noisy, const Take& truth) {
        return models.paper->filtered(noisy, has_true_frames ? truth : noisy, one,
                                      models.paper_hop);
      };
    };
  };
  return {has_true_frames ? "paper true frames" : "paper",
          [=](const XiaoNoise& noise) {
            std::vector<XiaoSetting> settings;
            for (const XiaoPaperSettings& one : paper_settings(noise))
              settings.push_back({name_of(sizes, one), filter_of(one)});
            return settings;
          },
          true};
}

double error_on(const XiaoFilter& filter, const std::vector<Take>& clips,
                const std::vector<XiaoDamaged>& damaged) {
  double sum = 0;
  for (std::size_t c = 0; c < clips.size(); ++c)
    sum += xiao_error(clips[c], damaged[c], filter(damaged[c].clip, clips[c])).mean;
  return sum;
}

std::vector<XiaoDamaged> tuning_noise(const std::vector<Take>& clips, const XiaoNoise& noise) {
  std::vector<XiaoDamaged> damaged;
  for (const Take& clip : clips) damaged.push_back(xiao_noise(clip, noise, 1000 + damaged.size()));
  return damaged;
}

}  // namespace

std::vector<XiaoMethod> xiao_methods(const Arguments& arguments, const XiaoPaperSizes& sizes) {
  XiaoMethod automatic = of_any_noise(
      "auto", [](const auto& add) { add("", [](const XiaoModels&) { return make_auto(); }); });
  return {xiao_gaussian(),
          xiao_wavelet(),
          xiao_kalman(),
          xiao_example(arguments),
          xiao_sparse(),
          std::move(automatic),
          xiao_algorithm(false, sizes),
          xiao_algorithm(true, sizes)};
}

XiaoModels xiao_models(const Arguments& arguments, const std::vector<Take>& clips,
                       const XiaoPaperSizes& sizes) {
  XiaoModels models{{}, {}, std::make_shared<const XiaoPaper>(clips, sizes)};
  for (const std::int64_t frames : xiao_sparse_windows) {
    OptionValues options = xiao_training(arguments);
    options["window_frames"] = frames;
    models.sparse.push_back(xiao_model("sparse", clips, options));
  }
  for (const double window_s : xiao_windows_s(arguments))
    models.example.push_back(xiao_model("example", clips, {{"window_s", window_s}}));
  return models;
}

XiaoFold xiao_fold(const XiaoGroup& group) {
  XiaoFold fold;
  const std::size_t count = group.training.size();
  for (std::size_t i = 0; i < count; ++i) {
    const Take& clip = group.training[i];
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

XiaoSetting xiao_tuned(const XiaoMethod& method, XiaoModels models, const std::vector<Take>& clips,
                       const XiaoNoise& noise) {
  models.paper_hop = tuning_hop;
  const std::vector<XiaoSetting> settings = method.settings(noise);
  if (settings.size() == 1) return settings.front();
  const std::vector<XiaoDamaged> damaged = tuning_noise(clips, noise);
  std::vector<double> errors;
  for (const XiaoSetting& setting : settings)
    errors.push_back(error_on(setting.make(models), clips, damaged));
  return settings[static_cast<std::size_t>(std::ranges::min_element(errors) - errors.begin())];
}

XiaoPaperSizes xiao_paper_sizes(const Arguments& arguments, const XiaoFold& fold) {
  if (arguments.quick) return {.window_frames = 9, .atoms = 60, .windows = 500, .iterations = 3};
  XiaoPaperSizes best{.windows = 5000, .iterations = 6};
  const XiaoNoise noise{"20 dB", 20, 0};
  const std::vector<XiaoDamaged> damaged = tuning_noise(fold.tuning, noise);
  double least = 1e300;
  for (const std::size_t window_frames : {9U, 15U, 27U}) {
    const XiaoPaperSizes sizes{.window_frames = window_frames, .windows = 2000, .iterations = 3};
    const XiaoModels models{
        {}, {}, std::make_shared<const XiaoPaper>(fold.training, sizes), tuning_hop};
    for (const XiaoSetting& setting : xiao_algorithm(true, sizes).settings(noise)) {
      const double error = error_on(setting.make(models), fold.tuning, damaged);
      if (error < least) least = error, best.window_frames = window_frames;
    }
  }
  return best;
}

}  // namespace kinemend::papers
