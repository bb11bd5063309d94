// Tests of the methods `kalman`, `butterworth`, `weighted-mean`, `wavelet` and `one-euro`, against
// their definitions on single axes.
#include <gtest/gtest.h>

#include <cmath>

#include "classic/track_kalman.hpp"
#include "kinemend/clean.hpp"
#include "kinemend/extend/method_options.hpp"
#include "kinemend/extend/signal.hpp"
#include "registry/takes.hpp"

namespace kinemend::test {
namespace {

std::vector<Vec3> noisy_points(std::size_t count, Random& random) {
  std::vector<Vec3> points;
  for (std::size_t f = 0; f < count; ++f) {
    const double t = static_cast<double>(f) / 100;
    points.push_back({std::sin(3 * t) + 0.1 * random.normal(), t + 0.1 * random.normal(), 0});
  }
  return points;
}

KalmanModel model_of(bool with_velocity) {
  return {with_velocity, 0.01, with_velocity ? 40.0 : 3.0};
}

using Matrix = std::vector<std::vector<double>>;

// Gaussian elimination with pivoting.
std::vector<double> solve(Matrix a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t r = k; r < n; ++r) {
      if (std::fabs(a[r][k]) > std::fabs(a[pivot][k])) pivot = r;
    }
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t r = k + 1; r < n; ++r) {
      const double factor = a[r][k] / a[k][k];
      for (std::size_t c = k; c < n; ++c) a[r][c] -= factor * a[k][c];
      b[r] -= factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t c = k + 1; c < n; ++c) b[k] -= a[k][c] * b[c];
    b[k] /= a[k][k];
  }
  return b;
}

// Adds the squared residual of sum_i row[i] s[first + i], with unit variance.
void add_residual(Matrix& a, std::size_t first, const std::vector<double>& row) {
  for (std::size_t r = 0; r < row.size(); ++r) {
    for (std::size_t c = 0; c < row.size(); ++c) a[first + r][first + c] += row[r] * row[c];
  }
}

// Maximum a posteriori estimate of the whole track as one dense least-squares problem: the states
// (x, v) of all frames, the prior of the first one, the process, and the measurements.
std::vector<double> batch_estimate(const std::vector<double>& z,
                                   const std::vector<std::uint8_t>& seen, double noise,
                                   const KalmanModel& m) {
  const std::size_t n = z.size();
  Matrix a(2 * n, std::vector<double>(2 * n));
  std::vector<double> b(2 * n);
  const double dt = m.frame_step_s, q = m.process_density;
  a[1][1] += 1e-4;  // velocity prior of 100
  for (std::size_t i = 0; i < n; ++i) {
    if (seen[i]) {
      a[2 * i][2 * i] += 1 / (noise * noise);
      b[2 * i] += z[i] / (noise * noise);
    }
    if (i == 0) continue;
    const std::size_t first = 2 * i - 2;  // x, v before; x, v now
    if (m.with_velocity) {
      // The covariance of the step is L L^T with L = (l11 0; l21 l22), whitened by L^-1.
      const double l11 = std::sqrt(q * dt * dt * dt / 3), l21 = q * dt * dt / 2 / l11;
      const double l22 = std::sqrt(q * dt - l21 * l21);
      const std::vector<double> x{-1 / l11, -dt / l11, 1 / l11, 0};
      std::vector<double> v{0, -1, 0, 1};
      for (std::size_t k = 0; k < 4; ++k) v[k] = (v[k] - l21 * x[k]) / l22;
      add_residual(a, first, x);
      add_residual(a, first, v);
    } else {
      const double w = 1 / std::sqrt(q * dt);
      add_residual(a, first, {-w, 0, w, 0});
      a[2 * i + 1][2 * i + 1] += 1;  // this model has no velocity
    }
  }
  const std::vector<double> states = solve(a, b);
  std::vector<double> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(states[2 * i]);
  return result;
}

