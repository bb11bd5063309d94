// Tests of the filter of `example`, against its objective and the paper's own iteration.
#include "papers/lou2010_example/example_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "dense_algebra.hpp"
#include "kinemend/extend/random.hpp"
#include "papers/lou2010_example/pattern_penalty.hpp"
#include "papers/lou2010_example/window_support.hpp"

namespace kinemend {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// Channels that swing together, sampled at `rate_hz`.
PoseMatrix swing(std::size_t frames, std::size_t channels, double rate_hz, double start_s = 0) {
  Random body(1);
  PoseMatrix poses(frames, channels);
  for (std::size_t c = 0; c < channels; ++c) {
    const double size = 10 * body.normal(), other = 3 * body.normal(),
                 phase = 6.28 * body.uniform();
    const double offset = 20 * body.normal();
    for (std::size_t f = 0; f < frames; ++f) {
      const double t = start_s + static_cast<double>(f) / rate_hz;
      poses(f, c) = offset + size * std::sin(6 * t + phase) + other * std::sin(12 * t + 2 * phase);
    }
  }
  return poses;
}

FilterBases swing_bases(std::size_t window, std::size_t channels, std::size_t count = 4) {
  LagCovariance covariance(window, channels);
  covariance.add(swing(400, channels, 30));
  return filter_bases(covariance, {.count = count});
}

ExampleWeights paper_weights(std::size_t channels, double welsch, double lambda) {
  return {std::vector<double>(channels, 1.0),
          std::vector<double>(channels, welsch),
          std::vector<double>(channels, lambda),
          {}};
}

PoseMatrix with_noise(PoseMatrix poses, double deviation, std::uint64_t seed) {
  Random random(seed);
  for (double& value : poses.values) value += deviation * random.normal();
  return poses;
}

std::vector<std::uint8_t> with_outliers(PoseMatrix& poses, double share, std::uint64_t seed) {
  Random random(seed);
  std::vector<std::uint8_t> hit(poses.values.size());
  for (std::size_t i = 0; i < hit.size(); ++i) {
    hit[i] = random.uniform() < share;
    if (hit[i]) poses.values[i] += 60 * (random.uniform() - 0.5) + 20;
  }
  return hit;
}

double rms(const PoseMatrix& a, const PoseMatrix& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i) sum += std::pow(a.values[i] - b.values[i], 2);
  return std::sqrt(sum / static_cast<double>(a.values.size()));
}

TEST(WindowBases, AreTheModelsOwnAtItsRate) {
  const FilterBases bases = swing_bases(10, 4);
  const WindowBases same = bases_at_rate(bases, 30, 30, 100);
  EXPECT_EQ(same.frames, 10u);
  EXPECT_EQ(same.hop, 1u);
  ASSERT_EQ(same.values.size(), bases.bases.size());
  for (std::size_t i = 0; i < same.values.size(); ++i) {
    EXPECT_NEAR(same.values[i], bases.bases[i], 1e-14);
  }
}

TEST(WindowBases, FollowCubicsInTimeAtAnyRate) {
  // One base of one channel: a cubic.
  FilterBases bases{12, 1, 1, {}, {1.0}, {0.0}, {0.0}, 1.0};
  const auto cubic = [](double t) { return 1 + t - 0.3 * t * t + 0.02 * t * t * t; };
  for (std::size_t i = 0; i < 12; ++i) bases.bases.push_back(cubic(static_cast<double>(i)));
  for (const double rate : {24.0, 25.0, 30.0, 50.0, 60.0, 100.0, 120.0, 240.0}) {
    const WindowBases found = bases_at_rate(bases, 30, rate, 1000);
    EXPECT_EQ(found.hop, static_cast<std::size_t>(std::lround(rate / 30)));
    EXPECT_LE(static_cast<double>(found.frames - 1) * 30 / rate, 11.0 + 1e-6);
    EXPECT_GT(static_cast<double>(found.frames) * 30 / rate, 11.0);
    const double spare = (11.0 * rate / 30 - static_cast<double>(found.frames - 1)) / 2;
    EXPECT_GE(spare, -1e-6);
    for (std::size_t j = 0; j < found.frames; ++j) {
      EXPECT_NEAR(found.values[j], cubic(static_cast<double>(j) * 30 / rate), 1e-9) << rate;
    }
  }
}

