// Takes as markers of joints, noise, models and errors, for the experiments of Xiao et al. 2015.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiment.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/model.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/train.hpp"
#include "kinemend/methods.hpp"
#include "kinemend/metrics.hpp"

namespace kinemend::papers {

/// Clips of one action as markers at their joints, for training and tests.
struct XiaoGroup {
  std::string name;
  std::vector<Take> training, tests;
};

struct XiaoNoise {
  std::string name;
  double snr_db = 0;  ///< of Gaussian noise; 0: none
  double share = 0;   ///< of outliers
};

inline std::vector<XiaoNoise> xiao_noises() {
  return {{"40 dB", 40, 0},  {"30 dB", 30, 0},  {"20 dB", 20, 0},
          {"10 dB", 10, 0},  {"10 %", 0, 0.10}, {"15 %", 0, 0.15},
          {"20 %", 0, 0.20}, {"25 %", 0, 0.25}, {"mixed", 20, 0.10}};
}

/// The middle `frames` of a clip, in metres, as markers.
inline Take xiao_markers(const Take& clip, std::size_t frames) {
  const std::size_t count = std::min(frames, clip.frame_count());
  const std::size_t first = (clip.frame_count() - count) / 2;
  const auto unit = guess_length_unit(clip.skeleton);
  return joint_markers(scale_lengths(slice(clip, first, first + count), unit ? unit->metres : 1));
}

inline std::vector<Take> xiao_takes(const Arguments& arguments,
                                    const std::vector<std::string>& names,
                                    const std::string& motion, std::uint64_t first_seed,
                                    std::size_t frames) {
  std::vector<Take> clips;
  for (const std::string& name : names) {
    SynthOptions otherwise{.motion = motion, .duration_s = 3, .frame_rate_hz = 120};
    otherwise.seed = first_seed + clips.size();
    clips.push_back(xiao_markers(load_take(arguments, name + ".bvh", otherwise).clip, frames));
  }
  return clips;
}

/// A damaged take.
struct XiaoDamaged {
  Take clip;
  /// F x M, 1 for the markers that eq. 6 includes: Gaussian noise affects all, outliers those with
  /// a changed entry.
  std::vector<std::uint8_t> noisy;
};

/// The data matrix is assumed to hold positions relative to the root, which do not depend on the
/// laboratory's origin. It defines the power of the signal, and an outlier is 1.4 times one of its
/// entries.
inline XiaoDamaged xiao_noise(Take clip, const XiaoNoise& noise, std::uint64_t seed) {
  const std::size_t markers = clip.marker_count();
  const Take truth = clip;
  const auto from_root = [&](std::size_t i) {
    return truth.positions[i] - truth.positions[i - i % markers];
  };
  double power = 0;
  for (std::size_t i = 0; i < clip.positions.size(); ++i) power += dot(from_root(i), from_root(i));
  power /= 3 * static_cast<double>(clip.positions.size());
  const double deviation =
      noise.snr_db > 0 ? std::sqrt(power / std::pow(10, noise.snr_db / 10)) : 0;
  Random random(seed);
  std::vector<std::uint8_t> noisy(clip.positions.size(), noise.snr_db > 0 ? 1 : 0);
  for (std::size_t i = 0; i < clip.positions.size(); ++i) {
    const Vec3 local = from_root(i);
    const auto outlier = [&] { return random.chance(noise.share) ? 0.4 : 0.0; };
    const Vec3 change{outlier() * local.x, outlier() * local.y, outlier() * local.z};
    if (norm(change) > 0) noisy[i] = 1;
    clip.positions[i] += change;
    clip.positions[i] += deviation * Vec3{random.normal(), random.normal(), random.normal()};
  }
  return {std::move(clip), std::move(noisy)};
}

inline std::shared_ptr<const Model> xiao_model(const std::string& method,
                                               const std::vector<Take>& clips,
                                               const OptionValues& options = {}) {
  TrainingTakes takes;
  takes.count = clips.size();
  takes.take = [&clips](std::size_t i) { return Take(clips[i]); };
  return std::make_shared<const Model>(train_model(method, takes, options));
}

/// Mean and deviation of eq. 6 over frames, metres.
inline MeanAndDeviation xiao_error(const Take& truth, const XiaoDamaged& damaged,
                                   const Take& filtered) {
  return rmse_per_marker(truth.positions, filtered.positions, truth.marker_count(), damaged.noisy);
}
inline MeanAndDeviation xiao_error(const Cleaner& cleaner, const Take& truth,
                                   const XiaoDamaged& damaged) {
  Take filtered = damaged.clip;
  clean_in_place(cleaner, filtered);
  return xiao_error(truth, damaged, filtered);
}

inline std::vector<std::string> numbered(const std::string& subject, int first, int last) {
  std::vector<std::string> names;
  for (int i = first; i <= last; ++i) names.push_back(fmt::format("{}_{:02}", subject, i));
  return names;
}

inline std::vector<std::string> joined(const std::vector<std::vector<std::string>>& lists) {
  std::vector<std::string> names;
  for (const std::vector<std::string>& list : lists)
    names.insert(names.end(), list.begin(), list.end());
  return names;
}

/// The paper's three actions, with four fifths for training. The first test is the paper's own
/// sequence. For basketball there are twelve clips without known defects.
inline std::vector<XiaoGroup> xiao_groups(const Arguments& arguments) {
  const auto group = [&](const std::string& name, const std::string& motion,
                         const std::vector<std::string>& training,
                         const std::vector<std::string>& tests) {
    return XiaoGroup{name, xiao_takes(arguments, training, motion, 1, arguments.quick ? 360 : 3000),
                     xiao_takes(arguments, tests, motion, 101, 150)};
  };
  if (arguments.quick) return {group("run", "run", {"quick_1", "quick_2", "quick_4"}, {"quick_3"})};
  return {
      group("run", "run",
            joined({numbered("09", 5, 9),
                    numbered("35", 17, 21),
                    {"16_35", "16_36", "16_45", "16_46", "38_03", "49_04"}}),
            {"09_04", "35_24"}),
      group("dance", "walk",
            joined(
                {numbered("05", 2, 8), numbered("60", 1, 5), {"05_10", "05_11", "05_12", "49_09"}}),
            {"05_16", "60_08"}),
      group("basketball", "walk", joined({numbered("06", 3, 7), numbered("06", 9, 12), {"06_15"}}),
            {"06_13", "06_14"})};
}

inline OptionValues xiao_training(const Arguments& arguments) {
  if (!arguments.quick) return {{"windows", std::int64_t{10'000}}};
  return {{"atoms", std::int64_t{60}}, {"iterations", std::int64_t{4}}};
}

}  // namespace kinemend::papers
