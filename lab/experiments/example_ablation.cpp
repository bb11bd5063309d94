// Effect of each switch and constant of `example`: the error without it, or with another value,
// relative to the error of the unchanged method, on takes that no other table uses. The takes are
// walks of two subjects with models of them, six takes with a mixed model with or without the
// subjects, and three takes with a model of other motion (kicks).
#include <algorithm>
#include <cmath>
#include <functional>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "lou.hpp"
#include "papers/lou2010_example/example.hpp"

namespace kinemend::papers {
namespace {

struct Variant {
  std::string name;
  ExampleOptions options;
  ExampleTuning tuning;
};

Variant variant(std::string name, const std::function<void(Variant&)>& change) {
  Variant result{std::move(name), {}, {}};
  change(result);
  return result;
}

std::vector<Variant> variants() {
  std::vector<Variant> list = {variant("as it is", [](Variant&) {})};
  const auto add = [&](std::string name, const std::function<void(Variant&)>& change) {
    list.push_back(variant(std::move(name), change));
  };
  add("robust off", [](Variant& v) { v.options.robust = false; });
  add("solver paper", [](Variant& v) { v.options.solver = "paper"; });
  for (const int bases : {50, 100})
    add(fmt::format("bases {}", bases), [=](Variant& v) { v.options.bases = bases; });
  for (const double share : {5.0, 0.01})
    add(fmt::format("tolerance x {}", share), [=](Variant& v) { v.options.tolerance *= share; });
  for (const double p : {2.0, 4.0}) {
    add(fmt::format("welsch_deviations {}", p),
        [=](Variant& v) { v.tuning.welsch_deviations = p; });
  }
  for (const double p : {0.5, 2.0, 3.0}) {
    add(fmt::format("rest_deviations {}", p), [=](Variant& v) { v.tuning.rest_deviations = p; });
  }
  for (const double frames : {1.0, 10.0}) {
    add(fmt::format("rest_memory_frames {}", frames),
        [=](Variant& v) { v.tuning.rest_memory_frames = frames; });
  }
  add("guesses_suspects off", [](Variant& v) { v.tuning.guesses_suspects = false; });
  add("starts_expressible off", [](Variant& v) { v.tuning.starts_expressible = false; });
  add("knows_variances off", [](Variant& v) { v.tuning.knows_variances = false; });
  add("smooths_rest off", [](Variant& v) { v.tuning.smooths_rest = false; });
  add("leaves_strange off", [](Variant& v) { v.tuning.leaves_strange = false; });
  add("leaves_biased off", [](Variant& v) { v.tuning.leaves_biased = false; });
  add("auto", [](Variant&) {});
  return list;
}

bool is_arm_joint(const std::string& name) {
  return name.find("Arm") != std::string::npos || name.find("Hand") != std::string::npos ||
         name.find("Finger") != std::string::npos || name.find("Thumb") != std::string::npos;
}

// Hides the arms in `count` frames from `first` on.
Take without_arms(Take clip, std::size_t first, std::size_t count) {
  clip.observed.assign(clip.rotations.size(), 1);
  for (std::size_t f = first; f < std::min(clip.frame_count(), first + count); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (!is_arm_joint(clip.skeleton.names[j])) continue;
      clip.observed[f * clip.joint_count() + j] = 0;
      clip.rotation(f, j) = {};
    }
  }
  return clip;
}

// Root mean square angle over the missing rotations.
double filling_error(const Take& truth, const Take& damaged, const Take& other) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < damaged.observed.size(); ++i) {
    if (damaged.observed[i] != 0) continue;
    const double angle = angle_between(truth.rotations[i], other.rotations[i]);
    sum += angle * angle, count += 3;
  }
  return degrees_per_radian * std::sqrt(sum / count);
}

struct Condition {
  std::string name;
  std::function<Take(const Take&, std::uint64_t seed)> damaged;
  bool is_filling = false;
};

std::vector<Condition> conditions() {
  const auto noise = [](double deg, double outliers) {
    return
        [=](const Take& clip, std::uint64_t seed) { return lou_noise(clip, deg, outliers, seed); };
  };
  const auto second = [](const Take& clip, std::uint64_t seed) {
    const auto frames = static_cast<std::size_t>(std::lround(clip.frame_rate_hz));
    const std::size_t first = clip.frame_count() > frames ? (clip.frame_count() - frames) / 2 : 0;
    return without_arms(lou_noise(clip, 0.5, 0, seed), first, frames);
  };
  const auto always = [](const Take& clip, std::uint64_t) {
    return without_arms(clip, 0, clip.frame_count());
  };
  return {{"1 deg", noise(1, 0)},  {"4 deg", noise(4, 0)},     {"5 %", noise(1, 0.05)},
          {"20 %", noise(1, 0.2)}, {"1 s arms", second, true}, {"arms", always, true}};
}

