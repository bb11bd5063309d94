// Damages that add noise to rotations: white, correlated over time, or proportional to the motion
// of each channel.
#include <algorithm>
#include <cmath>
#include <functional>

#include "base/portable.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/normal_vector.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

namespace {

// Channels that turn less over a take are constant except for rounding.
constexpr double moving_range = 0.001 * radians_per_degree;

// Sets q <- q Exp(n(f)) for every frame of every joint; `noise` draws from the joint's own
// generator, frame after frame.
template <class Motion>
void turn_each(Motion& motion, const Random& random, const TargetOptions& options,
               const std::function<Vec3(Random&)>& noise) {
  for (const std::size_t j : target_tracks(motion, options)) {
    Random own = random.fork(j);
    for (std::size_t f = 0; f < frame_count(motion); ++f) {
      const Vec3 n = noise(own);
      if (!(n == Vec3{})) turn(motion, f, j, n);
    }
  }
}

struct Gaussian {
  static constexpr auto name = "gaussian";
  static constexpr auto summary = "white Gaussian noise about each axis, in degrees";
  static constexpr auto paper = "Lou & Chai 2010, section 4.2";
  struct Options : TargetOptions {
    double std_deg = 1.5;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::std_deg, "std_deg", "deg", 0, 180,
               "standard deviation about each axis: q Exp(n)");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double deviation = options.std_deg * radians_per_degree;
    turn_each(motion, random, options, [&](Random& own) { return deviation * normal_vector(own); });
  }
};

struct Uniform {
  static constexpr auto name = "uniform";
  static constexpr auto summary = "white uniform noise about each axis, in degrees";
  static constexpr auto paper = "Mall et al. 2017, section 4.1";
  struct Options : TargetOptions {
    double half_width_deg = 3;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::half_width_deg, "half_width_deg", "deg", 0, 180,
               "each component of the rotation vector lies within this of zero");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double half = options.half_width_deg * radians_per_degree;
    turn_each(motion, random, options, [&](Random& own) {
      const double x = own.uniform(-half, half), y = own.uniform(-half, half),
                   z = own.uniform(-half, half);
      return Vec3{x, y, z};
    });
  }
};

struct GaussianLog {
  static constexpr auto name = "gaussian-log";
  static constexpr auto summary =
      "white Gaussian noise on the logarithm of the quaternion, in radians";
  static constexpr auto paper = "Dean 2016, section IV; Courty 2008, section 5";
  struct Options : TargetOptions {
    double sigma = 0.12;
    std::string about = "identity";
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::sigma, "sigma", "rad", 0, 100,
               "standard deviation of each component of the logarithm, which is half the rotation "
               "vector");
      t.choice(&Options::about, "about", {"identity", "sample"},
               "identity: the logarithm of the pose itself (Dean); sample: of the turn away from "
               "it (Courty)");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes&) {
    const double deviation = 2 * options.sigma;
    if (options.about == "sample") {
      turn_each(clip, random, options, [&](Random& own) { return deviation * normal_vector(own); });
      return;
    }
    for (const std::size_t j : target_joints(clip.skeleton, options)) {
      Random own = random.fork(j);
      for (std::size_t f = 0; f < clip.frame_count(); ++f) {
        const Vec3 n = deviation * normal_vector(own);
        if (!(n == Vec3{})) set_rotation(clip, f, j, exp(log(clip.rotation(f, j)) + n));
      }
    }
  }
};

// Returns the standard deviation over frames of each channel; 0 for one that moves less than
// `moving`.
std::array<double, 3> channel_deviations(const std::vector<std::array<double, 3>>& track,
                                         std::size_t channels, double moving = moving_range) {
  std::array<double, 3> deviations{};
  if (track.empty()) return deviations;
  const auto frames = static_cast<double>(track.size());
  for (std::size_t c = 0; c < channels; ++c) {
    double mean = 0, square = 0, least = track[0][c], most = track[0][c];
    for (const auto& angles : track) {
      mean += angles[c] / frames;
      least = std::min(least, angles[c]);
      most = std::max(most, angles[c]);
    }
    for (const auto& angles : track) square += (angles[c] - mean) * (angles[c] - mean) / frames;
    if (most - least > moving) deviations[c] = std::sqrt(square);
  }
  return deviations;
}

