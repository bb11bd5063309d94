// Tests of the method `nonlocal` and of its causal form, against Dean's filter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "classic/filter_checks.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/metrics.hpp"
#include "translations.hpp"

namespace kinemend::test {
namespace {

// Dean's filter directly, frame by frame and joint by joint, without cached sums.
struct Direct {
  Take clip;  // gaps bridged
  int window = 4, patch = 2, neighbours = 0;
  double bandwidth = 0.1;
  std::string boundary = "neumann";
  bool whole_take = false;
  int travel = 4;
  static constexpr std::size_t fixed_joint = 5;  // has no channels and is no part of the pose

  int frames() const { return static_cast<int>(clip.frame_count()); }

  int source(int i) const {
    while (boundary == "mirror" && (i < 0 || i >= frames())) {
      i = i < 0 ? -i : 2 * (frames() - 1) - i;
    }
    return std::clamp(i, 0, frames() - 1);
  }
  bool observed(int i, std::size_t joint) const {
    return clip.is_observed(static_cast<std::size_t>(source(i)), joint);
  }

  // Beyond an end: the least-squares line through the first 2 patch + 1 samples, by the normal
  // equations, about the end.
  template <class Offset>
  Vec3 line_at(int i, const Offset& offset_of) const {
    const int n = std::min(frames(), 2 * patch + 1);
    const int end = i < 0 ? 0 : frames() - 1;
    double s1 = 0, s2 = 0;
    Vec3 m0, m1;
    for (int k = 0; k < n; ++k) {
      const Vec3 d = offset_of(end, i < 0 ? k : end - k);
      s1 += k, s2 += k * k;
      m0 += d;
      m1 += static_cast<double>(k) * d;
    }
    const double at = i < 0 ? i : frames() - 1 - i;
    const double determinant = n * s2 - s1 * s1;
    const Vec3 value = (1 / determinant) * (s2 * m0 - s1 * m1);
    const Vec3 slope = (1 / determinant) * (static_cast<double>(n) * m1 - s1 * m0);
    return value + at * slope;
  }
  Quat rotation(int i, std::size_t joint) const {
    const auto at = [&](int f) { return clip.rotation(static_cast<std::size_t>(f), joint); };
    if (boundary != "neumann" || (i >= 0 && i < frames())) return at(source(i));
    const int end = i < 0 ? 0 : frames() - 1;
    return at(end) * exp(line_at(i, [&](int a, int b) { return log(conjugate(at(a)) * at(b)); }));
  }
  Vec3 root(int i) const {
    const auto at = [&](int f) { return clip.root_position(static_cast<std::size_t>(f)); };
    if (boundary != "neumann" || (i >= 0 && i < frames())) return at(source(i));
    const int end = i < 0 ? 0 : frames() - 1;
    return at(end) + line_at(i, [&](int a, int b) { return at(b) - at(a); });
  }

  double distance(int t, int s) const {
    double sum = 0, count = 0;
    for (int o = -patch; o <= patch; ++o) {
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        if (j == fixed_joint || !observed(t + o, j) || !observed(s + o, j)) continue;
        const Vec3 d = log(conjugate(rotation(t + o, j)) * rotation(s + o, j));
        sum += dot(d, d);
        count += 3;
      }
    }
    return sum / count;
  }

  struct Weighted {
    int frame;
    double distance, weight;
  };
  std::vector<Weighted> weights_of(int t) const {
    std::vector<Weighted> list;
    const int first = whole_take ? 0 : t - window;
    const int last = whole_take ? frames() - 1 : t + window;
    for (int s = first; s <= last; ++s) {
      if (s != t) list.push_back({s, distance(t, s), 0});
    }
    if (neighbours > 0) {
      std::sort(list.begin(), list.end(),
                [](const auto& a, const auto& b) { return a.distance < b.distance; });
      list.resize(std::min(list.size(), static_cast<std::size_t>(neighbours)));
    }
    double largest = 0;
    for (Weighted& w : list) {
      w.weight = std::exp(-w.distance / (2 * bandwidth * bandwidth));
      largest = std::max(largest, w.weight);
    }
    list.push_back({t, 0, largest});  // the pose itself
    return list;
  }

