// Damages that displace single samples: random jumps, jumps of one size, and values multiplied by a
// factor.
#include "kinemend/extend/motion.hpp"
#include "lab/damage/damage_kind.hpp"
#include "lab/damage/normal_vector.hpp"
#include "lab/damage/position_targets.hpp"
#include "lab/damage/targets.hpp"

namespace kinemend::corrupt {

namespace {

// Calls `hit(f, j, own)` for a share of the samples of every track.
template <class Motion, class Hit>
void hit_share(const Motion& motion, const Random& random, const TargetOptions& options,
               double share, const Hit& hit) {
  for (const std::size_t j : target_tracks(motion, options)) {
    Random own = random.fork(j);
    for (std::size_t f = 0; f < frame_count(motion); ++f) {
      if (own.chance(share)) hit(f, j, own);
    }
  }
}

struct Outliers {
  static constexpr auto name = "outliers";
  static constexpr auto summary = "random jumps of single samples";
  static constexpr auto paper = "Lou & Chai 2010, section 4.2";
  struct Options : TargetOptions {
    double share = 0.004;
    double std_deg = 25;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::share, "share", "", 0, 1, "chance of a joint sample to be hit");
      t.number(&Options::std_deg, "std_deg", "deg", 0, 360,
               "standard deviation of the jump about each axis: q Exp(n)");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double deviation = options.std_deg * radians_per_degree;
    hit_share(motion, random, options, options.share,
              [&](std::size_t f, std::size_t j, Random& own) {
                turn(motion, f, j, deviation * normal_vector(own));
              });
  }
};

struct Impulse {
  static constexpr auto name = "impulse";
  static constexpr auto summary = "jumps of single samples by one angle about random axes";
  static constexpr auto paper = "Dean 2016, table I";
  struct Options : TargetOptions {
    double share = 0.01;
    double size_deg = 60;
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::share, "share", "", 0, 1, "chance of a joint sample to be hit");
      t.number(&Options::size_deg, "size_deg", "deg", 0, 180, "angle of the jump");
      return add_target_options(t);
    }();
    return options;
  }
  template <class Motion>
  static void damage(Motion& motion, const Random& random, const Options& options, Notes&) {
    const double size = options.size_deg * radians_per_degree;
    hit_share(motion, random, options, options.share,
              [&](std::size_t f, std::size_t j, Random& own) {
                const Vec3 n = normal_vector(own);
                turn(motion, f, j, size / norm(n) * n);
              });
  }
};

struct OutlierScale {
  static constexpr auto name = "outlier-scale";
  static constexpr auto summary = "single values multiplied by a factor";
  static constexpr auto paper = "Xiao et al. 2015, section 4 (10 to 25 % of the entries x 1.4)";
  struct Options : TargetOptions {
    Options() { root = false; }
    double share = 0.1;
    double factor = 1.4;
    std::string value = "position";
  };
  static const OptionTable<Options>& table() {
    static const auto options = [] {
      OptionTable<Options> t;
      t.number(&Options::share, "share", "", 0, 1, "chance of a value to be hit");
      t.number(&Options::factor, "factor", "", -100, 100, "what it is multiplied by");
      t.choice(&Options::value, "value", {"position", "rotation"},
               "position: coordinates of joints relative to the root (Xiao), then refitted; "
               "rotation: rotation vectors");
      return add_target_options(t);
    }();
    return options;
  }
  static void damage(Take& clip, const Random& random, const Options& options, Notes&) {
    if (options.value == "rotation") {
      hit_share(clip, random, options, options.share, [&](std::size_t f, std::size_t j, Random&) {
        set_rotation(clip, f, j, exp(options.factor * log(clip.rotation(f, j))));
      });
      return;
    }
    std::vector<Vec3> targets = joint_positions(clip);
    for (const std::size_t j : position_joints(clip.skeleton, options)) {
      Random own = random.fork(j);
      for (std::size_t i = 0; i < targets.size(); i += clip.joint_count()) {
        const Vec3 root = targets[i];
        Vec3 p = targets[i + j] - root;
        for (double* coordinate : {&p.x, &p.y, &p.z}) {
          if (own.chance(options.share)) *coordinate *= options.factor;
        }
        if (j > 0) targets[i + j] = root + p;
      }
    }
    refit_to(clip, targets, options);
  }
  // Scales coordinates about the mean of the frame's positions, and whole rotation vectors.
  static void damage(VectorMotion& motion, const Random& random, const Options& options, Notes&) {
    std::vector<Vec3> means(frame_count(motion));
    for (std::size_t f = 0; f < means.size(); ++f) means[f] = mean_position(motion, f);
    for (const std::size_t n : target_tracks(motion, options)) {
      Random own = random.fork(n);
      const bool turns = motion.is_rotation[n] != 0;
      for (std::size_t f = 0; f < means.size(); ++f) {
        const Vec3 centre = turns ? Vec3{} : means[f];
        Vec3 p = vector_at(motion, f, n) - centre;
        const bool all = own.chance(options.share);
        for (double* coordinate : {&p.x, &p.y, &p.z}) {
          const bool hit = own.chance(options.share);
          if (turns ? all : hit) *coordinate *= options.factor;
        }
        if (is_observed(motion, f, n)) set_vector(motion, f, n, centre + p);
      }
    }
  }
};

}  // namespace

void add_outliers(std::vector<Damage>& table) {
  table.push_back(entry<Outliers>());
  table.push_back(entry<OutlierScale>());
  table.push_back(entry<Impulse>());
}

}  // namespace kinemend::corrupt
