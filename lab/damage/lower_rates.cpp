// Damages that show a take as if captured at a lower rate: samples are held, or joined by straight
// lines.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "lab/damage/damage_kind.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

namespace {

// A time between frames: frame + share, with share in [0, 1).
struct Moment {
  std::size_t frame = 0;
  double share = 0;
};

// Times within this share of a frame are that frame, because of rounding.
constexpr double same_frame = 1e-6;

Moment moment_of(double frame, std::size_t frames) {
  const double whole = std::floor(frame + same_frame);
  const double share = frame - whole;
  const auto last = static_cast<double>(frames - 1);
  if (whole >= last) return {frames - 1, 0};
  return {static_cast<std::size_t>(whole), share > same_frame ? share : 0};
}

// A frame as a mixture of the take at two moments.
struct Recipe {
  Moment from, to;
  double share = 0;  // of `to`
};

// Returns the mixture of each frame. `interpolates`: on the line from the last sample of the lower
// rate to the next one, if there is one; otherwise the last sample.
std::vector<Recipe> recipes(std::size_t frames, double samples_per_frame, bool interpolates) {
  std::vector<Recipe> list;
  for (std::size_t f = 0; f < frames; ++f) {
    const double time = static_cast<double>(f) * samples_per_frame;
    const double sample = std::floor(time + same_frame);
    const double next = (sample + 1) / samples_per_frame;
    Recipe recipe;
    recipe.from = recipe.to = moment_of(sample / samples_per_frame, frames);
    if (interpolates && next < static_cast<double>(frames - 1) + same_frame) {
      recipe.to = moment_of(next, frames);
      recipe.share = std::max(0.0, time - sample);
    }
    if (recipe.share < same_frame) recipe.share = 0;
    list.push_back(recipe);
  }
  return list;
}

// Returns the value of a track at a moment, interpolated by `mix(a, b, share)`.
template <class At, class Mix>
auto value_at(Moment moment, const At& at, const Mix& mix) {
  const auto value = at(moment.frame);
  return moment.share > 0 ? mix(value, at(moment.frame + 1), moment.share) : value;
}

template <class At, class Mix>
auto value_of(const Recipe& recipe, const At& at, const Mix& mix) {
  const auto value = value_at(recipe.from, at, mix);
  return recipe.share > 0 ? mix(value, value_at(recipe.to, at, mix), recipe.share) : value;
}

// Whether all samples that a frame is mixed from were seen.
template <class Seen>
bool is_seen(const Recipe& recipe, const Seen& seen) {
  const auto at = [&](Moment m) { return seen(m.frame) && (m.share == 0 || seen(m.frame + 1)); };
  return at(recipe.from) && (recipe.share == 0 || at(recipe.to));
}

// Whether a frame is exactly one of the take's.
bool is_a_frame(const Recipe& recipe) { return recipe.from.share == 0 && recipe.share == 0; }

Vec3 mix_vectors(Vec3 a, Vec3 b, double share) { return a + share * (b - a); }

void resample(Take& clip, const TargetOptions& options, const std::vector<Recipe>& list) {
  const Take truth = clip;
  const auto joints = target_joints(clip.skeleton, options);
  const std::size_t translated = clip.translated_joints.size();
  const bool root = !joints.empty() && joints[0] == 0;
  for (std::size_t f = 0; f < list.size(); ++f) {
    for (const std::size_t j : joints) {
      const auto at = [&](std::size_t g) { return truth.rotation(g, j); };
      const Quat value = value_of(list[f], at, slerp);
      if (is_a_frame(list[f])) {
        clip.rotation(f, j) = value;
      } else {
        set_rotation(clip, f, j, value);
      }
      if (!clip.observed.empty() &&
          !is_seen(list[f], [&](std::size_t g) { return truth.is_observed(g, j); }))
        clip.observed[f * clip.joint_count() + j] = 0;
    }
    if (root)
      clip.root_position(f) = value_of(
          list[f], [&](std::size_t g) { return truth.root_position(g); }, mix_vectors);
    for (std::size_t k = 0; k < translated; ++k) {
      const auto joint = static_cast<std::size_t>(clip.translated_joints[k]);
      if (std::find(joints.begin(), joints.end(), joint) == joints.end()) continue;
      clip.position(f, 1 + k) = value_of(
          list[f], [&](std::size_t g) { return truth.position(g, 1 + k); }, mix_vectors);
    }
  }
}

void resample(VectorMotion& motion, const TargetOptions& options, const std::vector<Recipe>& list) {
  const VectorMotion truth = motion;
  for (const std::size_t n : target_tracks(motion, options)) {
    const auto at = [&](std::size_t g) { return vector_at(truth, g, n); };
    for (std::size_t f = 0; f < list.size(); ++f) {
      if (!is_observed(truth, f, n)) continue;
      if (is_seen(list[f], [&](std::size_t g) { return is_observed(truth, g, n); })) {
        set_vector(motion, f, n, value_of(list[f], at, mix_vectors));
      } else {
        motion.observed[f * motion.track_count() + n] = 0;
      }
    }
  }
}

template <class Motion>
void apply_rate(Motion& motion, const TargetOptions& options, double rate_hz, bool interpolates,
                Notes& notes) {
  if (rate_hz > motion.frame_rate_hz * (1 - same_frame)) {
    notes.push_back(fmt::format("the take has {:g} Hz: no more than {:g} Hz to begin with",
                                motion.frame_rate_hz, rate_hz));
    return;
  }
  resample(motion, options,
           recipes(frame_count(motion), rate_hz / motion.frame_rate_hz, interpolates));
}

struct HeldOptions : TargetOptions {
  double rate_hz = 60;
};

struct UpsampledOptions : TargetOptions {
  double rate_hz = 30;
};

template <class Options>
OptionTable<Options> rate_table() {
  OptionTable<Options> table;
  table.number(&Options::rate_hz, "rate_hz", "Hz", 0.1, 1e5,
               "the lower rate; its first sample is frame 0, samples between frames are "
               "interpolated");
  return add_target_options(table);
}

struct Held {
  static constexpr auto name = "held";
  static constexpr auto summary = "samples of a lower rate, each repeated until the next";
  static constexpr auto paper = "";
  using Options = HeldOptions;
  static const OptionTable<Options>& table() {
    static const auto options = rate_table<Options>();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random&, const Options& options, Notes& notes) {
    apply_rate(motion, options, options.rate_hz, false, notes);
  }
};

struct Upsampled {
  static constexpr auto name = "upsampled";
  static constexpr auto summary =
      "samples of a lower rate, interpolated linearly (the last one held)";
  static constexpr auto paper = "";
  using Options = UpsampledOptions;
  static const OptionTable<Options>& table() {
    static const auto options = rate_table<Options>();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random&, const Options& options, Notes& notes) {
    apply_rate(motion, options, options.rate_hz, true, notes);
  }
};

}  // namespace

void add_lower_rates(std::vector<Damage>& table) {
  table.push_back(entry<Held>());
  table.push_back(entry<Upsampled>());
}

}  // namespace kinemend::corrupt