  Take run() const {
    Take result = clip;
    for (int t = 0; t < frames(); ++t) {
      const auto f = static_cast<std::size_t>(t);
      const std::vector<Weighted> weights = weights_of(t);
      for (std::size_t j = 0; j < clip.joint_count(); ++j) {
        Vec3 sum;
        double total = 0;
        for (const Weighted& w : weights) {
          if (!observed(w.frame, j)) continue;
          sum += w.weight * log(conjugate(clip.rotation(f, j)) * rotation(w.frame, j));
          total += w.weight;
        }
        if (total > 0) result.rotation(f, j) = clip.rotation(f, j) * exp((1 / total) * sum);
      }
      // The normal equations of a straight line through the weighted positions, at frame t.
      double s0 = 0, s1 = 0, s2 = 0;
      Vec3 t0, t1;
      for (const Weighted& w : weights) {
        if (std::abs(w.frame - t) > travel) continue;
        const double o = w.frame - t;
        s0 += w.weight, s1 += w.weight * o, s2 += w.weight * o * o;
        t0 += w.weight * root(w.frame), t1 += w.weight * o * root(w.frame);
      }
      const double determinant = s0 * s2 - s1 * s1;
      const bool is_line = determinant > 0.5 * s0 * s0;
      result.root_position(f) = is_line ? (1 / determinant) * (s2 * t0 - s1 * t1) : (1 / s0) * t0;
    }
    return result;
  }
};

// At 100 Hz: a window of 9 and a patch of 5 poses, as in Direct.
NonlocalOptions small_options(std::string boundary = "neumann") {
  NonlocalOptions options;
  options.window_s = 0.09;
  options.patch_s = 0.05;
  options.bandwidth_deg = 0.1 * degrees_per_radian;
  options.boundary = std::move(boundary);
  return options;
}

void expect_direct(const Direct& direct, const Take& output) {
  const Take expected = direct.run();
  for (std::size_t f = 0; f < output.frame_count(); ++f) {
    for (std::size_t j = 0; j < output.joint_count(); ++j) {
      ASSERT_LT(difference(output.rotation(f, j), expected.rotation(f, j)), 1e-11)
          << "frame " << f << ", joint " << j;
    }
    ASSERT_LT(norm(output.root_position(f) - expected.root_position(f)), 1e-9) << "frame " << f;
  }
}

TEST(Nonlocal, IsDeansFilterWithEachBoundary) {
  for (const char* boundary : {"mirror", "neumann", "dirichlet"}) {
    for (const std::size_t frames : {2, 3, 7, 30, 270}) {
      Direct direct{noisy_take(frames)};
      direct.boundary = boundary;
      expect_direct(direct, cleaned(direct.clip, *make_nonlocal(small_options(boundary))));
    }
  }
}

TEST(Nonlocal, AveragesTheMostSimilarPosesOnly) {
  Direct direct{noisy_take(40)};
  direct.neighbours = 3;
  NonlocalOptions options = small_options();
  options.neighbours = 3;
  expect_direct(direct, cleaned(direct.clip, *make_nonlocal(options)));
}

TEST(Nonlocal, ComparesAllPosesOfATake) {
  Direct direct{noisy_take(60)};
  direct.whole_take = true;
  direct.travel = 8;  // the default window of 0.175 s
  NonlocalOptions options = small_options();
  options.window_s = 0;
  expect_direct(direct, cleaned(direct.clip, *make_nonlocal(options)));
  direct.neighbours = 5;
  options.neighbours = 5;
  expect_direct(direct, cleaned(direct.clip, *make_nonlocal(options)));
}

TEST(Nonlocal, GivesAWeightWhereNoPatchIsNear) {
  // exp(-d / (2 h^2)) of every neighbour is zero in floating point, and so is the pose's own.
  Direct direct{noisy_take(40)};
  direct.bandwidth = 0.01;
  NonlocalOptions options = small_options();
  options.bandwidth_deg = 0.01 * degrees_per_radian;
  expect_direct(direct, cleaned(direct.clip, *make_nonlocal(options)));
  options.bandwidth_deg = 1e-6;
  for (const Quat& q : cleaned(direct.clip, *make_nonlocal(options)).rotations) {
    EXPECT_NEAR(norm(q), 1, 1e-12);
  }
}

TEST(Nonlocal, LeavesUnobservedSamplesOutOfPatchesAndMeans) {
  Take input = noisy_take(50);
  input.observed.assign(input.rotations.size(), 1);
  for (std::size_t f = 20; f < 23; ++f) input.observed[f * input.joint_count() + 2] = 0;
  input.observed[30 * input.joint_count() + 4] = 0;
  Direct direct{input};
  for (std::size_t f = 20; f < 23; ++f) {
    direct.clip.rotation(f, 2) =
        slerp(input.rotation(19, 2), input.rotation(23, 2), (static_cast<double>(f) - 19) / 4);
  }
  direct.clip.rotation(30, 4) = slerp(input.rotation(29, 4), input.rotation(31, 4), 0.5);
  expect_direct(direct, cleaned(input, *make_nonlocal(small_options())));
}

TEST(Nonlocal, ComparesWholePosesWhateverIsSelected) {
  const Take input = noisy_take(50);
  const auto cleaner = make_nonlocal(small_options());
  const Take all = cleaned(input, *cleaner);
  Take one = input;
  Selection selection;
  selection.owners.assign(one.joint_count(), 0);
  selection.owners[2] = 1;
  selection.root_position = false;
  clean_in_place(*cleaner, one, selection);
  for (std::size_t f = 0; f < 50; ++f) {
    EXPECT_EQ(one.rotation(f, 2), all.rotation(f, 2));
    EXPECT_EQ(one.rotation(f, 1), input.rotation(f, 1));
  }
  EXPECT_EQ(one.positions, input.positions);
}

// No angle is special, pi included: there is no reference rotation that a joint could be far from.
TEST(Nonlocal, IsTheSameInAnyCoordinateFrame) {
  const Take input = noisy_take(60);
  for (const double bandwidth_deg : {0.0, 5.0}) {
    NonlocalOptions options = small_options();
    options.bandwidth_deg = bandwidth_deg;
    const auto cleaner = make_nonlocal(options);
    EXPECT_LT(largest_difference(in_other_frames(cleaned(input, *cleaner), 8),
                                 cleaned(in_other_frames(input, 8), *cleaner)),
              1e-12);
  }
}

TEST(Nonlocal, IsTheSameBackwardsInTime) {
  const Take input = noisy_take(60);
  for (const char* boundary : {"mirror", "neumann", "dirichlet"}) {
    const auto cleaner = make_nonlocal(small_options(boundary));
    EXPECT_LT(
        largest_difference(reversed(cleaned(input, *cleaner)), cleaned(reversed(input), *cleaner)),
        1e-11);
  }
}

double error_deg(const Take& truth, const Take& noisy, NonlocalOptions options) {
  return rms_angle_deg(truth, cleaned(noisy, *make_nonlocal(options)));
}

TEST(Nonlocal, ChoosesABandwidthNearTheBest) {
  for (const char* motion : {"walk", "wave"}) {
    SynthOptions synth;
    synth.motion = motion;
    synth.duration_s = 2;
    const Take truth = synthesize(synth);
    for (const double noise_deg : {0.3, 1.0, 3.0}) {
      Take noisy = truth;
      Random random(3);
      apply_damage(noisy, "gaussian", {{"std_deg", noise_deg}}, random);
      double best = std::numeric_limits<double>::infinity();
      for (double h = 0.1; h < 10; h *= 1.4) {
        NonlocalOptions options;
        options.bandwidth_deg = h;
        best = std::min(best, error_deg(truth, noisy, options));
      }
      const double automatic = error_deg(truth, noisy, {});
      EXPECT_LT(automatic, 1.05 * best) << motion << " with " << noise_deg << " degrees";
      EXPECT_LT(automatic, 0.75 * rms_angle_deg(truth, noisy));
    }
  }
}

TEST(Nonlocal, LeavesACleanTakeNearlyAlone) {
  SynthOptions synth;
  synth.duration_s = 2;
  const Take truth = synthesize(synth);
  EXPECT_LT(error_deg(truth, truth, {}), 0.05);
  // The paper's weights have no measure of how near the nearest patch is.
  NonlocalOptions options;
  options.bandwidth_deg = 0.05;
  EXPECT_GT(error_deg(truth, truth, options), 0.1);
}

TEST(Nonlocal, LearnsFromRepetitionsInTheWholeTake) {
  // Ten times the same second, exactly, under noise.
  Take truth = moving_take(1000, 100);
  for (std::size_t f = 0; f < 1000; ++f) {
    for (std::size_t j = 0; j < truth.joint_count(); ++j) {
      truth.rotation(f, j) =
          exp({std::sin(2 * pi * static_cast<double>(f % 100) / 100 + static_cast<double>(j)),
               0.5 * std::cos(4 * pi * static_cast<double>(f % 100) / 100), 0.2});
    }
  }
  Take noisy = truth;
  Random random(5);
  for (Quat& q : noisy.rotations) q = q * exp(random_vector(random, radians_per_degree));
  NonlocalOptions options;
  const double window = error_deg(truth, noisy, options);
  options.window_s = 0;
  EXPECT_LT(error_deg(truth, noisy, options), 0.75 * window);
}

TEST(Nonlocal, DependsOnItsWindowOnly) {
  const auto cleaner = make_nonlocal(small_options());
  ASSERT_EQ(cleaner->live(view_of(noisy_take(1)))->lookahead(), 6U);
  const Take input = noisy_take(60);
  const Take output = cleaned(input, *cleaner), other = cleaned(changed_at(input, 30), *cleaner);
  EXPECT_EQ(output.rotation(23, 1), other.rotation(23, 1));
  EXPECT_EQ(output.rotation(37, 1), other.rotation(37, 1));
  EXPECT_NE(output.rotation(24, 1), other.rotation(24, 1));
  EXPECT_NE(output.rotation(36, 1), other.rotation(36, 1));
}

TEST(Nonlocal, NeedsTheTakeWhereItMeasuresTheNoise) {
  EXPECT_FALSE(make_nonlocal()->live_support(100).runs());
  NonlocalOptions options = small_options();
  options.window_s = 0;
  EXPECT_FALSE(make_nonlocal(options)->live_support(100).runs());
  EXPECT_THROW(make_nonlocal(options)->live(view_of(noisy_take(2))), Error);
}

NonlocalOptions causal_options(double bandwidth_deg) {
  NonlocalOptions options = small_options();
  options.causal = true;
  options.bandwidth_deg = bandwidth_deg;
  return options;
}

TEST(NonlocalCausal, AveragesPastPosesByTheirPatches) {
  const Take input = noisy_take(40);
  const Take output = cleaned(input, *make_nonlocal(causal_options(0.1 * degrees_per_radian)));
  for (int t = 0; t < 40; ++t) {
    std::vector<double> weights;
    double largest = 0;
    for (int s = std::max(0, t - 8); s < t; ++s) {
      double sum = 0, count = 0;
      for (int o = 0; o < 5 && s - o >= 0; ++o) {
        for (std::size_t j = 0; j < input.joint_count(); ++j) {
          if (j == Direct::fixed_joint) continue;
          sum += std::pow(angle_between(input.rotation(static_cast<std::size_t>(t - o), j),
                                        input.rotation(static_cast<std::size_t>(s - o), j)),
                          2);
          count += 3;
        }
      }
      weights.push_back(std::exp(-sum / count / 0.02));
      largest = std::max(largest, weights.back());
    }
    for (std::size_t j = 0; j < input.joint_count(); ++j) {
      const Quat own = input.rotation(static_cast<std::size_t>(t), j);
      Vec3 sum;
      double total = t == 0 ? 1 : largest;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const std::size_t s = static_cast<std::size_t>(t) - weights.size() + i;
        sum += weights[i] * log(conjugate(own) * input.rotation(s, j));
        total += weights[i];
      }
      EXPECT_LT(
          difference(output.rotation(static_cast<std::size_t>(t), j), own * exp((1 / total) * sum)),
          1e-12)
          << t;
    }
  }
  EXPECT_EQ(point_track(output, 0), point_track(input, 0));
}

