// Prints the logarithmic error that a method leaves for several kinds of damage. tools/ablation
// builds this program against the unchanged library and against the library with one change.
//   ablation auto|wiener FOLDER TAKE... [--model FILE]
#include <cmath>
#include <functional>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/methods.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

struct Case {
  std::string name;
  double rate_hz;
  std::function<Take(const Take&)> damage;
  bool is_whole = false;  ///< false: five seconds of each take
};

// Hides an arm for a second in the middle.
Take without_arm(Take clip) {
  clip.observed.assign(clip.rotations.size(), 1);
  const auto half = static_cast<std::size_t>(clip.frame_rate_hz / 2);
  const std::size_t middle = clip.frame_count() / 2;
  for (const char* name : {"LeftArm", "LeftForeArm", "LeftHand"}) {
    const auto joint = static_cast<std::size_t>(clip.skeleton.find(name));
    for (std::size_t f = middle - std::min(half, middle);
         f < middle + half && f < clip.frame_count(); ++f) {
      clip.observed[f * clip.joint_count() + joint] = 0;
      clip.rotation(f, joint) = {};
    }
  }
  return clip;
}

std::vector<Case> cases(bool learned) {
  std::vector<Case> list{
      {"1_deg", 120, [](const Take& c) { return noisy(c, 1, 0, 5); }},
      {"4_deg_spikes", 120, [](const Take& c) { return noisy(c, 4, 0.004, 5); }},
      {"half", 120,
       [](const Take& c) {
         return damaged(c, "gaussian-channels", {{"k", 0.5}}, 5);
       }},
      {"30_Hz_2_deg", 30, [](const Take& c) { return noisy(c, 2, 0, 5); }},
      {"30_Hz_dense", 30, [](const Take& c) { return noisy(c, 1, 0.1, 5); }},
      {"impulses", 120, [](const Take& c) { return damaged(c, "impulse", {}, 5); }},
      {"clean", 120, [](const Take& c) { return c; }},
      {"30_Hz_clean", 30, [](const Take& c) { return c; }}};
  if (!learned) {
    list.push_back({"clean_whole", 120, [](const Take& c) { return c; }, true});
    list.push_back({"30_Hz_impulses", 30, [](const Take& c) {
                      return damaged(c, "impulse", {{"share", 0.004}}, 5);
                    }});
    list.push_back({"outliers", 120, [](const Take& c) { return noisy(c, 0, 0.004, 5); }});
    list.push_back({"0.3_deg_few", 120, [](const Take& c) { return noisy(c, 0.3, 0.001, 5); }});
  }
  if (learned) {
    list.push_back({"30_Hz_20_%", 30, [](const Take& c) { return noisy(c, 1, 0.2, 5); }});
    list.push_back(
        {"arm_missing", 60, [](const Take& c) { return without_arm(noisy(c, 1, 0, 5)); }});
  }
  return list;
}

Take part_of(const Take& clip, const Case& one) {
  const std::size_t most = one.is_whole ? clip.frame_count() : 600;
  const Take part = slice(clip, 0, std::min(clip.frame_count(), most));
  return one.rate_hz == part.frame_rate_hz ? part : resample(part, one.rate_hz);
}

int measure(int count, char** values) {
  const std::string method = values[1];
  Arguments arguments;
  arguments.data = values[2];
  std::vector<std::string> takes;
  std::string model;
  for (int i = 3; i < count; ++i) {
    if (std::string(values[i]) == "--model")
      model = values[++i];
    else
      takes.push_back(values[i]);
  }
  OptionValues options;
  if (!model.empty()) options["model"] = model;
  const auto cleaner = make_cleaner(method, options);
  for (const Case& one : cases(!model.empty())) {
    double sum = 0;
    for (const std::string& name : takes) {
      const Take truth = part_of(load_take(arguments, name + ".bvh", {}).clip, one);
      const Take result = clean_take(one.damage(truth), *cleaner).take;
      // Errors far below a hundredth of a degree do not matter.
      sum += std::log(geodesic_rms_deg(truth, result) + 0.01);
    }
    fmt::print("{} {:.6f}\n", one.name, sum / static_cast<double>(takes.size()));
  }
  return 0;
}

}  // namespace
}  // namespace kinemend::papers

int main(int count, char** values) {
  try {
    return kinemend::papers::measure(count, values);
  } catch (const kinemend::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 3;
  }
}