TEST(WindowBases, OfAShortClipAreTheMiddleOfTheWindow) {
  const FilterBases bases = swing_bases(10, 4);
  const WindowBases found = bases_at_rate(bases, 30, 30, 6, 2);
  EXPECT_EQ(found.frames, 6u);
  EXPECT_EQ(found.count, 2u);
  for (std::size_t row = 0; row < 24; ++row) {
    EXPECT_NEAR(found.values[row * 2 + 1], bases.bases[(row + 8) * 4 + 1], 1e-14);
  }
}

TEST(WindowBases, StayTheModelsWhereTheyWouldBeLargeAtTheRateOfTheClip) {
  const FilterBases bases = swing_bases(10, 4);
  const auto values_at = [&](double rate_hz, std::size_t frames) {
    return bases_at_rate(bases, 30, rate_hz, frames, 0, 1000).values.size();
  };
  EXPECT_GT(values_at(120, 5000), bases.bases.size());
  EXPECT_LE(values_at(120, 5000), 1000U);
  EXPECT_EQ(values_at(1000, 5000), bases.bases.size());
  EXPECT_EQ(values_at(1e5, 100000), bases.bases.size());
  EXPECT_EQ(values_at(1000, 5), 5 * 4 * bases.count) << "fewer frames than the model's window";
}

TEST(LinearExampleFilter, AveragesTheProjectionsOfAllWindows) {
  const FilterBases bases = swing_bases(6, 3);
  const WindowBases windows = bases_at_rate(bases, 30, 30, 25);
  const PoseMatrix noisy = with_noise(swing(25, 3, 30), 2, 1);
  const Eigen::MatrixXd E = matrix_of(windows);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(75), count = sum;
  for (std::size_t s = 0; s + 6 <= 25; ++s) {
    Eigen::VectorXd part(18);
    for (std::size_t i = 0; i < 18; ++i) part[i] = noisy.values[s * 3 + i] - bases.mean[i % 3];
    sum.segment(s * 3, 18) += E * (E.transpose() * part);
    count.segment(s * 3, 18).array() += 1;
  }
  PoseMatrix found = noisy;
  found = filter_linearly(found, windows, bases.mean);
  for (std::size_t i = 0; i < 75; ++i) {
    EXPECT_NEAR(found.values[i], bases.mean[i % 3] + sum[i] / count[i], 1e-9);
  }
}

TEST(ExampleFilter, SolvesTheLinearSystemWhereThereIsNoRobustness) {
  const WindowBases bases = random_bases(5, 1, 2, 3, 4);
  const std::size_t frames = 14, size = frames * 2;
  const PoseMatrix y = with_noise(PoseMatrix(frames, 2), 3, 5);
  std::vector<std::uint8_t> observed(size, 1);
  observed[6] = observed[7] = observed[20] = 0;
  const ExampleWeights weights{{1.0, 0.5}, {infinite, infinite}, {0.2, 0.7}, {0.1, 0.2, 0.3}};
  const std::vector<double> mean = {1.0, -2.0};
  PoseMatrix found = y;
  example_filter(found, y, observed, bases, mean, weights, {.iterations = 400, .tolerance = 1e-15});

  // (W + 2 lambda N - 2 A) z = W y, with the columns of the penalty's own matrix.
  std::vector<double> prior = {0.4, 1.4}, ridge = {0.2, 0.4, 0.6};
  PatternPenalty penalty(bases, prior, ridge, frames);
  Eigen::MatrixXd system(size, size);
  PoseMatrix unit(frames, 2), image(frames, 2);
  Eigen::VectorXd right(size);
  for (std::size_t i = 0; i < size; ++i) {
    std::fill(unit.values.begin(), unit.values.end(), 0.0);
    unit.values[i] = 1;
    penalty.multiply(unit, image);
    for (std::size_t j = 0; j < size; ++j) system(j, i) = -image.values[j];
    const double w = observed[i] ? weights.data[i % 2] : 0.0;
    system(i, i) += w + penalty.diagonal(i / 2, i % 2);
    right[i] = w * (y.values[i] - mean[i % 2]);
  }
  const Eigen::VectorXd expected = test::solve_symmetric(system, right);
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_NEAR(found.values[i], expected[i] + mean[i % 2], 1e-6);
  }
}