struct GaussianChannels {
  static constexpr auto name = "gaussian-channels";
  static constexpr auto summary =
      "white Gaussian noise on each Euler channel, as a multiple of its standard deviation";
  static constexpr auto paper = "Mall et al. 2017, section 4 (k = 0.5: \"0.5 noise\", 6 dB)";
  struct Options : TargetOptions {
    Options() { root = false; }
    double k = 0.5;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::k, "k", "", 0, 100,
               "times the standard deviation of the channel over the clip, after unwrapping");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes& notes) {
    if (clip.frame_count() == 0) return;
    bool any = false;
    for (const std::size_t j : target_joints(clip.skeleton, options)) {
      any = damage_joint(clip, random.fork(j), j, options.k) || any;
    }
    if (!any) notes.emplace_back("no channel moves: nothing to scale the noise by");
  }
  // Damages the three numbers of rotation vectors and positions.
  static void damage(VectorMotion& motion, const Random& random, const Options& options,
                     Notes& notes) {
    bool any = false;
    for (const std::size_t n : target_tracks(motion, options)) {
      Random own = random.fork(n);
      std::vector<std::array<double, 3>> seen;
      for (std::size_t f = 0; f < frame_count(motion); ++f) {
        const Vec3 v = vector_at(motion, f, n);
        if (is_observed(motion, f, n)) seen.push_back({v.x, v.y, v.z});
      }
      const auto s = channel_deviations(seen, 3, moving_range * motion.per_radian);
      any = any || s != std::array<double, 3>{};
      for (std::size_t f = 0; f < frame_count(motion); ++f) {
        const double x = own.normal(), y = own.normal(), z = own.normal();
        if (is_observed(motion, f, n))
          set_vector(motion, f, n,
                     vector_at(motion, f, n) + options.k * Vec3{s[0] * x, s[1] * y, s[2] * z});
      }
    }
    if (!any) notes.emplace_back("no channel moves: nothing to scale the noise by");
  }
  static bool damage_joint(Take& clip, Random own, std::size_t joint, double k) {
    const RotationOrder order = clip.skeleton.rotation_order(joint);
    const auto track = euler_track(clip, joint);
    const auto deviations = channel_deviations(track, order.count);
    if (deviations == std::array<double, 3>{}) return false;
    for (std::size_t f = 0; f < track.size(); ++f) {
      auto angles = track[f];
      for (std::size_t c = 0; c < order.count; ++c) angles[c] += k * deviations[c] * own.normal();
      if (k > 0) clip.rotation(f, joint) = from_euler(angles, order);
    }
    return true;
  }
};

struct Ar1 {
  static constexpr auto name = "ar1";
  static constexpr auto summary =
      "correlated jitter: a first-order autoregressive process about each axis";
  static constexpr auto paper = "";
  struct Options : TargetOptions {
    double std_deg = 1.5;
    double time_constant_s = 0.05;
    double correlation = -1;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::std_deg, "std_deg", "deg", 0, 180, "standard deviation about each axis");
      t.number(&Options::time_constant_s, "time_constant_s", "s", 0, 1000,
               "time in which the correlation falls to 1/e");
      t.number(&Options::correlation, "correlation", "", -1, 0.999999,
               "of neighbouring frames; -1: from time_constant_s and the frame rate");
      return add_target_options(t);
    }();
    return options;
  }
  static double correlation_of(const Options& options, double frame_rate_hz) {
    if (options.correlation > -1) return options.correlation;
    if (options.time_constant_s <= 0) return 0;
    return portable::exp(-1 / (frame_rate_hz * options.time_constant_s));
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double rho = correlation_of(options, motion.frame_rate_hz);
    const double deviation = options.std_deg * radians_per_degree;
    const double fresh = deviation * std::sqrt(1 - rho * rho);
    for (const std::size_t j : target_tracks(motion, options)) {
      Random own = random.fork(j);
      Vec3 n = deviation * normal_vector(own);
      for (std::size_t f = 0; f < frame_count(motion); ++f) {
        if (f > 0) n = rho * n + fresh * normal_vector(own);
        if (!(n == Vec3{})) turn(motion, f, j, n);
      }
    }
  }
};

}  // namespace

void add_rotation_noise(std::vector<Damage>& table) {
  table.push_back(entry<Gaussian>());
  table.push_back(entry<GaussianChannels>());
  table.push_back(entry<GaussianLog>());
  table.push_back(entry<Uniform>());
  table.push_back(entry<Ar1>());
}

}  // namespace kinemend::corrupt