TEST(Kalman, SmoothsPointsAsOneLeastSquaresProblemWouldAndFillsWhatIsMissing) {
  Random random(1);
  const std::vector<Vec3> points = noisy_points(60, random);
  std::vector<double> x, y;
  for (const Vec3& p : points) x.push_back(p.x), y.push_back(p.y);
  std::vector<std::uint8_t> seen(60, 1);
  for (std::size_t f = 25; f < 33; ++f) seen[f] = 0;
  for (const bool with_velocity : {false, true}) {
    const KalmanModel model = model_of(with_velocity);
    const auto smooth = kalman_smooth<Vec3>(points, seen, 0.1, 1, model);
    const auto expected_x = batch_estimate(x, seen, 0.1, model);
    const auto expected_y = batch_estimate(y, seen, 0.1, model);
    for (std::size_t f = 0; f < 60; ++f) {
      EXPECT_NEAR(smooth[f].x, expected_x[f], 1e-6) << f;
      EXPECT_NEAR(smooth[f].y, expected_y[f], 1e-6) << f;
    }
  }
}

TEST(Kalman, OfTurnsAboutOneAxisIsTheKalmanSmootherOfTheAngle) {
  Random random(2);
  const Vec3 axis{2.0 / 7, 3.0 / 7, 6.0 / 7};
  std::vector<Quat> turns;
  std::vector<Vec3> angles;
  for (const Vec3& p : noisy_points(80, random)) {
    angles.push_back({3 * p.y + p.x, 0, 0});  // through pi
    turns.push_back(exp(angles.back().x * axis));
  }
  for (const bool with_velocity : {false, true}) {
    const KalmanModel model = model_of(with_velocity);
    const auto smooth = kalman_smooth<Quat>(turns, {}, 0.1, 1, model);
    const auto expected = kalman_smooth<Vec3>(angles, {}, 0.1, 1, model);
    for (std::size_t f = 0; f < 80; ++f) {
      EXPECT_LT(angle_between(smooth[f], exp(expected[f].x * axis)), 1e-9) << f;
    }
  }
}

TEST(Kalman, IsTheSameInAnyCoordinateFrame) {
  Take clip = moving_take(120, 120), turned = clip;
  add_noise(clip, 1.5, 0, 3);
  const Quat left = exp({1, 0.4, -2}), right = exp({0.3, -1, 1});
  for (std::size_t f = 0; f < 120; ++f) turned.rotation(f, 1) = left * clip.rotation(f, 1) * right;
  const auto cleaner = make_kalman();
  clean_in_place(*cleaner, clip);
  clean_in_place(*cleaner, turned);
  for (std::size_t f = 0; f < 120; ++f) {
    ASSERT_LT(angle_between(turned.rotation(f, 1), left * clip.rotation(f, 1) * right), 1e-9);
  }
}

TEST(Kalman, EstimatesTheNoiseAndSmoothsByIt) {
  for (const double noise_deg : {0.2, 1.0, 3.0}) {
    const Take truth = moving_take(400, 120);
    Take clip = truth;
    add_noise(clip, noise_deg, 0, 4);
    const CleanResult result = clean_take(clip, *make_kalman());
    EXPECT_NEAR(result.report.tracks[1].noise, noise_deg, 0.2 * noise_deg);
    EXPECT_LT(rms_angle_deg(result.take, truth), 0.7 * rms_angle_deg(clip, truth)) << noise_deg;
  }
}

TEST(Kalman, RunningLiveLearnsTheNoiseOnTheWay) {
  const Take truth = moving_take(1200, 120);
  Take clip = truth;
  add_noise(clip, 1.0, 0, 5);
  const Take live = clean_take(clip, *make_kalman({.smoother = false})).take;
  const Take given = clean_take(clip, *make_kalman({.smoother = false, .noise_deg = 1.0})).take;
  const Take late = slice(truth, 300, 1200);
  EXPECT_NEAR(rms_angle_deg(slice(live, 300, 1200), late),
              rms_angle_deg(slice(given, 300, 1200), late), 0.1);
  EXPECT_LT(rms_angle_deg(slice(live, 300, 1200), late),
            0.8 * rms_angle_deg(slice(clip, 300, 1200), late));
}

// The gain of a small swing of joint 1: its amplitude after cleaning over that before.
double gain_at(const Cleaner& cleaner, double frequency_hz) {
  Take clip = empty_take(1200, 120);
  for (std::size_t f = 0; f < 1200; ++f) {
    const double phase = 2 * pi * frequency_hz * static_cast<double>(f) / 120;
    clip.rotation(f, 1) = exp({0.02 * std::sin(phase), 0, 0});
    clip.root_position(f) = {3 * std::sin(phase), 0, 0};
  }
  clean_in_place(cleaner, clip);
  double turn = 0, shift = 0;
  for (std::size_t f = 300; f < 900; ++f) {
    turn = std::max(turn, std::fabs(log(clip.rotation(f, 1)).x));
    shift = std::max(shift, std::fabs(clip.root_position(f).x));
  }
  EXPECT_NEAR(turn / 0.02, shift / 3, 0.01);
  return turn / 0.02;
}

