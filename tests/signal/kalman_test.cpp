#include <gtest/gtest.h>

#include <array>

#include "kinemend/error.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

constexpr MotionModel kinds[] = {MotionModel::position, MotionModel::velocity,
                                 MotionModel::acceleration};

// White noise of density q^2 integrated n times has the covariance
// q^2 int_0^min(s,t) (s-u)^(n-1) (t-u)^(n-1) / (n-1)!^2 du, here by Gauss-Legendre, exact for these
// polynomials.
double integrated_noise_covariance(int n, double s, double t) {
  const double nodes[] = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
  const double weights[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  const double factorial = n == 3 ? 2 : 1;
  const double half = std::min(s, t) / 2;
  double sum = 0;
  for (int i = 0; i < 3; ++i) {
    const double u = half * (1 + nodes[i]);
    sum += half * weights[i] * std::pow(s - u, n - 1) * std::pow(t - u, n - 1);
  }
  return sum / (factorial * factorial);
}

std::vector<long double> solve(std::vector<std::vector<long double>> a,
                               std::vector<long double> b) {
  const std::size_t n = b.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < n; ++r) {
      if (std::abs(a[r][i]) > std::abs(a[pivot][i])) pivot = r;
    }
    std::swap(a[i], a[pivot]);
    std::swap(b[i], b[pivot]);
    for (std::size_t r = i + 1; r < n; ++r) {
      const long double factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < n; ++c) a[r][c] -= factor * a[i][c];
      b[r] -= factor * b[i];
    }
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t c = i + 1; c < n; ++c) b[i] -= a[i][c] * b[c];
    b[i] /= a[i][i];
  }
  return b;
}

// The posterior mean of a Gaussian process, integrated white noise plus a polynomial of which
// nothing is known, at every frame, given the samples `times` (universal kriging). No state, no
// recursion.
std::vector<double> dense_posterior(MotionModel kind, double q, double r, double step,
                                    std::size_t frames, const std::vector<std::size_t>& times,
                                    const std::vector<double>& z) {
  const int n = kind == MotionModel::position ? 1 : kind == MotionModel::velocity ? 2 : 3;
  const std::size_t m = times.size();
  const auto unknowns = m + static_cast<std::size_t>(n);
  const auto time_of = [&](std::size_t frame) { return step * static_cast<double>(frame); };
  std::vector<std::vector<long double>> a(unknowns, std::vector<long double>(unknowns, 0));
  std::vector<long double> b(unknowns, 0);
  for (std::size_t i = 0; i < m; ++i) {
    b[i] = z[i];
    for (std::size_t j = 0; j < m; ++j) {
      a[i][j] = q * q * integrated_noise_covariance(n, time_of(times[i]), time_of(times[j]));
    }
    a[i][i] += r * r;
    for (int k = 0; k < n; ++k) a[i][m + k] = a[m + k][i] = std::pow(time_of(times[i]), k);
  }
  const auto weights = solve(a, b);
  std::vector<double> mean;
  for (std::size_t t = 0; t < frames; ++t) {
    long double sum = 0;
    for (std::size_t i = 0; i < m; ++i) {
      sum += q * q * integrated_noise_covariance(n, time_of(t), time_of(times[i])) * weights[i];
    }
    for (int k = 0; k < n; ++k) sum += std::pow(time_of(t), k) * weights[m + k];
    mean.push_back(static_cast<double>(sum));
  }
  return mean;
}

LinearGaussianModel model_of(MotionModel kind, double q, double r, double step = 1) {
  LinearGaussianModel model;
  model.kind = kind;
  model.frame_step_s = step;
  model.process_noise = {q};
  model.measurement_noise = {r};
  return model;
}

struct Pattern {
  std::string name;
  std::vector<std::size_t> missing;
};

const std::vector<Pattern> patterns = {{"whole", {}},
                                       {"gap", {10, 11, 12, 13, 14, 25}},
                                       {"late start", {0, 1, 2}},
                                       {"early end", {30, 31, 32, 33}},
                                       {"both", {0, 5, 6, 33}}};