// Random problems of many kinds: the objective must not rise in any iteration.
TEST(ExampleFilter, NeverRaisesTheObjective) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    const std::size_t channels = 3, frames = 20 + seed;
    const WindowBases bases = random_bases(6, 1 + seed % 3, channels, 2 + seed % 5, seed);
    PoseMatrix y = with_noise(PoseMatrix(frames, channels), 5, seed);
    with_outliers(y, 0.1, seed);
    std::vector<std::uint8_t> observed(y.values.size());
    for (auto& seen : observed) seen = random.uniform() < 0.7;
    const double p = 0.5 + 4 * random.uniform(), lambda = std::exp(2 * random.normal());
    ExampleSettings settings{.iterations = 30, .tolerance = 0};
    if (seed % 2 == 1) settings.solver = ExampleSolver::alternation;
    if (seed % 3 == 1) settings.first_welsch = 16;
    PoseMatrix found = with_noise(y, 3, seed + 100);
    const std::vector<double> objective =
        example_filter(found, y, observed, bases, std::vector<double>(3, 0.5),
                       paper_weights(channels, p, lambda), settings);
    ASSERT_GE(objective.size(), 3u);
    for (std::size_t i = 1; i < objective.size(); ++i) {
      EXPECT_LE(objective[i], objective[i - 1] * (1 + 1e-12)) << seed << ", " << i;
    }
    EXPECT_LT(objective.back(), 0.9 * objective.front());
  }
}

TEST(ExampleFilter, ReachesWhatThePapersAlternationReaches) {
  const FilterBases bases = swing_bases(10, 6);
  PoseMatrix y = with_noise(swing(60, 6, 30), 1, 1);
  with_outliers(y, 0.05, 2);
  const WindowBases windows = bases_at_rate(bases, 30, 30, 60);
  PoseMatrix quick = y, papers = y;
  ExampleSettings settings{.iterations = 3000, .tolerance = 1e-14};
  example_filter(quick, y, {}, windows, bases.mean, paper_weights(6, 3, 0.1), settings);
  settings.solver = ExampleSolver::alternation;
  example_filter(papers, y, {}, windows, bases.mean, paper_weights(6, 3, 0.1), settings);
  EXPECT_LT(rms(quick, papers), 1e-4);
}

TEST(ExampleFilter, ScalesWithTheUnitOfDataAndWelsch) {
  const FilterBases bases = swing_bases(10, 6);
  PoseMatrix y = with_noise(swing(60, 6, 30), 1, 1);
  with_outliers(y, 0.05, 2);
  const WindowBases windows = bases_at_rate(bases, 30, 30, 60);
  const double s = 0.017;
  PoseMatrix scaled = y;
  for (double& value : scaled.values) value *= s;
  std::vector<double> scaled_mean = bases.mean;
  for (double& value : scaled_mean) value *= s;
  PoseMatrix degrees = y, small = scaled;
  const auto objective =
      example_filter(degrees, y, {}, windows, bases.mean, paper_weights(6, 3, 0.1));
  const auto small_objective =
      example_filter(small, scaled, {}, windows, scaled_mean, paper_weights(6, 3 * s, 0.1));
  for (double& value : small.values) value /= s;
  EXPECT_LT(rms(degrees, small), 1e-9);
  EXPECT_NEAR(small_objective.back(), s * s * objective.back(), 1e-9);
}

TEST(ExampleFilter, LeavesNoiseAndOutliersBehind) {
  const FilterBases bases = swing_bases(20, 8);
  const PoseMatrix clean = swing(150, 8, 30, 3.3);
  PoseMatrix y = with_noise(clean, 1, 1);
  const auto hit = with_outliers(y, 0.1, 2);
  PoseMatrix found = y;
  example_filter(found, y, {}, bases_at_rate(bases, 30, 30, 150), bases.mean,
                 paper_weights(8, 3, 1), {.first_welsch = 16});
  const PoseMatrix weights = welsch_weights(found, y, {}, std::vector<double>(8, 3.0));
  EXPECT_GT(rms(y, clean), 8);
  EXPECT_LT(rms(found, clean), 0.3);
  for (std::size_t i = 0; i < hit.size(); ++i) {
    if (hit[i] && std::abs(y.values[i] - clean.values[i]) > 12) {
      EXPECT_LT(weights.values[i], 0.01);
    }
  }
}

TEST(ExampleFilter, FillsChannelsThatWereNeverSeen) {
  const FilterBases bases = swing_bases(20, 8);
  const PoseMatrix clean = swing(150, 8, 30, 3.3);
  PoseMatrix y = with_noise(clean, 0.5, 1);
  std::vector<std::uint8_t> observed(y.values.size(), 1);
  for (std::size_t f = 0; f < y.frames; ++f) {
    for (const std::size_t c : {2, 5, 6}) {
      y(f, c) = 0;
      observed[f * 8 + c] = 0;
    }
  }
  PoseMatrix found = y;
  example_filter(found, y, observed, bases_at_rate(bases, 30, 30, 150), bases.mean,
                 paper_weights(8, 3, 1), {.iterations = 200, .tolerance = 1e-7});
  EXPECT_LT(rms(found, clean), 0.5);
}

