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

// A method that tries all of its settings.
template <class Settings>
XiaoMethod method_with(const std::string& name, const Settings& settings_for) {
  return {name,
          [=](const XiaoModels& models, const std::vector<Take>& clips, const XiaoNoise& noise) {
            const std::vector<XiaoSetting> settings = settings_for(noise);
            if (settings.size() == 1) return settings.front();
            const std::vector<XiaoDamaged> damaged = tuning_noise(clips, noise);
            std::vector<double> errors;
            for (const XiaoSetting& setting : settings)
              errors.push_back(error_on(setting.make(models), clips, damaged));
            const auto best = std::ranges::min_element(errors) - errors.begin();
            return settings[static_cast<std::size_t>(best)];
          }};
}

// A method with the same settings for every noise.
template <class Add>
XiaoMethod of_any_noise(const std::string& name, const Add& add_all) {
  return method_with(name, [=](const XiaoNoise&) {
    std::vector<XiaoSetting> settings;
    add_all([&settings](const std::string& setting, const auto& make) {
      settings.push_back(
          {setting, [=](const XiaoModels& models) { return cleaner_filter(make(models)); }});
    });
    return settings;
  });
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
  return method_with("sparse", [](const XiaoNoise& noise) {
    const std::vector<double> all{0.02, 0.1, 0.3}, dense{0.1};
    std::vector<XiaoSetting> settings;
    for (std::size_t w = 0; w < xiao_sparse_windows.size(); ++w) {
      for (const double lambda : noise.share > 0 ? dense : all) {
        SparseOptions options;
        options.loss = noise.share > 0 ? "mixed" : "l2";
        options.lambda = lambda;
        settings.push_back({fmt::format("M {} {} {}", xiao_sparse_windows[w], options.loss, lambda),
                            [=](const XiaoModels& models) {
                              return cleaner_filter(make_sparse(options, models.sparse[w]));
                            }});
      }
    }
    return settings;
  });
}

// The poses whose local coordinates Algorithm 1 uses; the paper does not state them.
enum class XiaoFrames : std::uint8_t {
  noisy,   // those of the noisy take: noise came before the change of coordinates
  steady,  // the same after a running median and a running mean
  truth,   // those of the ground truth: noise came after the change of coordinates
};

// A value of each coordinate of the paper's grid. A search moves from the middle of the lists; at
// an end of one it goes on by the same step, so that no choice lies on the edge of what was tried.
struct PaperChoice {
  XiaoPaperSettings settings;
  int window_frames = 0, atoms = 0, steady_frames = 1;
};

// The paper's: M of 9 to 39 in steps of 6, K of 500 to 1000 (in steps of 50; here 250), and powers
// of ten for lambda.
constexpr int window_step = 6, atom_step = 250, steady_step = 4, least_window = 9,
              least_atoms = 250;
constexpr double lambda_step = 10;

std::string name_of(const PaperChoice& choice) {
  std::string text = fmt::format("M {} K {}", choice.window_frames, choice.atoms);
  if (choice.steady_frames > 1) text += fmt::format(" steady {}", choice.steady_frames);
  if (choice.settings.loss != XiaoPaperLoss::squares)
    text += fmt::format(" l1 lambda {}", choice.settings.lambda_absolute);
  if (choice.settings.loss != XiaoPaperLoss::absolute)
    text += fmt::format(" l2 lambda {}", choice.settings.lambda_squares);
  return text;
}

// The kind of noise determines the equation.
XiaoPaperLoss loss_for(const XiaoNoise& noise) {
  if (noise.share == 0) return XiaoPaperLoss::squares;
  return noise.snr_db == 0 ? XiaoPaperLoss::absolute : XiaoPaperLoss::sequence;
}

XiaoSetting setting_of(const PaperChoice& choice, XiaoFrames frames) {
  return {name_of(choice), [=](const XiaoModels& models) {
            return [=](const Take& noisy, const Take& truth) {
              const Take posed =
                  frames == XiaoFrames::truth
                      ? truth
                      : steady_take(noisy, static_cast<std::size_t>(choice.steady_frames));
              return models.papers
                  ->of(static_cast<std::size_t>(choice.window_frames),
                       static_cast<std::size_t>(choice.atoms))
                  .filtered(noisy, posed, choice.settings, models.paper_hop);
            };
          }};
}

// Steps of one coordinate, back or forth; false below its least value.
using PaperStep = std::function<bool(PaperChoice&, bool is_up)>;

bool step_by(int& value, int step, int least, bool is_up) {
  value += is_up ? step : -step;
  return value >= least;
}