struct Group {
  std::shared_ptr<const Model> model;
  std::vector<Take> tests;
};

// The middle five seconds of a take.
Take middle_of(const Take& clip) {
  const auto most = static_cast<std::size_t>(std::lround(5 * clip.frame_rate_hz));
  const std::size_t count = std::min(most, clip.frame_count());
  const std::size_t first = (clip.frame_count() - count) / 2;
  return slice(clip, first, first + count);
}

std::vector<Group> groups(const Arguments& arguments) {
  const auto make = [&](const std::vector<std::string>& training,
                        const std::vector<std::string>& tests) {
    LouGroup group = lou_group(arguments, "", training, tests);
    std::ranges::transform(group.tests, group.tests.begin(), middle_of);
    return Group{learned("example", group.training), std::move(group.tests)};
  };
  std::vector<Group> list;
  list.push_back(make({"16_12", "16_13", "16_19", "16_23", "16_32"}, {"16_18", "16_25", "16_34"}));
  if (arguments.quick) return list;
  list.push_back(make({"35_04", "35_07", "35_11", "35_13", "35_31"}, {"35_06", "35_09", "35_32"}));
  list.push_back(make({"01_02",  "01_08",  "02_07",  "02_06", "03_01", "03_04", "05_07", "05_12",
                       "06_03",  "06_09",  "09_05",  "09_11", "10_02", "10_05", "11_01", "14_20",
                       "131_01", "131_06", "131_10", "49_08", "49_10", "49_16", "49_21"},
                      {"14_14", "135_03", "135_08", "10_04", "16_20", "131_12"}));
  list.push_back(make({"10_02", "10_05", "11_01"}, {"16_20", "131_12", "35_32"}));
  return list;
}

// AblationErrors by condition and take.
using AblationErrors = std::vector<std::vector<double>>;

AblationErrors errors_of(const std::vector<Group>& tried, const Variant& v) {
  AblationErrors errors;
  for (const Condition& condition : conditions()) {
    errors.emplace_back();
    for (const Group& group : tried) {
      const auto cleaner =
          v.name == "auto" ? make_auto() : make_tuned_example(v.options, group.model, v.tuning);
      for (const Take& truth : group.tests) {
        const Take damaged = condition.damaged(truth, 1);
        const Take result = cleaned(*cleaner, damaged);
        errors.back().push_back(condition.is_filling ? filling_error(truth, damaged, result)
                                                     : rms_deg(truth, result));
      }
    }
  }
  return errors;
}

// Mean logarithm of the error ratio over takes `first` to `last`, as a percentage.
double change(const AblationErrors& errors, const AblationErrors& usual, std::size_t first,
              std::size_t last) {
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < errors.size(); ++c) {
    for (std::size_t i = first; i < last; ++i) {
      sum += std::log(errors[c][i] / usual[c][i]);
      count += 1;
    }
  }
  return 100 * std::expm1(sum / count);
}

double mean_of(const std::vector<double>& errors, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += errors[i] / static_cast<double>(count);
  return sum;
}

void ablation(const Arguments& arguments) {
  const std::vector<Group> tried = groups(arguments);
  Table table(arguments, "example_ablation.csv", "variant,condition,change_percent");
  std::vector<std::string> columns;
  for (const Condition& condition : conditions()) columns.push_back(condition.name);
  columns.insert(columns.end(), {"all", "misfit"});
  fmt::print(
      "Change of the error in percent, mean over takes; first the error itself, degrees. misfit: a "
      "model of kicks on\nwalks and a dance.\n\n");
  const TextTable text(columns);
  const std::size_t misfits = tried.size() > 1 ? tried.back().tests.size() : 0;
  AblationErrors usual;
  for (const Variant& v : variants()) {
    const AblationErrors errors = errors_of(tried, v);
    const std::size_t takes = errors[0].size(), fits = takes - misfits;
    std::vector<double> row;
    for (std::size_t c = 0; c < errors.size(); ++c) {
      row.push_back(usual.empty() ? mean_of(errors[c], fits)
                                  : change({errors[c]}, {usual[c]}, 0, fits));
    }
    if (usual.empty()) usual = errors;
    row.push_back(change(errors, usual, 0, fits));
    row.push_back(misfits > 0 ? change(errors, usual, fits, takes) : 0);
    for (std::size_t c = 0; c < row.size(); ++c)
      table.add({"\"" + v.name + "\"", "\"" + columns[c] + "\"", fmt::format("{:.4g}", row[c])});
    text.add(v.name, row);
  }
  table.close();
}

const Registration example_ablation_entry("example_ablation", ablation);

}  // namespace
}  // namespace kinemend::papers