TEST(ExampleFilter, NeverLooksAtWhatStandsInAGap) {
  const FilterBases bases = swing_bases(10, 4);
  PoseMatrix y = swing(40, 4, 30), other = y;
  std::vector<std::uint8_t> observed(y.values.size(), 1);
  for (std::size_t i = 50; i < 60; ++i) observed[i] = 0, other.values[i] = 1e6;
  PoseMatrix a = y, b = y;
  const WindowBases windows = bases_at_rate(bases, 30, 30, 40);
  example_filter(a, y, observed, windows, bases.mean, paper_weights(4, 3, 0.1));
  example_filter(b, other, observed, windows, bases.mean, paper_weights(4, 3, 0.1));
  EXPECT_EQ(a.values, b.values);
}

TEST(ExampleFilter, WorksAtTheClipsOwnRate) {
  const FilterBases bases = swing_bases(20, 8);
  for (const double rate : {20.0, 25.0, 60.0, 100.0, 120.0}) {
    const auto frames = static_cast<std::size_t>(5 * rate);
    const PoseMatrix clean = swing(frames, 8, rate, 1.7);
    const PoseMatrix y = with_noise(clean, 1, 1);
    PoseMatrix found = y;
    example_filter(found, y, {}, bases_at_rate(bases, 30, rate, frames), bases.mean,
                   paper_weights(8, 10, 10));
    EXPECT_LT(rms(found, clean), 0.35) << rate;
  }
}

TEST(ExampleFilter, CleansClipsShorterThanAWindow) {
  const FilterBases bases = swing_bases(20, 8);
  for (const std::size_t frames : {1, 2, 5, 19}) {
    const PoseMatrix clean = swing(frames, 8, 30, 1.7);
    const PoseMatrix y = with_noise(clean, 1, 1);
    PoseMatrix found = y;
    example_filter(found, y, {}, bases_at_rate(bases, 30, 30, frames), bases.mean,
                   paper_weights(8, 10, 10));
    EXPECT_LT(rms(found, clean), rms(y, clean)) << frames;
  }
}

PoseMatrix part_of(const PoseMatrix& poses, std::size_t begin, std::size_t end) {
  PoseMatrix part(end - begin, poses.channels);
  std::copy_n(&poses.values[begin * poses.channels], part.values.size(), part.values.begin());
  return part;
}

double largest_difference(const PoseMatrix& a, std::size_t first, const PoseMatrix& b,
                          std::size_t margin) {
  double most = 0;
  for (std::size_t f = margin; f + margin < b.frames; ++f) {
    for (std::size_t c = 0; c < b.channels; ++c)
      most = std::max(most, std::abs(a(first + f, c) - b(f, c)));
  }
  return most;
}

// A take of several stretches, at a rate at which windows are not whole numbers of hops. Near each
// seam the result equals that of the surrounding frames alone.
TEST(ExampleFilter, HasNoSeamsInLongTakes) {
  constexpr std::size_t channels = 64, frames = 9001, hop = 2;
  const FilterBases bases = swing_bases(6, channels, 6);
  const PoseMatrix clean = swing(frames, channels, 60, 0.4);
  PoseMatrix y = with_noise(clean, 1, 3);
  with_outliers(y, 0.02, 4);
  const WindowBases windows = bases_at_rate(bases, 30, 60, frames);
  const Stretches stretches(windows, frames, 2);
  ASSERT_GE(stretches.count(), 3u);
  const ExampleWeights weights = paper_weights(channels, 9, 1);
  const ExampleSettings settings{.iterations = 400, .tolerance = 1e-9};
  const PoseMatrix smooth = filter_linearly(y, windows, bases.mean);
  PoseMatrix found = smooth;
  example_filter(found, y, {}, windows, bases.mean, weights, settings);
  EXPECT_LT(rms(found, clean), 0.5);
  for (std::size_t s = 1; s < stretches.count(); ++s) {
    const std::size_t begin = (stretches.first(s) - 100) / hop * hop, end = begin + 201;
    const PoseMatrix of_part = part_of(y, begin, end);
    const PoseMatrix expected = filter_linearly(of_part, windows, bases.mean);
    EXPECT_LT(largest_difference(smooth, begin, expected, 12), 1e-9) << s;
    PoseMatrix alone = part_of(smooth, begin, end);
    example_filter(alone, of_part, {}, windows, bases.mean, weights, settings);
    EXPECT_LT(largest_difference(found, begin, alone, 60), 0.01) << s;
  }
}

}  // namespace
}  // namespace kinemend