TEST(KalmanSmoother, IsTheDensePosteriorOfIntegratedWhiteNoise) {
  constexpr std::size_t frames = 34;
  for (const MotionModel kind : kinds) {
    for (const auto& [q, r, step] : std::vector<std::array<double, 3>>{
             {0.3, 0.5, 1}, {0.01, 0.2, 1}, {5, 0.1, 1}, {40, 0.1, 1.0 / 30}}) {
      for (const Pattern& pattern : patterns) {
        const PoseMatrix input = noisy_sines(frames, 1, 3, 0.2);
        std::vector<std::uint8_t> marks(frames, 0);
        for (const std::size_t t : pattern.missing) marks[t] = 1;
        std::vector<std::size_t> times;
        std::vector<double> z;
        for (std::size_t t = 0; t < frames; ++t) {
          if (marks[t]) continue;
          times.push_back(t);
          z.push_back(input(t, 0));
        }
        PoseMatrix result = input;
        for (const std::size_t t : pattern.missing) result(t, 0) = 1e5;
        kalman_smoother(result, model_of(kind, q, r, step), marks);
        const auto expected = dense_posterior(kind, q, r, step, frames, times, z);
        double size = 1;
        for (const double value : expected) size = std::max(size, std::abs(value));
        EXPECT_LT(largest_difference(result.values, expected), 3e-6 * size)
            << pattern.name << ", q " << q << ", kind " << static_cast<int>(kind);
      }
    }
  }
}

TEST(KalmanFilter, IsTheDensePosteriorGivenThePast) {
  constexpr std::size_t frames = 34;
  for (const MotionModel kind : kinds) {
    for (const Pattern& pattern : patterns) {
      const PoseMatrix input = noisy_sines(frames, 1, 3, 0.2);
      std::vector<std::uint8_t> marks(frames, 0);
      for (const std::size_t t : pattern.missing) marks[t] = 1;
      PoseMatrix result = input;
      for (const std::size_t t : pattern.missing) result(t, 0) = 1e5;
      kalman_filter(result, model_of(kind, 0.3, 0.5), marks);
      std::vector<std::size_t> times;
      std::vector<double> z;
      for (std::size_t t = 0; t < frames; ++t) {
        if (!marks[t]) {
          times.push_back(t);
          z.push_back(input(t, 0));
        }
        // A polynomial of n coefficients needs n samples before anything follows from them alone.
        const std::size_t needed = kind == MotionModel::position   ? 1
                                   : kind == MotionModel::velocity ? 2
                                                                   : 3;
        if (times.size() < needed) continue;
        const double expected = dense_posterior(kind, 0.3, 0.5, 1, frames, times, z)[t];
        EXPECT_NEAR(result(t, 0), expected, 3e-6) << pattern.name << ", frame " << t;
      }
      for (std::size_t t = 0; marks[t]; ++t) EXPECT_EQ(result(t, 0), input(times.front(), 0));
    }
  }
}

TEST(KalmanFilter, GivesTheSameBitsFrameByFrame) {
  for (const MotionModel kind : kinds) {
    PoseMatrix input = noisy_sines(300, 45, 4, 0.2);
    std::vector<std::uint8_t> marks(input.values.size(), 0);
    Random random(5);
    // Gaps here and there, and long whole stretches over which the gains settle.
    for (std::size_t i = 45; i < 45 * 40; ++i) marks[i] = random.chance(0.2);
    for (std::size_t i = 45 * 200; i < 45 * 210; ++i) marks[i] = random.chance(0.2);
    PoseMatrix whole = input;
    kalman_filter(whole, model_of(kind, 0.3, 0.5), marks);
    KalmanState state(model_of(kind, 0.3, 0.5), 45);
    for (int round = 0; round < 2; ++round) {
      PoseMatrix stepped = input;
      for (std::size_t t = 0; t < input.frames; ++t) {
        state.step(stepped.row(t), std::span<const std::uint8_t>(marks).subspan(45 * t, 45));
      }
      EXPECT_EQ(stepped.values, whole.values);
      state.reset();
    }
  }
}

TEST(KalmanState, KeepsAChannelsValuesUntilItsFirstSample) {
  KalmanState state(model_of(MotionModel::velocity, 0.1, 1), 2);
  std::vector<double> frame = {5, 6};
  state.step(frame, std::vector<std::uint8_t>{1, 0});
  EXPECT_EQ(frame, (std::vector<double>{5, 6}));
  frame = {8, 6};
  state.step(frame);
  EXPECT_EQ(frame[0], 8);
}

