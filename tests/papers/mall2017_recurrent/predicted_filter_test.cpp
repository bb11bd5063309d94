// Tests of predicted filters, against their equations and numeric derivatives.
#include "papers/mall2017_recurrent/predicted_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/extend/random.hpp"

namespace kinemend {
namespace {

constexpr std::size_t frames = 40, channels = 3;
constexpr std::ptrdiff_t reach = predicted_filter_reach;

struct Case {
  std::vector<float> values, scales, means, outputs;

  FilterSignal signal() const { return {frames, channels, values, scales, means}; }
};

Case random_case(FilterHead head) {
  Random random(11);
  Case c;
  for (std::size_t i = 0; i < frames * channels; ++i)
    c.values.push_back(static_cast<float>(20 * random.normal()));
  for (std::size_t i = 0; i < channels; ++i)
    c.scales.push_back(static_cast<float>(random.uniform(1, 9)));
  for (std::size_t i = 0; i < channels; ++i)
    c.means.push_back(static_cast<float>(30 * random.normal()));
  for (std::size_t i = 0; i < frames * filter_output_count(head, channels); ++i)
    c.outputs.push_back(static_cast<float>(random.uniform(-1, 2.5)));
  return c;
}

std::vector<float> result_of(FilterHead head, const Case& c) {
  std::vector<float> result(c.values.size());
  apply_predicted_filter(head, c.signal(), c.outputs, result);
  return result;
}

// The paper's equations in double precision.
double expected(FilterHead head, const Case& c, std::ptrdiff_t t, std::size_t channel) {
  const std::size_t width = filter_output_count(head, channels);
  const float* o = c.outputs.data() + static_cast<std::size_t>(t) * width;
  const auto x = [&](std::ptrdiff_t f) {
    return static_cast<double>(c.values[static_cast<std::size_t>(f) * channels + channel]);
  };
  if (head == FilterHead::residual)
    return x(t) + static_cast<double>(c.scales[channel] * o[channel]);
  if (head == FilterHead::pose)
    return static_cast<double>(c.means[channel] + c.scales[channel] * o[channel]);
  double sum = 0, total = 0;
  for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
    if (t + k < 0 || t + k >= static_cast<std::ptrdiff_t>(frames)) continue;
    const double deviation = std::exp(static_cast<double>(o[channel]));
    const auto distance = static_cast<double>(k);
    const double weight = head == FilterHead::shape
                              ? std::exp(static_cast<double>(o[k + reach]))
                              : std::exp(-distance * distance / (2 * deviation * deviation));
    sum += weight * x(t + k);
    total += weight;
  }
  const double bias = head == FilterHead::biased
                          ? static_cast<double>(c.scales[channel] * o[channels + channel])
                          : 0;
  return sum / total - bias;
}

class EveryHead : public testing::TestWithParam<FilterHead> {};

TEST_P(EveryHead, DoesWhatTheEquationsSay) {
  const Case c = random_case(GetParam());
  const std::vector<float> result = result_of(GetParam(), c);
  for (std::size_t i = 0; i < result.size(); ++i)
    EXPECT_NEAR(result[i],
                expected(GetParam(), c, static_cast<std::ptrdiff_t>(i / channels), i % channels),
                2e-4)
        << "number " << i;
}

TEST_P(EveryHead, HasTheDerivativeOfItsDifferences) {
  const Case c = random_case(GetParam());
  Random random(12);
  std::vector<float> weights(c.values.size()), gradient(c.outputs.size());
  for (float& weight : weights) weight = static_cast<float>(random.normal());
  predicted_filter_adjoint(GetParam(), c.signal(), c.outputs, weights, gradient);
  for (std::size_t i = 0; i < gradient.size(); i += 7) {
    double change = 0;
    for (const float sign : {-1.0F, 1.0F}) {
      Case moved = c;
      moved.outputs[i] += sign * 1e-2F;
      const std::vector<float> result = result_of(GetParam(), moved);
      for (std::size_t k = 0; k < result.size(); ++k)
        change += static_cast<double>(sign * weights[k] * result[k]);
    }
    EXPECT_NEAR(gradient[i], change / 2e-2, 2e-2 * (1 + std::abs(change / 2e-2))) << "output " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Heads, EveryHead,
                         testing::Values(FilterHead::gaussian, FilterHead::biased,
                                         FilterHead::shape, FilterHead::residual,
                                         FilterHead::pose));

TEST(PredictedFilter, OfTheLeastDeviationLeavesTheTakeAsItIs) {
  Case c = random_case(FilterHead::gaussian);
  std::fill(c.outputs.begin(), c.outputs.end(), -100.0F);
  EXPECT_EQ(result_of(FilterHead::gaussian, c), c.values);
}

}  // namespace
}  // namespace kinemend
