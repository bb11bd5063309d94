// Damages that turn each joint by a constant angle, or by a sinusoid over time.

#include "base/portable.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

namespace {

const std::vector<std::string> axis_choices{"random", "x", "y", "z"};

Vec3 axis_of(const std::string& choice, Random& random) {
  if (choice == "x") return {1, 0, 0};
  if (choice == "y") return {0, 1, 0};
  if (choice == "z") return {0, 0, 1};
  Vec3 axis;
  do {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    axis = {x, y, z};
  } while (norm(axis) < 1e-6);
  return (1 / norm(axis)) * axis;
}

struct Bias {
  static constexpr auto name = "bias";
  static constexpr auto summary = "a constant turn of each joint";
  static constexpr auto paper = "Mall et al. 2017, section 4.1";
  struct Options : TargetOptions {
    double bias_deg = 5;
    std::string axis = "random";
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::bias_deg, "bias_deg", "deg", -180, 180, "angle of the turn");
      t.choice(&Options::axis, "axis", axis_choices,
               "its axis in the joint's frame; random: one for each joint");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    if (options.bias_deg == 0) return;
    for (const std::size_t j : target_tracks(motion, options)) {
      Random own = random.fork(j);
      const Vec3 n = options.bias_deg * radians_per_degree * axis_of(options.axis, own);
      for (std::size_t f = 0; f < frame_count(motion); ++f) turn(motion, f, j, n);
    }
  }
};

struct Sinusoid {
  static constexpr auto name = "sinusoid";
  static constexpr auto summary = "a sinusoidally varying turn of each joint";
  static constexpr auto paper = "Mall et al. 2017, section 4.1";
  struct Options : TargetOptions {
    double amplitude_deg = 5;
    double frequency_hz = 0.5;
    std::string axis = "random";
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::amplitude_deg, "amplitude_deg", "deg", 0, 180,
               "largest angle of the turn");
      t.number(&Options::frequency_hz, "frequency_hz", "Hz", 0, 1000,
               "its frequency; the phase of each joint is random");
      t.choice(&Options::axis, "axis", axis_choices,
               "its axis in the joint's frame; random: one for each joint");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    if (options.amplitude_deg == 0) return;
    for (const std::size_t j : target_tracks(motion, options)) {
      Random own = random.fork(j);
      const Vec3 axis = axis_of(options.axis, own);
      const double phase = own.uniform(0, 2 * pi);
      for (std::size_t f = 0; f < frame_count(motion); ++f) {
        const double turns = options.frequency_hz * static_cast<double>(f) / motion.frame_rate_hz;
        const double angle =
            options.amplitude_deg * radians_per_degree * portable::sin(2 * pi * turns + phase);
        turn(motion, f, j, angle * axis);
      }
    }
  }
};

}  // namespace

void add_biases(std::vector<Damage>& table) {
  table.push_back(entry<Bias>());
  table.push_back(entry<Sinusoid>());
}

}  // namespace kinemend::corrupt