TEST(Butterworth, LetsHalfTheAmplitudePassAtItsCutoffBothWaysAndSevenTenthsOneWay) {
  EXPECT_NEAR(gain_at(*make_butterworth({.cutoff_hz = 8}), 8), 0.5, 0.01);
  EXPECT_NEAR(gain_at(*make_butterworth({.cutoff_hz = 8, .causal = true}), 8), std::sqrt(0.5),
              0.01);
  EXPECT_NEAR(gain_at(*make_butterworth({.order = 2, .cutoff_hz = 8}), 4),
              1 / (1 + std::pow(0.5, 4)), 0.02);
  EXPECT_GT(gain_at(*make_butterworth({.cutoff_hz = 8}), 2), 0.999);
  EXPECT_LT(gain_at(*make_butterworth({.cutoff_hz = 8}), 24), 0.01);
}

TEST(Butterworth, SaysThatThereIsNothingToDoAboveHalfTheRate) {
  const Take clip = moving_take(60, 12);
  const CleanResult result = clean_take(clip, *make_butterworth({.cutoff_hz = 6}));
  EXPECT_EQ(result.take.rotations, clip.rotations);
  ASSERT_EQ(result.report.warnings.size(), 1U);
  EXPECT_NE(result.report.warnings[0].find("6.00 Hz is not below the Nyquist frequency of 6.00 Hz"),
            std::string::npos);
}

TEST(Butterworth, IsTheSameInAnyCoordinateFrameAndThroughEveryTurn) {
  Take clip = empty_take(240, 120), still = clip;
  Random random(6);
  for (std::size_t f = 0; f < 240; ++f) {
    const Vec3 v{random.normal(), random.normal(), random.normal()};
    still.rotation(f, 1) = exp(0.02 * v);
    clip.rotation(f, 1) = exp({0, 3.1, 0.4}) * exp(0.02 * v) * exp({2, 0, 1});
  }
  const auto cleaner = make_butterworth();
  clean_in_place(*cleaner, clip);
  clean_in_place(*cleaner, still);
  for (std::size_t f = 0; f < 240; ++f) {
    const Quat expected = exp({0, 3.1, 0.4}) * still.rotation(f, 1) * exp({2, 0, 1});
    ASSERT_LT(angle_between(clip.rotation(f, 1), expected), 1e-9);
  }
}

TEST(WeightedMean, OfSmallTurnsIsThatOfTheAngles) {
  Random random(7);
  Take clip = empty_take(80, 30);
  PoseMatrix angles(80, 1);
  for (std::size_t f = 0; f < 80; ++f) {
    angles(f, 0) = 1e-3 * random.normal();
    clip.rotation(f, 2) = exp({0, angles(f, 0), 0});
  }
  weighted_mean_filter(angles, 3);
  clean_in_place(*make_weighted_mean({.passes = 3}), clip);
  for (std::size_t f = 0; f < 80; ++f) EXPECT_NEAR(log(clip.rotation(f, 2)).y, angles(f, 0), 1e-8);
}

TEST(Wavelet, ThresholdsEveryChannelOfTheTangentSpace) {
  Random random(8);
  Take clip = empty_take(256, 120);
  PoseMatrix angles(256, 1);
  for (std::size_t f = 0; f < 256; ++f) {
    angles(f, 0) = 0.3 * std::sin(0.05 * static_cast<double>(f)) + 0.02 * random.normal();
    clip.rotation(f, 1) = exp({angles(f, 0), 0, 0});
  }
  const double reference = log(chordal_mean([&] {
                             std::vector<Quat> track;
                             for (std::size_t f = 0; f < 256; ++f)
                               track.push_back(clip.rotation(f, 1));
                             return track;
                           }()))
                               .x;
  for (double& v : angles.values) v -= reference;
  wavelet_denoise(angles, {.family = WaveletFamily::daubechies,
                           .vanishing_moments = 3,
                           .threshold = WaveletThreshold::universal});
  clean_in_place(*make_wavelet({.family = "db3", .threshold = "universal"}), clip);
  for (std::size_t f = 0; f < 256; ++f) {
    EXPECT_NEAR(log(clip.rotation(f, 1)).x - reference, angles(f, 0), 1e-9) << f;
  }
}

