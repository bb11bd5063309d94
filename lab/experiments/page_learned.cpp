// Figures of README.md and docs that take minutes: the number of clean takes returned bit for bit,
// and learned methods on hold-outs.
#include <algorithm>
#include <memory>
#include <set>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/lab/train.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

std::vector<std::string> names_below(const std::filesystem::path& folder) {
  std::set<std::string> names;
  for (const char* part : {"cmu/bvh", "cmu/bvh-rotations"}) {
    if (!std::filesystem::is_directory(folder / part)) continue;
    for (const auto& entry : std::filesystem::directory_iterator(folder / part))
      names.insert(entry.path().filename().string());
  }
  return {names.begin(), names.end()};
}

// Counts the clean takes that are returned bit for bit, over every fourth take of the library.
void learned_on_clean_takes(const Arguments& arguments) {
  Table table(arguments, "page_clean.csv", "method,takes,unchanged,hardly_changed");
  std::vector<std::string> names;
  const std::vector<std::string> all = names_below(arguments.data);
  for (std::size_t i = 0; i < all.size(); i += arguments.quick ? 80 : 4) names.push_back(all[i]);
  if (names.empty()) names = {"walk", "run", "punch", "wave", "landing"};
  for (const char* method : {"auto", "wiener", "example"}) {
    std::size_t unchanged = 0, hardly = 0;
    for (const std::string& name : names) {
      const Take clip = load_take(arguments, name, {.motion = name}).clip;
      const double change = geodesic_rms_deg(clip, cleaned(clip, method));
      unchanged += change == 0 ? 1 : 0;
      hardly += change > 0 && change < 0.012 ? 1 : 0;
    }
    table.add({method, fmt::format("{}", names.size()), fmt::format("{}", unchanged),
               fmt::format("{}", hardly)});
  }
  table.close();
}

// Takes outside the training of every shipped model.
std::vector<std::string> hold_outs(const Arguments& arguments) {
  std::vector<std::string> names;
  std::ifstream list(arguments.data / "cmu" / "recurrent-100.csv");
  for (std::string line; std::getline(list, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const bool held_out = !line.empty() && line.back() >= '1' && line.back() <= '5';
    if (held_out) names.push_back(line.substr(0, line.find(',')));
  }
  return names;
}

double best_gaussian_error(const Take& truth, const Take& clip) {
  double best = 1e300;
  for (const double width_s :
       {0.006, 0.009, 0.013, 0.018, 0.025, 0.035, 0.045, 0.058, 0.08, 0.11, 0.16})
    best = std::min(best, rms_deg(truth, cleaned(clip, "gaussian", {{"width_s", width_s}})));
  return best;
}

// Errors as a share of that of the best Gaussian; `wiener` uses the given model, or the shipped one
// if it is null.
void shares_of_gaussian(const Arguments& arguments, const std::string& file,
                        const std::vector<std::string>& names,
                        const std::shared_ptr<const Model>& model) {
  Table table(arguments, file, "noise,method,takes,mean,worst");
  const auto wiener = make_wiener({}, model);
  const auto automatic = make_cleaner("auto");
  const std::vector<std::string> noises{"1 degree", "4 degrees and spikes", "half"};
  for (std::size_t n = 0; n < noises.size(); ++n) {
    double mean[2] = {}, worst[2] = {};
    for (const std::string& name : names) {
      const Take truth = load_take(arguments, name + ".bvh", {.motion = name}).clip;
      const Take clip = n == 2 ? damaged(truth, "gaussian-channels", {{"k", 0.5}}, 3)
                               : noisy(truth, n == 0 ? 1 : 4, n == 0 ? 0 : 0.004, 3);
      const double gaussian = best_gaussian_error(truth, clip);
      for (std::size_t m = 0; m < 2; ++m) {
        const double share =
            rms_deg(truth, clean_take(clip, m == 0 ? *automatic : *wiener).take) / gaussian;
        mean[m] += share / static_cast<double>(names.size());
        worst[m] = std::max(worst[m], share);
      }
    }
    for (std::size_t m = 0; m < 2; ++m) {
      table.add({noises[n], m == 0 ? "auto" : "wiener", fmt::format("{}", names.size()),
                 figure(mean[m]), figure(worst[m])});
    }
  }
  table.close();
}

void learned_methods(const Arguments& arguments) {
  std::vector<std::string> names = hold_outs(arguments);
  if (names.empty()) names = {"walk", "run"};
  shares_of_gaussian(arguments, "page_learned.csv", names, nullptr);
}

bool is_dance(const std::string& name) {
  return name.starts_with("05_") || name.starts_with("49_");
}

// Dances, cartwheels and balances of subjects 05 and 49, with a model trained without these
// subjects, the hold-outs and takes with known defects. Without data: a punch, with a model of
// other motions.
void dances(const Arguments& arguments) {
  std::vector<std::string> names, training;
  const std::vector<std::string> held_out = hold_outs(arguments);
  const std::set<std::string> left_out{"07_12", "09_10", "06_02", "01_07",
                                       "03_02", "35_22", "05_16"};
  for (const std::string& file : names_below(arguments.data)) {
    const std::string name = std::filesystem::path(file).stem().string();
    if (std::find(held_out.begin(), held_out.end(), name) != held_out.end()) continue;
    if (is_dance(name))
      names.push_back(name);
    else if (!left_out.contains(name))
      training.push_back(name);
  }
  if (names.empty()) names = {"punch"}, training = {"walk", "run", "jump"};
  TrainingTakes takes;
  takes.count = training.size();
  takes.take = [&](std::size_t i) {
    return Take(load_take(arguments, training[i] + ".bvh", {.motion = training[i]}).clip);
  };
  const auto model = std::make_shared<const Model>(train_model("wiener", takes));
  shares_of_gaussian(arguments, "page_dances.csv", names, model);
}

void page_learned(const Arguments& arguments) {
  learned_on_clean_takes(arguments);
  learned_methods(arguments);
  dances(arguments);
}

const Registration page_learned_entry("page_learned", page_learned);

}  // namespace
}  // namespace kinemend::papers
