// Figures of README.md and docs about joints: methods on synthetic takes, `auto` on damaged takes.
#include <algorithm>
#include <array>

#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

// Every method on synthetic takes of 6 s at 120 Hz, as shown on its page.
void methods_on_own_takes(const Arguments& arguments) {
  Table table(arguments, "page_methods.csv", "method,damage,walk,run,punch");
  const std::vector<std::pair<std::string, std::pair<double, double>>> damages{
      {"0.3", {0.3, 0}}, {"1.5", {1.5, 0}}, {"outliers", {0, 0.01}}};
  std::array<Take, 3> truths;
  const std::array<const char*, 3> motions{"walk", "run", "punch"};
  for (std::size_t m = 0; m < 3; ++m) truths[m] = synthesize({.motion = motions[m]});
  const auto add = [&](const std::string& name, const auto& clean) {
    for (const auto& [damage, sizes] : damages) {
      std::vector<std::string> cells{name, damage};
      for (const Take& truth : truths) {
        const Take clip = noisy(truth, sizes.first, sizes.second, 7);
        cells.push_back(figure(geodesic_rms_deg(truth, clean(clip))));
      }
      table.add(cells);
    }
  };
  add("before", [](const Take& clip) { return clip; });
  for (const Method& method : methods()) {
    if (!method.learned) add(method.name, [&](const Take& c) { return cleaned(c, method.name); });
  }
  add("live kalman", [](const Take& c) { return cleaned(c, "kalman", {{"smoother", false}}); });
  table.close();
}

// White noise of 1.5 degrees and 0.4 % outliers, cleaned by `auto` and by its users' scripts.
void damaged_takes(const Arguments& arguments) {
  Table table(arguments, "page_auto.csv", "take,way,rms_deg,p99_deg");
  const std::uint64_t seeds = arguments.quick ? 2 : 40;
  for (const auto& [name, motion] :
       {std::pair{"35_01", "walk"}, std::pair{"02_05", "punch"}, std::pair{"09_03", "run"}}) {
    const std::string take = name;  // a copy that a lambda can capture
    const Take truth = load_take(arguments, take + ".bvh", {.motion = motion}).clip;
    const auto add = [&](const std::string& way, const auto& clean) {
      double rms = 0, p99 = 0, worst_rms = 0, worst_p99 = 0;
      for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const Take result = clean(noisy(truth, 1.5, 0.004, seed));
        const double r = geodesic_rms_deg(truth, result),
                     p = geodesic_percentile_deg(truth, result, 99);
        rms += r / static_cast<double>(seeds), p99 += p / static_cast<double>(seeds);
        worst_rms = std::max(worst_rms, r), worst_p99 = std::max(worst_p99, p);
      }
      table.add({take, way, figure(rms), figure(p99)});
      if (way == "auto") table.add({take, "worst", figure(worst_rms), figure(worst_p99)});
    };
    add("noisy", [](const Take& clip) { return clip; });
    add("blender", [](const Take& c) {
      return cleaned(c, "weighted-mean", {{"passes", std::int64_t{4}}});
    });
    add("butterworth", [](const Take& c) {
      return cleaned(c, "butterworth", {{"cutoff_hz", 6.0}});
    });
    add("despiked", [](const Take& c) {
      return cleaned(cleaned(c, "hampel"), "butterworth", {{"cutoff_hz", 10.0}});
    });
    add("auto", [](const Take& c) { return cleaned(c, "auto"); });
  }
  table.close();
}

Take of_the_world(const Take& clip) {
  Take result = clip;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t j = 0; j < clip.joint_count(); ++j) result.rotation(f, j) = pose.rotations[j];
  }
  return result;
}

// The difference between filtering local and world rotations, as world rotations, half a second or
// more from the ends.
std::vector<std::string> difference_of_frames(const Take& clip, const Cleaner& cleaner) {
  Take local = clip, global = of_the_world(clip);
  clean_in_place(cleaner, local);
  clean_in_place(cleaner, global);
  const auto margin = static_cast<std::size_t>(clip.frame_rate_hz / 2);
  const std::size_t last = clip.frame_count() - margin;
  local = slice(of_the_world(local), margin, last);
  global = slice(global, margin, last);
  double largest = 0;
  std::size_t joint = 0;
  for (std::size_t i = 0; i < local.rotations.size(); ++i) {
    const double angle = angle_between(local.rotations[i], global.rotations[i]);
    if (angle > largest) largest = angle, joint = i % clip.joint_count();
  }
  return {clip.skeleton.names[joint], figure(degrees_per_radian * largest),
          figure(geodesic_rms_deg(local, global))};
}

// Filters joints relative to their parents or to the world: the bilateral filter gives the same in
// frames at rest, but not in frames of turning parents.
void frames_of_joints(const Arguments& arguments) {
  Table table(arguments, "page_frames.csv", "take,setting,noise_deg,joint,largest_deg,rms_deg");
  const auto add = [&](const std::string& take, const Take& clip) {
    const BilateralOptions usual, papers{1 / clip.frame_rate_hz, 11.46, 5, "mirror"};
    for (const double noise_deg : {0.0, 1.5}) {
      const Take damaged = noisy(clip, noise_deg, 0, 7);
      for (const bool is_papers : {false, true}) {
        std::vector<std::string> cells{take, is_papers ? "paper" : "default",
                                       fmt::format("{}", noise_deg)};
        const auto found =
            difference_of_frames(damaged, *make_bilateral(is_papers ? papers : usual));
        cells.insert(cells.end(), found.begin(), found.end());
        table.add(cells);
      }
    }
  };
  for (const char* motion : {"walk", "run"}) add(motion, synthesize({.motion = motion}));
  for (const char* name : {"02_05", "09_03", "05_02", "16_01"}) {
    if (!find_take(arguments.data, std::string(name) + ".bvh")) continue;
    add(name, load_take(arguments, std::string(name) + ".bvh", {}).clip);
  }
  table.close();
}

// Correlated noise: the remaining error for jitter with a correlation of 0.5 between frames.
void correlated_noise(const Arguments& arguments) {
  Table table(arguments, "page_jitter.csv", "take,noisy,best_gaussian,auto,wiener");
  for (const auto& [name, motion] :
       {std::pair{"35_01", "walk"}, std::pair{"02_05", "punch"}, std::pair{"09_03", "run"}}) {
    const Take truth = load_take(arguments, std::string(name) + ".bvh", {.motion = motion}).clip;
    const Take clip = damaged(truth, "ar1", {{"std_deg", 1.5}, {"correlation", 0.5}}, 7);
    double best = 1e300;
    for (const double width_s : {0.01, 0.015, 0.02, 0.03, 0.045, 0.06, 0.08}) {
      const Take smooth = cleaned(clip, "gaussian", {{"width_s", width_s}});
      best = std::min(best, geodesic_rms_deg(truth, smooth));
    }
    table.add({name, figure(geodesic_rms_deg(truth, clip)), figure(best),
               figure(geodesic_rms_deg(truth, cleaned(clip, "auto"))),
               figure(geodesic_rms_deg(truth, cleaned(clip, "wiener")))});
  }
  table.close();
}

void page_joints(const Arguments& arguments) {
  correlated_noise(arguments);
  frames_of_joints(arguments);
  methods_on_own_takes(arguments);
  damaged_takes(arguments);
}

const Registration page_joints_entry("page_joints", page_joints);

}  // namespace
}  // namespace kinemend::papers
