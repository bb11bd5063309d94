// Tests of the method `sparse` on takes, with models trained on synthetic walks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/figures.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/corrupt.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/lab/train.hpp"

namespace kinemend::test {
namespace {

Take seeded_walk(std::uint64_t seed) {
  SynthOptions options{.motion = "walk", .duration_s = 3, .frame_rate_hz = 60};
  options.seed = seed;
  return synthesize(options);
}

std::shared_ptr<const Model> learned(const std::vector<Take>& clips) {
  return std::make_shared<const Model>(
      train_model("sparse", {clips.size(), [&](std::size_t i) { return Take(clips[i]); }},
                  {{"atoms", std::int64_t{60}}, {"iterations", std::int64_t{4}}}));
}

std::shared_ptr<const Model> joints() {
  static const auto model = learned(std::vector<Take>{seeded_walk(1), seeded_walk(2)});
  return model;
}
std::shared_ptr<const Model> markers() {
  static const auto model =
      learned(std::vector<Take>{joint_markers(seeded_walk(1)), joint_markers(seeded_walk(2))});
  return model;
}

double distance(const Take& a, const Take& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) {
    const Vec3 d = a.positions[i] - b.positions[i];
    sum += dot(d, d);
  }
  return std::sqrt(sum / static_cast<double>(a.positions.size()));
}

Take shaken(Take clip, double size, double outliers) {
  Random random(3);
  for (Vec3& position : clip.positions) {
    position += size * Vec3{random.normal(), random.normal(), random.normal()};
    if (random.chance(outliers)) position += Vec3{10 * size, 0, 0};
  }
  return clip;
}

TEST(Sparse, TakesStrongNoiseAndOutliersOffMarkers) {
  const Take truth = joint_markers(seeded_walk(4));
  for (const double outliers : {0.0, 0.1}) {
    const Take noisy = shaken(truth, 2, outliers);  // cm
    for (const char* solver : {"quick", "paper"}) {
      SparseOptions options;
      options.solver = solver;
      if (options.solver == "paper") options.hops = 2;
      Take cleaned = noisy;
      clean_in_place(*make_sparse(options, markers()), cleaned);
      EXPECT_LT(distance(cleaned, truth), 0.5 * distance(noisy, truth)) << solver << outliers;
    }
  }
}

// Outliers as in Xiao et al.: they grow with the marker's distance from the root. An accurate take
// has no other noise, and only a dictionary can tell the right samples.
TEST(Sparse, FindsOutliersThatGrowWithTheDistanceFromTheRoot) {
  const Take truth = joint_markers(seeded_walk(4));
  Take noisy = truth;
  Random random(5);
  for (std::size_t i = 0; i < noisy.positions.size(); ++i) {
    const Vec3 from_root = truth.positions[i] - truth.positions[i - i % truth.marker_count()];
    if (random.chance(0.1)) noisy.positions[i] += 0.4 * from_root;
  }
  Take cleaned = noisy;
  clean_in_place(*make_sparse({}, markers()), cleaned);
  EXPECT_LT(distance(cleaned, truth), 0.25 * distance(noisy, truth));
}

TEST(Sparse, BringsNoisyRotationsNearerToTheTruth) {
  const Take truth = seeded_walk(5);
  Take noisy = truth;
  Random random(6);
  apply_damage(noisy, "gaussian", {{"std_deg", 4.0}}, random);
  Take cleaned = noisy;
  clean_in_place(*make_sparse({}, joints()), cleaned);
  EXPECT_LT(rms_deg(truth, cleaned), 0.6 * rms_deg(truth, noisy));
  EXPECT_EQ(cleaned.skeleton.offsets, truth.skeleton.offsets);
}

// The root is excluded, because `auto` cleans it.
double error_below_root(const Take& truth, const Take& other) {
  double sum = 0;
  for (std::size_t f = 0; f < truth.frame_count(); ++f) {
    for (std::size_t j = 1; j < truth.joint_count(); ++j)
      sum += std::pow(angle_between(truth.rotation(f, j), other.rotation(f, j)), 2);
  }
  return std::sqrt(sum);
}

TEST(Sparse, CleansABodyThatTurnsOverAsWellAsOneThatStands) {
  const Take truth = seeded_walk(5);
  Take noisy = truth;
  Random random(6);
  apply_damage(noisy, "gaussian", {{"std_deg", 4.0}}, random);
  Take turning = noisy;
  for (std::size_t f = 0; f < turning.frame_count(); ++f) {
    const double angle = radians_per_degree * 90 * static_cast<double>(f) / turning.frame_rate_hz;
    turning.rotation(f, 0) = exp(Vec3{angle, 0, 0}) * turning.rotation(f, 0);
    turning.root_position(f) = rotate(exp(Vec3{angle, 0, 0}), turning.root_position(f));
  }
  Take standing = noisy;
  clean_in_place(*make_sparse({}, joints()), standing);
  clean_in_place(*make_sparse({}, joints()), turning);
  EXPECT_LT(error_below_root(truth, turning), 1.08 * error_below_root(truth, standing));
}

TEST(Sparse, LeavesACleanWalkNearlyAlone) {
  const Take truth = seeded_walk(7);
  EXPECT_LT(geodesic_rms_deg(truth, clean_take(truth, *make_sparse({}, joints())).take), 0.05);
}

TEST(Sparse, LeavesNoiseWithAColourToAuto) {
  Take noisy = seeded_walk(9);
  Random random(10);
  apply_damage(noisy, "ar1", {{"std_deg", 2.0}, {"correlation", 0.9}}, random);
  const Take own = clean_take(noisy, *make_sparse({}, joints())).take;
  EXPECT_EQ(own.rotations, clean_take(noisy, *make_auto()).take.rotations);
}

TEST(Sparse, FillsAMarkerFromTheOthersOfItsPoselet) {
  const Take truth = joint_markers(seeded_walk(8));
  Take gapped = truth;
  const std::size_t marker = 5, first = 60, last = 110;
  for (std::size_t f = first; f < last; ++f) {
    gapped.observed[f * truth.marker_count() + marker] = 0;
    gapped.position(f, marker) = {};
  }
  const Take cleaned = clean_take(gapped, *make_sparse({}, markers())).take;
  double sum = 0;
  for (std::size_t f = first; f < last; ++f)
    sum += norm(cleaned.position(f, marker) - truth.position(f, marker));
  EXPECT_LT(sum / static_cast<double>(last - first), 5);  // cm
}

}  // namespace
}  // namespace kinemend::test
