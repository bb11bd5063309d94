// Tests of Algorithm 1 of Xiao et al. 2015: a direct computation from its definition, and laws.
#include "lab/experiments/xiao_paper.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/extend/motion.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/metrics.hpp"
#include "papers/xiao2015_sparse/dual_solver.hpp"

namespace kinemend::papers {
namespace {

// Joints of a synthetic walk as markers, in metres.
Take markers_of_walk(std::uint64_t seed, double duration_s) {
  SynthOptions options{.motion = "walk", .duration_s = duration_s, .frame_rate_hz = 60};
  options.seed = seed;
  const Take walk = synthesize(options);
  return joint_markers(scale_lengths(walk, guess_length_unit(walk.skeleton)->metres));
}

Take noisy_take(Take clip, double deviation_m, std::uint64_t seed) {
  Random random(seed);
  for (Vec3& position : clip.positions)
    position += deviation_m * Vec3{random.normal(), random.normal(), random.normal()};
  return clip;
}

const XiaoPaper& small_paper() {
  static const XiaoPaper paper({markers_of_walk(1, 2), markers_of_walk(2, 2)},
                               {.window_frames = 5, .atoms = 70, .windows = 200, .iterations = 3});
  return paper;
}

constexpr sparse::DescentSettings to_the_minimum{
    .tolerance = 1e-4, .sweeps = 20'000, .rounds = 200, .most_atoms = 400, .turns = 40};

// Section 3.1.1: the root in the origin, the ray from between the hips to the upper neck along +Y,
// the plane of the three parallel to XY.
struct PoseAxes {
  Vec3 origin, x, y, z;
};

PoseAxes axes_of(const Take& clip, std::size_t frame) {
  const auto at = [&](const char* name) {
    return clip.position(frame, static_cast<std::size_t>(clip.find(name)));
  };
  const Vec3 left = at("LeftUpLeg"), right = at("RightUpLeg"),
             up = at("Neck1") - 0.5 * (left + right);
  PoseAxes axes{at("Hips"), {}, {}, {}};
  axes.y = (1 / norm(up)) * up;
  const Vec3 across = left - right, aside = across - dot(across, axes.y) * axes.y;
  axes.x = (1 / norm(aside)) * aside;
  axes.z = cross(axes.x, axes.y);
  return axes;
}

double trunk_of(const Take& clip) {
  std::vector<double> lengths;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto at = [&](const char* name) {
      return clip.position(f, static_cast<std::size_t>(clip.find(name)));
    };
    lengths.push_back(norm(at("Neck1") - 0.5 * (at("LeftUpLeg") + at("RightUpLeg"))));
  }
  std::ranges::sort(lengths);
  const std::size_t half = lengths.size() / 2;
  return lengths.size() % 2 == 1 ? lengths[half] : 0.5 * (lengths[half - 1] + lengths[half]);
}

// Equations 4 and 5 for one window by the dual method, to a proven gap.
std::vector<double> coded(sparse::Loss loss, const sparse::Dictionary& dictionary,
                          const std::vector<double>& window, double lambda) {
  const std::vector<double> lambdas{lambda};
  return sparse::solve_sparse(dictionary, {loss, window, {}, lambdas, {}},
                              {.tolerance = 1e-5, .iterations = 20'000})
      .reconstructed;
}

// Algorithm 1 step by step, for one loss.
Take by_definition(const XiaoPaper& paper, const Take& noisy, double lambda, sparse::Loss loss) {
  const std::size_t frames = noisy.frame_count(), markers = noisy.marker_count(),
                    window = paper.sizes().window_frames;
  const double scale = 50 / trunk_of(noisy);
  std::vector<Vec3> local(noisy.positions.size()), sums(local.size());
  std::vector<double> copies(local.size());
  std::vector<PoseAxes> axes;
  for (std::size_t f = 0; f < frames; ++f) {
    axes.push_back(axes_of(noisy, f));
    for (std::size_t m = 0; m < markers; ++m) {
      const Vec3 own = scale * (noisy.position(f, m) - axes[f].origin);
      local[f * markers + m] = {dot(own, axes[f].x), dot(own, axes[f].y), dot(own, axes[f].z)};
    }
  }
  for (const SparsePoselet& part : paper.poselets()) {
    for (std::size_t first = 0; first + window <= frames; ++first) {
      std::vector<double> group;
      for (std::size_t f = first; f < first + window; ++f) {
        for (const std::int32_t point : part.points) {
          const Vec3 p = local[f * markers + static_cast<std::size_t>(point)];
          group.insert(group.end(), {p.x, p.y, p.z});
        }
      }
      const std::vector<double> filtered = coded(loss, part.dictionary, group, lambda);
      std::size_t at = 0;
      for (std::size_t f = first; f < first + window; ++f) {
        for (const std::int32_t point : part.points) {
          const std::size_t i = f * markers + static_cast<std::size_t>(point);
          sums[i] += Vec3{filtered[at], filtered[at + 1], filtered[at + 2]};
          copies[i] += 1;
          at += 3;
        }
      }
    }
  }
  Take result = noisy;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const PoseAxes& pose = axes[i / markers];
    const Vec3 p = copies[i] > 0 ? (1 / copies[i]) * sums[i] : local[i];
    result.positions[i] = pose.origin + (1 / scale) * (p.x * pose.x + p.y * pose.y + p.z * pose.z);
  }
  return result;
}

double farthest(const Take& one, const Take& other) {
  double most = 0;
  for (std::size_t i = 0; i < one.positions.size(); ++i)
    most = std::max(most, norm(one.positions[i] - other.positions[i]));
  return most;
}

double mean_distance(const Take& one, const Take& other) {
  double sum = 0;
  for (std::size_t i = 0; i < one.positions.size(); ++i)
    sum += norm(one.positions[i] - other.positions[i]);
  return sum / static_cast<double>(one.positions.size());
}

TEST(XiaoPaper, IsAlgorithmOneByItsDefinitionUnderEquation4) {
  const Take noisy = noisy_take(markers_of_walk(3, 0.2), 0.01, 1);
  for (const double lambda : {1.0, 10.0}) {
    const Take expected = by_definition(small_paper(), noisy, lambda, sparse::Loss::squares);
    const Take found =
        small_paper().filtered(noisy, noisy, {.lambda_squares = lambda, .descent = to_the_minimum});
    EXPECT_LT(mean_distance(found, expected), 0.02 * mean_distance(found, noisy)) << lambda;
    const Take quick = small_paper().filtered(noisy, noisy, {.lambda_squares = lambda});
    EXPECT_LT(mean_distance(quick, expected), 0.2 * mean_distance(quick, noisy)) << lambda;
  }
}

TEST(XiaoPaper, IsAlgorithmOneByItsDefinitionUnderEquation5) {
  const Take noisy = noisy_take(markers_of_walk(3, 0.2), 0.01, 1);
  const Take expected = by_definition(small_paper(), noisy, 0.5, sparse::Loss::absolute);
  const Take found = small_paper().filtered(
      noisy, noisy,
      {.loss = XiaoPaperLoss::absolute, .lambda_absolute = 0.5, .descent = to_the_minimum});
  EXPECT_LT(mean_distance(found, expected), 0.1 * mean_distance(found, noisy));
}

TEST(XiaoPaper, SequenceIsEquation4OnWhatEquation5Leaves) {
  const Take clean = markers_of_walk(3, 0.5), noisy = noisy_take(clean, 0.01, 1);
  const auto by = [&](const Take& take, XiaoPaperLoss loss) {
    return small_paper().filtered(take, clean,
                                  {.loss = loss, .lambda_squares = 1, .lambda_absolute = 0.5});
  };
  const Take turns = by(by(noisy, XiaoPaperLoss::absolute), XiaoPaperLoss::squares);
  EXPECT_LT(farthest(by(noisy, XiaoPaperLoss::sequence), turns), 1e-5);
}

TEST(XiaoPaper, RemovesNoiseThatCameAfterTheChangeOfCoordinates) {
  const Take clean = markers_of_walk(3, 1), noisy = noisy_take(clean, 0.03, 1);
  const double before = mean_distance(noisy, clean);
  EXPECT_LT(mean_distance(small_paper().filtered(noisy, clean, {}), clean), 0.6 * before);
  // The coordinates of noisy poses put the noise of three markers into all others, to stay.
  EXPECT_GT(mean_distance(small_paper().filtered(noisy, noisy, {}), clean), 0.9 * before);
  const Take steady = steady_take(noisy, 9);
  EXPECT_LT(mean_distance(small_paper().filtered(noisy, steady, {}), clean), 0.8 * before);
}

TEST(XiaoPaper, MovesWithTheBody) {
  const Take noisy = noisy_take(markers_of_walk(3, 0.5), 0.01, 1);
  const auto moved = [](Take clip) {
    for (Vec3& p : clip.positions) p = Vec3{2 - p.z, p.y + 1, p.x - 3};  // a quarter turn
    return clip;
  };
  EXPECT_LT(farthest(small_paper().filtered(moved(noisy), moved(noisy), {}),
                     moved(small_paper().filtered(noisy, noisy, {}))),
            1e-4);
}

TEST(SteadyTake, IsTheRunningMeanOfTheRunningMedian) {
  Take clip = markers_of_walk(1, 0.2);
  const double x[] = {0, 9, 0, 3, 3, 6, 6, 6, 0, 6};
  for (std::size_t f = 0; f < 10; ++f) clip.positions[f * clip.marker_count()].x = x[f];
  const Take steady = steady_take(clip, 3);
  // Medians of three, at the ends of one: 0 0 3 3 3 6 6 6 6 6
  EXPECT_DOUBLE_EQ(steady.position(2, 0).x, 2);
  EXPECT_DOUBLE_EQ(steady.position(4, 0).x, 4);
  EXPECT_DOUBLE_EQ(steady.position(0, 0).x, 0);
  EXPECT_EQ(steady_take(clip, 1).positions, clip.positions);
}

TEST(XiaoPapers, TrainEachSizeOnce) {
  XiaoPapers papers({markers_of_walk(1, 1)}, {.windows = 50, .iterations = 1});
  const XiaoPaper& first = papers.of(5, 20);
  EXPECT_EQ(first.sizes().window_frames, 5u);
  EXPECT_EQ(&papers.of(5, 20), &first);
  EXPECT_NE(&papers.of(9, 20), &first);
}

}  // namespace
}  // namespace kinemend::papers