TEST(KalmanSmoother, GivesTheSameWhetherGainsHaveSettledOrNot) {
  // One mark in another channel of the group keeps the gains from being taken as settled for all.
  for (const MotionModel kind : kinds) {
    const PoseMatrix input = noisy_sines(400, 3, 6, 0.2);
    std::vector<std::uint8_t> marks(input.values.size(), 0);
    for (std::size_t t = 0; t < 400; t += 2) marks[3 * t + 1] = 1;
    PoseMatrix with = input;
    kalman_smoother(with, model_of(kind, 0.3, 0.5), marks);
    PoseMatrix without = input;
    kalman_smoother(without, model_of(kind, 0.3, 0.5));
    EXPECT_EQ(channel(with, 0), channel(without, 0));
    EXPECT_EQ(channel(with, 2), channel(without, 2));
    EXPECT_NE(channel(with, 1), channel(without, 1));
  }
}

TEST(Kalman, TakesNoisesChannelByChannel) {
  const PoseMatrix input = noisy_sines(80, 3, 7, 0.2);
  for (const MotionModel kind : kinds) {
    LinearGaussianModel model = model_of(kind, 1, 1, 0.01);
    model.process_noise = {0.5, 20, 100};
    model.measurement_noise = {0.1, 0.2, 0.4};
    PoseMatrix together = input;
    kalman_smoother(together, model);
    for (std::size_t c = 0; c < 3; ++c) {
      PoseMatrix alone = column(channel(input, c));
      kalman_smoother(alone,
                      model_of(kind, model.process_noise[c], model.measurement_noise[c], 0.01));
      EXPECT_EQ(channel(together, c), alone.values);
    }
  }
}

TEST(Kalman, LeavesAChannelWithoutSamplesAsItIs) {
  for (const MotionModel kind : kinds) {
    const PoseMatrix input = noisy_sines(20, 2, 8, 0.2);
    std::vector<std::uint8_t> marks(40, 0);
    for (std::size_t t = 0; t < 20; ++t) marks[2 * t] = 1;
    PoseMatrix smooth = input;
    kalman_smoother(smooth, model_of(kind, 0.3, 0.5), marks);
    EXPECT_EQ(channel(smooth, 0), channel(input, 0));
    PoseMatrix causal = input;
    kalman_filter(causal, model_of(kind, 0.3, 0.5), marks);
    EXPECT_EQ(channel(causal, 0), channel(input, 0));
  }
}

TEST(KalmanSmoother, StaysFiniteAndNearOverAVeryLongGap) {
  for (const MotionModel kind : kinds) {
    PoseMatrix take(5000, 1);
    std::vector<std::uint8_t> marks(5000, 0);
    for (std::size_t t = 0; t < 5000; ++t) {
      take(t, 0) = std::sin(0.001 * static_cast<double>(t));
      marks[t] = t > 1000 && t < 4000;
    }
    kalman_smoother(take, model_of(kind, 1e-4, 0.01), marks);
    for (std::size_t t = 0; t < 5000; ++t) ASSERT_LT(std::abs(take(t, 0)), 50) << t;
    EXPECT_NEAR(take(4100, 0), std::sin(4.1), 0.01);
  }
}

TEST(Kalman, RefusesModelsThatMakeNoSense) {
  PoseMatrix take = noisy_sines(10, 3, 1);
  const auto attempt = [&](const std::function<void(LinearGaussianModel&)>& change) {
    LinearGaussianModel model;
    change(model);
    EXPECT_THROW(kalman_filter(take, model), Error);
    EXPECT_THROW(KalmanState(model, 3), Error);
  };
  attempt([](LinearGaussianModel& m) { m.frame_step_s = 0; });
  attempt([](LinearGaussianModel& m) { m.process_noise = {-1}; });
  attempt([](LinearGaussianModel& m) { m.process_noise = {1, 1}; });
  attempt([](LinearGaussianModel& m) { m.measurement_noise = {0}; });
  attempt([](LinearGaussianModel& m) { m.measurement_noise = {}; });
  attempt([](LinearGaussianModel& m) { m.measurement_noise = {std::nan("")}; });
  EXPECT_THROW(kalman_smoother(take, LinearGaussianModel{}, std::vector<std::uint8_t>(29, 0)),
               Error);
  KalmanState state(LinearGaussianModel{}, 3);
  std::vector<double> frame(2, 0.0);
  EXPECT_THROW(state.step(frame), Error);
}

}  // namespace
}  // namespace kinemend::test
