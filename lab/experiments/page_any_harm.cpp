// Figures of docs/measured/learned.md: how much cleaning keeps of real motion, on motions outside
// the model's training.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "compared.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/rotation.hpp"
#include "page.hpp"

namespace kinemend::papers {
namespace {

std::size_t joint_named(const Take& clip, const std::string& name) {
  const auto joint = clip.skeleton.find(name);
  if (joint < 0) throw Error(ErrorKind::usage, "no joint is named " + name);
  return static_cast<std::size_t>(joint);
}

// The smallest remaining share of peak speed, over joints that turn by 200 degrees per second or
// more.
double peak_left(const Take& truth, const Take& result) {
  const auto before = peak_angular_speed_deg_s(truth), after = peak_angular_speed_deg_s(result);
  double least = 1e9;
  for (std::size_t j = 0; j < before.size(); ++j) {
    if (before[j] >= 200) least = std::min(least, after[j] / before[j]);
  }
  return least;
}

// The amplitude of a joint's rotation in `result` relative to that in `truth`.
double swing_left(const Take& truth, const Take& result, std::size_t joint) {
  const Quat reference = truth.rotation(0, joint);
  const auto vectors_of = [&](const Take& clip) {
    std::vector<Vec3> vectors;
    Vec3 mean;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      vectors.push_back(log(conjugate(reference) * clip.rotation(f, joint)));
      mean = mean + (1 / static_cast<double>(clip.frame_count())) * vectors.back();
    }
    for (Vec3& v : vectors) v = v - mean;
    return vectors;
  };
  const std::vector<Vec3> x = vectors_of(truth), y = vectors_of(result);
  double xx = 0, xy = 0;
  for (std::size_t f = 0; f < x.size(); ++f) xx += dot(x[f], x[f]), xy += dot(x[f], y[f]);
  return xy / xx;
}

struct Oscillation {
  std::string name, joint;
  double frequency_hz, amplitude_deg;
};
const std::vector<Oscillation> oscillations{{"tremor", "LeftForeArm", 6, 1},
                                            {"drum roll", "LeftHand", 9, 5},
                                            {"breathing", "Spine", 0.25, 1}};

double phase_at(const Oscillation& motion, const Take& clip, std::size_t frame) {
  return 2 * std::numbers::pi * motion.frequency_hz * static_cast<double>(frame) /
         clip.frame_rate_hz;
}

Take with(const Oscillation& motion, Take clip) {
  const std::size_t joint = joint_named(clip, motion.joint);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double angle =
        radians_per_degree * motion.amplitude_deg * std::sin(phase_at(motion, clip, f));
    clip.rotation(f, joint) = clip.rotation(f, joint) * exp(Vec3{angle, 0, 0});
  }
  return clip;
}

// The share of the oscillation that `result` still has; `clip` has none.
double oscillation_left(const Oscillation& motion, const Take& clip, const Take& result) {
  const std::size_t joint = joint_named(clip, motion.joint);
  double xx = 0, xy = 0;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double x = std::sin(phase_at(motion, clip, f));
    const Vec3 turn = log(conjugate(clip.rotation(f, joint)) * result.rotation(f, joint));
    xx += x * x;
    xy += x * degrees_per_radian * turn.x;
  }
  return xy / xx / motion.amplitude_deg;
}

void page_any_harm(const Arguments& arguments) {
  Table table(arguments, "any_harm.csv", "motion,noise_deg,method,share_left");
  const auto each = [&](const std::string& motion, double noise_deg,
                        const std::function<double(const Compared&)>& share_left) {
    for (const Compared& method : auto_and_learned) {
      const double share = share_left(method);
      fmt::print("{:12} {:.1f} deg  {:12} {:.3f}\n", motion, noise_deg, method.label, share);
      table.add({motion, figure(noise_deg), method.label, figure(share)});
    }
  };
  for (const std::string name : {"punch", "clap", "landing"}) {
    const Take truth = synthesize({.motion = name, .duration_s = 4, .frame_rate_hz = 120});
    for (const double noise_deg : {0.0, 0.5}) {
      const Take clip = noisy(truth, noise_deg, 0, 6);
      each(name, noise_deg,
           [&](const Compared& method) { return peak_left(truth, cleaned(clip, method)); });
    }
  }
  const Take walk = load_take(arguments, "35_01.bvh", {.motion = "walk"}).clip;
  for (const double noise_deg : {0.0, 1.5}) {
    const Take clip = noisy(walk, noise_deg, 0, 6);
    each("arm swing", noise_deg, [&](const Compared& method) {
      return swing_left(walk, cleaned(clip, method), joint_named(walk, "LeftArm"));
    });
  }
  const Take still = load_take(arguments, "49_17.bvh", {.motion = "still"}).clip;
  for (const Oscillation& motion : oscillations) {
    const Take clip = with(motion, still);
    each(motion.name, 0, [&](const Compared& method) {
      return oscillation_left(motion, still, cleaned(clip, method));
    });
  }
  table.close();
}

const Registration page_any_harm_entry("page_any_harm", page_any_harm);

}  // namespace
}  // namespace kinemend::papers