// The filter of Casiez et al. on plain numbers, written from the paper.
std::vector<double> one_euro(const std::vector<double>& x, double rate, double min_cutoff,
                             double beta, double speed_cutoff) {
  const auto alpha = [rate](double cutoff) { return 1 / (1 + rate / (2 * pi * cutoff)); };
  std::vector<double> y{x[0]};
  double speed = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    speed += alpha(speed_cutoff) * ((x[i] - x[i - 1]) * rate - speed);
    const double a = alpha(min_cutoff + beta * std::fabs(speed));
    y.push_back(a * x[i] + (1 - a) * y.back());
  }
  return y;
}

TEST(OneEuro, OfTurnsAboutOneAxisIsTheFilterOfThePaper) {
  Random random(9);
  Take clip = empty_take(200, 60);
  std::vector<double> angles;
  for (std::size_t f = 0; f < 200; ++f) {
    angles.push_back(5 * std::sin(0.03 * static_cast<double>(f)) + 0.02 * random.normal());
    clip.rotation(f, 1) = exp({0, 0, angles.back()});
  }
  clean_in_place(
      *make_one_euro({.min_cutoff_hz = 1.2, .speed_coefficient = 3, .speed_cutoff_hz = 5}), clip);
  const auto expected = one_euro(angles, 60, 1.2, 3, 5);
  for (std::size_t f = 0; f < 200; ++f) {
    EXPECT_LT(angle_between(clip.rotation(f, 1), exp({0, 0, expected[f]})), 1e-9) << f;
  }
}

TEST(OneEuro, SteadiesAPoseThatIsHeldAndFollowsAFastOne) {
  Random random(10);
  Take clip = empty_take(400, 120), truth = clip;
  for (std::size_t f = 0; f < 400; ++f) {
    const double angle = f < 200 ? 0 : 0.05 * static_cast<double>(f - 200);
    truth.rotation(f, 1) = exp({angle, 0, 0});
    clip.rotation(f, 1) =
        truth.rotation(f, 1) * exp({0.01 * random.normal(), 0.01 * random.normal(), 0});
  }
  const Take input = clip;
  clean_in_place(*make_one_euro(), clip);
  EXPECT_LT(rms_angle_deg(slice(clip, 20, 200), slice(truth, 20, 200)),
            0.6 * rms_angle_deg(slice(input, 20, 200), slice(truth, 20, 200)));
  EXPECT_LT(angle_between(clip.rotation(399, 1), truth.rotation(399, 1)) * degrees_per_radian, 3);
}

TEST(Chains, TurningThroughHalfTurnsAndGimbalLockComeOutUnderHalfADegree) {
  Take truth = empty_take(480, 120);
  for (std::size_t f = 0; f < 480; ++f) {
    const double t = static_cast<double>(f) / 120;
    for (const std::size_t j : {0, 1, 2}) {
      const double yaw = pi + 2.5 * std::sin(1.5 * t + static_cast<double>(j));
      const double pitch = 88 * radians_per_degree * std::sin(1.1 * t);
      truth.rotation(f, j) = from_euler({yaw, pitch, 0.2 * t}, parse_rotation_order("YXZ"));
    }
  }
  Take noisy = truth;
  add_noise(noisy, 1, 0, 11);
  for (const char* method : {"butterworth", "weighted-mean", "kalman", "wavelet"}) {
    OptionValues options;
    if (std::string(method) == "butterworth") options["cutoff_hz"] = 5.0;
    if (std::string(method) == "weighted-mean") options["passes"] = std::int64_t{10};
    if (std::string(method) == "kalman") options["agility"] = 0.2;
    const Take clip = clean_take(noisy, *make_cleaner(method, options)).take;
    double sum = 0;
    for (std::size_t f = 0; f < 480; ++f) {
      for (const std::size_t j : {0, 1, 2})
        sum += std::pow(angle_between(clip.rotation(f, j), truth.rotation(f, j)), 2);
    }
    EXPECT_LT(std::sqrt(sum / (3 * 480)) * degrees_per_radian,
              std::string(method) == "wavelet" ? 0.7 : 0.6)
        << method;
  }
}

}  // namespace
}  // namespace kinemend::test
