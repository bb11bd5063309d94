// Tests of running medians, against SciPy, and of sorting networks.
#include <gtest/gtest.h>

#include "signal/median.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
}

std::vector<double> window(const PoseMatrix& m, std::size_t c, std::ptrdiff_t first,
                           std::ptrdiff_t last) {
  std::vector<double> values;
  for (std::ptrdiff_t t = std::max<std::ptrdiff_t>(first, 0);
       t <= std::min<std::ptrdiff_t>(last, static_cast<std::ptrdiff_t>(m.frames) - 1); ++t) {
    values.push_back(m(static_cast<std::size_t>(t), c));
  }
  return values;
}

// By the 0-1 principle, a network that sorts all zeros and ones sorts any values.
TEST(SortingNetwork, SortsEveryWidth) {
  for (std::size_t width = 1; width <= 17; ++width) {
    const auto network = signal::sorting_network(width);
    const auto partial = signal::median_network(width);
    EXPECT_LE(partial.size(), network.size());
    for (std::uint32_t bits = 0; bits < (1u << width); ++bits) {
      std::uint32_t sorted = bits;
      std::uint32_t selected = bits;
      const auto exchange = [](std::uint32_t& word, std::uint32_t low, std::uint32_t high) {
        const std::uint32_t a = word >> low & 1;
        const std::uint32_t b = word >> high & 1;
        word = (word & ~(1u << low) & ~(1u << high)) | (a & b) << low | (a | b) << high;
      };
      for (const auto& [low, high] : network) exchange(sorted, low, high);
      for (const auto& [low, high] : partial) exchange(selected, low, high);
      std::uint32_t ones = 0;
      for (std::size_t k = 0; k < width; ++k) ones += bits >> k & 1;
      const std::uint32_t expected = ones == 0 ? 0 : ((1u << ones) - 1) << (width - ones);
      ASSERT_EQ(sorted, expected) << width;
      ASSERT_EQ(selected >> (width / 2) & 1, expected >> (width / 2) & 1) << width;
    }
  }
}

TEST(Median, GivesTheNumbersOfSciPysMedfiltInside) {
  for (const std::size_t half_window : {1u, 2u, 5u}) {
    PoseMatrix take = column(reference().at("input/long"));
    median_filter(take, half_window);
    const auto& expected = reference().at("medfilt/" + std::to_string(half_window));
    for (std::size_t t = half_window; t + half_window < take.frames; ++t) {
      ASSERT_EQ(take(t, 0), expected[t]) << half_window << ", frame " << t;
    }
  }
}

TEST(Median, ShrinksItsWindowTowardsTheEndsAndFollowsTukeysRuleAtThem) {
  for (const std::size_t frames : {3u, 4u, 7u, 12u, 40u}) {
    for (const std::size_t half_window : {1u, 3u, 8u, 1000u}) {
      const PoseMatrix input = noisy_sines(frames, 3, frames, 1.0);
      PoseMatrix result = input;
      median_filter(result, half_window);
      for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> expected(frames);
        for (std::size_t t = 0; t < frames; ++t) {
          const auto reach =
              static_cast<std::ptrdiff_t>(std::min({half_window, t, frames - 1 - t}));
          const auto centre = static_cast<std::ptrdiff_t>(t);
          expected[t] = median(window(input, c, centre - reach, centre + reach));
        }
        const std::size_t n = frames - 1;
        const double first = median({expected[0], expected[1], 3 * expected[1] - 2 * expected[2]});
        const double last =
            median({expected[n], expected[n - 1], 3 * expected[n - 1] - 2 * expected[n - 2]});
        expected[0] = first;
        expected[n] = last;
        EXPECT_EQ(channel(result, c), expected) << frames << " frames, half window " << half_window;
      }
    }
  }
}

TEST(Median, RemovesSpikesAtTheEndsToo) {
  PoseMatrix take(30, 1);
  for (std::size_t t = 0; t < 30; ++t) take(t, 0) = 0.1 * static_cast<double>(t);
  const PoseMatrix clean = take;
  for (const std::size_t t : {0u, 15u, 29u}) take(t, 0) += 5;
  median_filter(take, 2);
  EXPECT_LT(largest_difference(take.values, clean.values), 0.21);
}

}  // namespace
}  // namespace kinemend::test