TEST(NonlocalCausal, DoesNotKnowTheFuture) {
  for (const double bandwidth_deg : {0.0, 5.0}) {
    const auto cleaner = make_nonlocal(causal_options(bandwidth_deg));
    EXPECT_EQ(cleaner->live(view_of(noisy_take(1)))->lookahead(), 0U);
    const Take input = noisy_take(60);
    const Take output = cleaned(input, *cleaner), other = cleaned(changed_at(input, 30), *cleaner);
    for (std::size_t f = 0; f < 30; ++f) EXPECT_EQ(output.rotation(f, 1), other.rotation(f, 1));
    EXPECT_NE(output.rotation(30, 1), other.rotation(30, 1));
  }
}

TEST(NonlocalCausal, MeasuresTheNoiseAsItGoes) {
  const Take truth = held_take(400, 0, 2), input = held_take(400, 1.5, 2);
  NonlocalOptions options;
  options.causal = true;
  EXPECT_LT(error_deg(truth, input, options), 0.5 * rms_angle_deg(truth, input));
  // For a joint held still, the noise is unknown before the eighth second difference.
  const Take output = cleaned(input, *make_nonlocal(options));
  for (std::size_t f = 0; f < 9; ++f) EXPECT_EQ(output.rotation(f, 0), input.rotation(f, 0));
  EXPECT_NE(output.rotation(9, 0), input.rotation(9, 0));
}

TEST(Nonlocal, RefusesOptionsThatMakeNoSense) {
  NonlocalOptions options;
  options.boundary = "periodic";
  EXPECT_THROW(make_nonlocal(options), Error);
  options = {};
  options.neighbours = -1;
  EXPECT_THROW(make_nonlocal(options), Error);
  options = {};
  options.causal = true;
  options.window_s = 0;
  EXPECT_THROW(make_nonlocal(options), Error);
}

}  // namespace
}  // namespace kinemend::test
