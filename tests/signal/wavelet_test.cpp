// Tests of wavelet filters, transform and shrinkage, against matrices and published tables.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "kinemend/error.hpp"
#include "signal/support.hpp"
#include "signal/wavelet.hpp"

namespace kinemend::test {
namespace {

constexpr auto daubechies = WaveletFamily::daubechies;
constexpr auto symlet = WaveletFamily::symlet;

template <class Work>
void for_each_wavelet(const Work& work) {
  for (int moments = 1; moments <= 10; ++moments) work(daubechies, moments);
  for (int moments = 2; moments <= 10; ++moments) work(symlet, moments);
}

TEST(WaveletFilter, IsOrthonormalToItsEvenShiftsAndSumsToRootTwo) {
  for_each_wavelet([](WaveletFamily family, int moments) {
    const auto h = wavelet_filter(family, moments);
    ASSERT_EQ(h.size(), static_cast<std::size_t>(2 * moments));
    double sum = 0;
    for (const double value : h) sum += value;
    EXPECT_NEAR(sum, std::numbers::sqrt2, 1e-14);
    for (std::size_t shift = 0; shift < h.size(); shift += 2) {
      double product = 0;
      for (std::size_t k = 0; k + shift < h.size(); ++k) product += h[k] * h[k + shift];
      EXPECT_NEAR(product, shift == 0 ? 1 : 0, 1e-14) << moments << ", shift " << shift;
    }
  });
}

TEST(WaveletFilter, HasAsManyVanishingMomentsAsItsNameSays) {
  for_each_wavelet([](WaveletFamily family, int moments) {
    const auto h = wavelet_filter(family, moments);
    const double centre = static_cast<double>(h.size() - 1) / 2;
    for (int power = 0; power < moments; ++power) {
      double moment = 0;
      double size = 0;
      for (std::size_t k = 0; k < h.size(); ++k) {
        const double term = std::pow((static_cast<double>(k) - centre) / centre, power) * h[k];
        moment += k % 2 == 0 ? term : -term;
        size += std::abs(term);
      }
      EXPECT_LT(std::abs(moment), 1e-12 * size) << moments << ", power " << power;
    }
    double next = 0;
    for (std::size_t k = 0; k < h.size(); ++k) {
      const double term = std::pow((static_cast<double>(k) - centre) / centre, moments) * h[k];
      next += k % 2 == 0 ? term : -term;
    }
    EXPECT_GT(std::abs(next), 1e-12) << moments;
  });
}

TEST(WaveletFilter, OfDaubechiesHasTheNumbersOfSciPy) {
  for (int moments = 1; moments <= 10; ++moments) {
    EXPECT_LT(largest_difference(wavelet_filter(daubechies, moments),
                                 reference().at("daub/" + std::to_string(moments))),
              1e-7)  // precision of SciPy's root finding at 10
        << moments;
  }
}

double phase_bend(const std::vector<double>& h) {
  constexpr int steps = 512;
  std::vector<double> phase;
  for (int i = 0; i < steps; ++i) {  // short of pi, where the response vanishes
    const double w = 0.8 * std::numbers::pi * i / steps;
    std::complex<double> sum = 0;
    for (std::size_t k = 0; k < h.size(); ++k)
      sum += h[k] * std::polar(1.0, -w * static_cast<double>(k));
    double angle = std::arg(sum);
    if (!phase.empty()) {
      const double turn = 2 * std::numbers::pi;
      angle += turn * std::round((phase.back() - angle) / turn);
    }
    phase.push_back(angle);
  }
  // Residual of the best line through 0.
  double xy = 0;
  double xx = 0;
  for (int i = 0; i < steps; ++i) {
    xy += i * phase[static_cast<std::size_t>(i)];
    xx += static_cast<double>(i) * i;
  }
  double bend = 0;
  for (int i = 0; i < steps; ++i) {
    const double rest = phase[static_cast<std::size_t>(i)] - xy / xx * i;
    bend += rest * rest;
  }
  return bend;
}

TEST(WaveletFilter, OfASymletIsNearerToLinearPhaseAndOtherwiseTheSameAsDaubechies) {
  for (int moments = 4; moments <= 10; ++moments) {
    const auto d = wavelet_filter(daubechies, moments);
    const auto s = wavelet_filter(symlet, moments);
    EXPECT_LT(phase_bend(s), 0.3 * phase_bend(d)) << moments;
    for (std::size_t shift = 0; shift < d.size(); ++shift) {
      double of_d = 0;
      double of_s = 0;
      for (std::size_t k = 0; k + shift < d.size(); ++k) {
        of_d += d[k] * d[k + shift];
        of_s += s[k] * s[k + shift];
      }
      EXPECT_NEAR(of_d, of_s, 1e-13);
    }
  }
}

TEST(WaveletFilter, OfFourMomentsIsThatOfTenLecturesTable6_3) {
  // The book's least asymmetric filter for N = 4, scaled to sum sqrt(2) instead of 2, in reverse
  // order.
  const double table[] = {-0.107148901418, -0.041910965125, 0.703739068656,  1.136658243408,
                          0.421234534204,  -0.140317624179, -0.017824701442, 0.045570345896};
  const auto s = wavelet_filter(symlet, 4);
  for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(s[k], table[k] / std::numbers::sqrt2, 1e-11);
}

TEST(WaveletFilter, RefusesFamiliesItDoesNotHave) {
  EXPECT_THROW(wavelet_filter(daubechies, 0), Error);
  EXPECT_THROW(wavelet_filter(daubechies, 11), Error);
  EXPECT_THROW(wavelet_filter(symlet, 1), Error);
}

TEST(WaveletTransform, GivesBackEverySignalOfEveryLength) {
  for_each_wavelet([](WaveletFamily family, int moments) {
    const auto h = wavelet_filter(family, moments);
    for (const std::size_t frames : {1u, 2u, 3u, 4u, 5u, 16u, 33u, 100u}) {
      for (const int levels : {1, 2, 5}) {
        const PoseMatrix input = noisy_sines(frames, 3, frames, 1.0);
        PoseMatrix output(frames, 3);
        signal::inverse_transform(signal::forward_transform(input, h, levels), h, output);
        ASSERT_LT(largest_difference(output.values, input.values), 1e-11)
            << moments << ", " << frames << " frames, " << levels << " levels";
      }
    }
  });
}

// One level as a matrix: reflect, filter, and keep every second row. Reflection by repeated
// mirroring, the mirror filter and the positions are implemented independently.
std::vector<double> dense_level(const std::vector<double>& x, const std::vector<double>& filter) {
  const auto n = static_cast<int>(x.size());
  const auto taps = static_cast<int>(filter.size());
  const int count = (n + taps - 1) / 2;
  std::vector<std::vector<double>> matrix(static_cast<std::size_t>(count),
                                          std::vector<double>(x.size(), 0));
  const std::function<void(std::vector<double>&, int, double)> add = [&](std::vector<double>& row,
                                                                         int t, double weight) {
    if (n == 1) t = 0;
    if (t < 0) {
      add(row, 0, 2 * weight);
      add(row, -t, -weight);
    } else if (t >= n) {
      add(row, n - 1, 2 * weight);
      add(row, 2 * (n - 1) - t, -weight);
    } else {
      row[static_cast<std::size_t>(t)] += weight;
    }
  };
  std::vector<double> y;
  for (int k = 0; k < count; ++k) {
    auto& row = matrix[static_cast<std::size_t>(k)];
    for (int j = 0; j < taps; ++j)
      add(row, 2 * k - (taps - 2) + j, filter[static_cast<std::size_t>(j)]);
    double sum = 0;
    for (std::size_t t = 0; t < x.size(); ++t) sum += row[t] * x[t];
    y.push_back(sum);
  }
  return y;
}

TEST(WaveletTransform, IsTheMatrixOfReflectedFilters) {
  for (const auto& [family, moments] : std::vector<std::pair<WaveletFamily, int>>{
           {daubechies, 1}, {daubechies, 3}, {symlet, 4}, {symlet, 8}}) {
    const auto h = wavelet_filter(family, moments);
    std::vector<double> g(h.rbegin(), h.rend());
    for (std::size_t j = 1; j < g.size(); j += 2) g[j] = -g[j];
    for (const std::size_t frames : {2u, 5u, 24u, 61u}) {
      const PoseMatrix input = noisy_sines(frames, 1, 7, 1.0);
      const auto transform = signal::forward_transform(input, h, 3);
      std::vector<double> smooth = input.values;
      for (std::size_t level = 0; level < 3; ++level) {
        EXPECT_LT(largest_difference(transform.details[level].values, dense_level(smooth, g)),
                  1e-11);
        smooth = dense_level(smooth, h);
      }
      EXPECT_LT(largest_difference(transform.smooth.values, smooth), 1e-11);
    }
  }
}

TEST(WaveletTransform, KnowsWhichCoefficientsSeeNoReflection) {
  for (const std::size_t taps : {2u, 4u, 8u}) {
    const auto h = wavelet_filter(daubechies, static_cast<int>(taps / 2));
    for (const std::size_t frames : {8u, 13u, 40u}) {
      const auto range = signal::inner_coefficients(frames, taps);
      // Coefficients outside the range depend on the reflections at the ends, so they differ from
      // those of a longer take.
      const PoseMatrix longer = noisy_sines(frames + 40, 1, 3, 1.0);
      PoseMatrix part(frames, 1);
      std::copy_n(longer.values.begin() + 20, frames, part.values.begin());
      const auto whole = signal::forward_transform(longer, h, 1).details[0];
      const auto cut = signal::forward_transform(part, h, 1).details[0];
      for (std::size_t k = 0; k < cut.frames; ++k) {
        const bool inner = k >= range.first && k < range.first + range.count;
        const double difference = std::abs(cut(k, 0) - whole(k + 10, 0));
        if (inner) {
          EXPECT_LT(difference, 1e-13);
        } else {
          EXPECT_GT(difference, 1e-9);
        }
      }
    }
  }
  EXPECT_EQ(signal::inner_coefficients(3, 8).count, 5u);
}

TEST(WaveletDenoise, ThresholdsAsDonohoAndJohnstoneDo) {
  // Implements the whole method directly on top of the transform. Random jumps give all levels
  // signal as well as noise.
  PoseMatrix input = noisy_sines(200, 1, 21, 0.1);
  Random random(22);
  double jump = 0;
  for (double& value : input.values) {
    if (random.chance(0.05)) jump = random.uniform(-1, 1);
    value += jump;
  }
  std::size_t minimised = 0;
  std::size_t kept = 0;
  for (const auto threshold : {WaveletThreshold::universal, WaveletThreshold::sure}) {
    for (const auto shrinkage : {WaveletShrinkage::soft, WaveletShrinkage::hard}) {
      const auto h = wavelet_filter(symlet, 4);
      auto transform = signal::forward_transform(input, h, 3);
      double sigma = 0;
      for (std::size_t level = 0; level < 3; ++level) {
        auto& d = transform.details[level].values;
        const auto range = signal::inner_coefficients(transform.lengths[level], h.size());
        std::vector<double> inner(
            d.begin() + static_cast<std::ptrdiff_t>(range.first),
            d.begin() + static_cast<std::ptrdiff_t>(range.first + range.count));
        const auto n = static_cast<double>(inner.size());
        if (level == 0) {
          std::vector<double> sizes = inner;
          for (double& x : sizes) x = std::abs(x);
          std::sort(sizes.begin(), sizes.end());
          const std::size_t half = sizes.size() / 2;
          sigma = (sizes.size() % 2 ? sizes[half] : (sizes[half] + sizes[half - 1]) / 2) *
                  1.482602218505602;
        }
        double limit = std::sqrt(2 * std::log(200.0));
        if (threshold == WaveletThreshold::sure) {
          const double universal = std::sqrt(2 * std::log(n));
          double energy = 0;
          for (const double x : inner) energy += x * x / (sigma * sigma);
          limit = universal;
          if (energy / n - 1 > std::pow(std::log2(n), 1.5) / std::sqrt(n)) {
            // SURE(t) = n - 2 #{|x| <= t} + sum min(|x|, t)^2, at 0 and at each |x|.
            ++minimised;
            double least = n;
            limit = 0;
            for (const double candidate : inner) {
              const double t = std::abs(candidate / sigma);
              if (t > universal) continue;
              double risk = n;
              for (const double x : inner) {
                const double size = std::abs(x / sigma);
                if (size <= t) risk -= 2;
                risk += std::min(size, t) * std::min(size, t);
              }
              if (risk < least) {
                least = risk;
                limit = t;
              }
            }
          }
        }
        for (double& x : d) {
          if (std::abs(x) <= limit * sigma) {
            x = 0;
          } else if (shrinkage == WaveletShrinkage::soft) {
            ++kept;
            x -= std::copysign(limit * sigma, x);
          }
        }
      }
      PoseMatrix expected(200, 1);
      signal::inverse_transform(std::move(transform), h, expected);
      PoseMatrix result = input;
      WaveletOptions options;
      options.threshold = threshold;
      options.shrinkage = shrinkage;
      options.levels = 3;
      wavelet_denoise(result, options);
      EXPECT_LT(largest_difference(result.values, expected.values), 1e-11);
    }
  }
  EXPECT_GE(minimised, 4u);
  EXPECT_GE(kept, 20u);
}

TEST(WaveletDenoise, LeavesASignalWithoutNoiseNearlyAlone) {
  PoseMatrix parabola(300, 1);
  for (std::size_t t = 0; t < 300; ++t) {
    const double x = static_cast<double>(t) / 100;
    parabola(t, 0) = x * x;
  }
  PoseMatrix result = parabola;
  wavelet_denoise(result);
  EXPECT_LT(largest_difference(result.values, parabola.values), 1e-4);
}

TEST(WaveletDenoise, WithoutNoiseScaleChangesNothing) {
  const PoseMatrix input = noisy_sines(100, 2, 3);
  PoseMatrix result = input;
  WaveletOptions options;
  options.noise_scale = 0;
  wavelet_denoise(result, options);
  EXPECT_EQ(result.values, input.values);
}

TEST(WaveletDenoise, RefusesOptionsThatMakeNoSense) {
  PoseMatrix take = noisy_sines(20, 1, 1);
  const auto attempt = [&](const std::function<void(WaveletOptions&)>& change) {
    WaveletOptions options;
    change(options);
    EXPECT_THROW(wavelet_denoise(take, options), Error);
  };
  attempt([](WaveletOptions& o) { o.levels = -1; });
  attempt([](WaveletOptions& o) { o.levels = 21; });
  attempt([](WaveletOptions& o) { o.vanishing_moments = 11; });
  attempt([](WaveletOptions& o) { o.noise_scale = -1; });
  attempt([](WaveletOptions& o) { o.noise_scale = std::nan(""); });
}

}  // namespace
}  // namespace kinemend::test