bool step_lambda(double& lambda, bool is_up) {
  // Rounding keeps powers of ten as they are printed.
  lambda = std::stod(fmt::format("{:.3g}", is_up ? lambda * lambda_step : lambda / lambda_step));
  return true;
}

std::vector<PaperStep> paper_steps(const Arguments& arguments, const XiaoNoise& noise,
                                   XiaoFrames frames) {
  const XiaoPaperLoss loss = loss_for(noise);
  std::vector<PaperStep> steps;
  if (loss != XiaoPaperLoss::squares)
    steps.emplace_back(
        [](PaperChoice& c, bool up) { return step_lambda(c.settings.lambda_absolute, up); });
  if (loss != XiaoPaperLoss::absolute)
    steps.emplace_back(
        [](PaperChoice& c, bool up) { return step_lambda(c.settings.lambda_squares, up); });
  if (frames == XiaoFrames::steady)
    steps.emplace_back(
        [](PaperChoice& c, bool up) { return step_by(c.steady_frames, steady_step, 1, up); });
  if (arguments.quick) return steps;
  steps.emplace_back([](PaperChoice& c, bool up) {
    return step_by(c.window_frames, window_step, least_window, up);
  });
  steps.emplace_back(
      [](PaperChoice& c, bool up) { return step_by(c.atoms, atom_step, least_atoms, up); });
  return steps;
}

// Coordinate search: walks along each coordinate in turn as long as the error falls by more than a
// share of it, until none moves.
PaperChoice search(PaperChoice choice, const std::vector<PaperStep>& steps,
                   const std::function<double(const PaperChoice&)>& error_of) {
  constexpr double least_gain = 0.005;
  double least = error_of(choice);
  for (bool has_moved = true; has_moved;) {
    has_moved = false;
    for (const PaperStep& step : steps) {
      for (const bool is_up : {true, false}) {
        for (PaperChoice next = choice; step(next, is_up); next = choice) {
          const double error = error_of(next);
          if (error >= (1 - least_gain) * least) break;
          choice = next, least = error, has_moved = true;
        }
      }
    }
  }
  return choice;
}

XiaoMethod xiao_algorithm(const Arguments& arguments, const std::string& name, XiaoFrames frames) {
  return {
      name,
      [=](const XiaoModels& models, const std::vector<Take>& clips, const XiaoNoise& noise) {
        XiaoModels with_fewer_windows = models;
        with_fewer_windows.paper_hop = tuning_hop;
        const std::vector<XiaoDamaged> damaged = tuning_noise(clips, noise);
        const XiaoPaperSizes sizes = xiao_paper_sizes(arguments);
        PaperChoice choice{.settings = {.loss = loss_for(noise)},
                           .window_frames = static_cast<int>(sizes.window_frames),
                           .atoms = static_cast<int>(sizes.atoms)};
        if (frames == XiaoFrames::steady) choice.steady_frames = 1 + 2 * steady_step;
        choice =
            search(choice, paper_steps(arguments, noise, frames), [&](const PaperChoice& tried) {
              return error_on(setting_of(tried, frames).make(with_fewer_windows), clips, damaged);
            });
        return setting_of(choice, frames);
      },
      true};
}

}  // namespace

std::vector<XiaoMethod> xiao_methods(const Arguments& arguments) {
  XiaoMethod automatic = of_any_noise(
      "auto", [](const auto& add) { add("", [](const XiaoModels&) { return make_auto(); }); });
  return {xiao_gaussian(),
          xiao_wavelet(),
          xiao_kalman(),
          xiao_example(arguments),
          xiao_sparse(),
          std::move(automatic),
          xiao_algorithm(arguments, "paper", XiaoFrames::noisy),
          xiao_algorithm(arguments, "paper steady frames", XiaoFrames::steady),
          xiao_algorithm(arguments, "paper true frames", XiaoFrames::truth)};
}

XiaoPaperSizes xiao_paper_sizes(const Arguments& arguments) {
  if (arguments.quick) return {.window_frames = 9, .atoms = 60, .windows = 500, .iterations = 3};
  return {.window_frames = 27, .atoms = 500, .windows = 5000, .iterations = 6};
}

XiaoModels xiao_models(const Arguments& arguments, const std::vector<Take>& clips, bool is_tuning) {
  XiaoPaperSizes sizes = xiao_paper_sizes(arguments);
  if (is_tuning) sizes.iterations = 3;
  XiaoModels models{{}, {}, std::make_shared<XiaoPapers>(clips, sizes)};
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

}  // namespace kinemend::papers
