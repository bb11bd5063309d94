// Properties of every filter of channels.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstring>

#include "signal/support.hpp"

namespace kinemend::test {
namespace {

struct Filter {
  std::string name;
  std::function<void(PoseMatrix&)> apply;
  bool linear = true;
  bool keeps_lines = true;     // within `line_tolerance`
  bool time_symmetric = true;  // up to rounding, including the ends
  std::size_t reach = 0;       // frames on each side that affect a sample; 0: all
  double line_tolerance = 1e-10;
};

WaveletOptions wavelet(WaveletThreshold threshold, WaveletShrinkage shrinkage) {
  WaveletOptions options;
  options.threshold = threshold;
  options.shrinkage = shrinkage;
  return options;
}

std::vector<Filter> all_filters() {
  const auto order_4 = butterworth_lowpass(4, 10, 120);
  const std::size_t settled = settling_frames(order_4, 1e-13);
  using Wt = WaveletThreshold;
  using Ws = WaveletShrinkage;
  std::vector<Filter> filters;
  const auto add = [&](std::string name, std::function<void(PoseMatrix&)> apply) -> Filter& {
    filters.push_back({std::move(name), std::move(apply)});
    return filters.back();
  };
  add("gaussian", [](PoseMatrix& m) { gaussian_filter(m, 2.0); }).reach = 8;
  add("wide gaussian", [](PoseMatrix& m) { gaussian_filter(m, 30.0); });
  {
    Filter& f = add("butterworth", [=](PoseMatrix& m) { filter_zero_phase(m, order_4); });
    f.keeps_lines = f.time_symmetric =
        false;  // the start is only approximate beyond SciPy's padding
  }
  {
    Filter& f =
        add("butterworth, settled", [=](PoseMatrix& m) { filter_zero_phase(m, order_4, settled); });
    f.time_symmetric = false;  // not bit for bit
  }
  add("weighted mean", [](PoseMatrix& m) { weighted_mean_filter(m, 3); }).reach = 6;
  {
    Filter& f = add("median", [](PoseMatrix& m) { median_filter(m, 3); });
    f.linear = false;
    f.reach = 3;
  }
  for (const auto threshold : {Wt::universal, Wt::sure}) {
    for (const auto shrinkage : {Ws::soft, Ws::hard}) {
      const bool strongest = threshold == Wt::universal && shrinkage == Ws::soft;
      Filter& f = add(strongest ? "universal soft wavelet" : "wavelet",
                      [=](PoseMatrix& m) { wavelet_denoise(m, wavelet(threshold, shrinkage)); });
      f.linear = f.time_symmetric = false;
    }
  }
  return filters;
}

TEST(EveryFilter, TakesMatricesOfAnySizeEvenEmptyOnes) {
  for (const Filter& filter : all_filters()) {
    for (const std::size_t frames : {0u, 1u, 2u, 3u, 4u, 5u, 7u, 17u}) {
      for (const std::size_t channels : {0u, 1u, 2u, 8u, 13u}) {
        const PoseMatrix result = filtered(noisy_sines(frames, channels, 3), filter.apply);
        ASSERT_EQ(result.frames, frames);
        ASSERT_EQ(result.channels, channels);
        ASSERT_EQ(result.values.size(), frames * channels);
        for (const double value : result.values) {
          ASSERT_TRUE(std::abs(value) < 10)
              << filter.name << ", " << frames << " frames: " << value;
        }
      }
    }
  }
}

TEST(EveryFilter, LeavesASingleFrameAsItIs) {
  for (const Filter& filter : all_filters()) {
    const PoseMatrix input = noisy_sines(1, 5, 4);
    EXPECT_LT(largest_difference(filtered(input, filter.apply).values, input.values), 1e-12)
        << filter.name;
  }
}

TEST(EveryFilter, KeepsAConstant) {
  for (const Filter& filter : all_filters()) {
    for (const std::size_t frames : {2u, 3u, 9u, 100u}) {
      const PoseMatrix input(frames, 3, 7.25);
      EXPECT_LT(largest_difference(filtered(input, filter.apply).values, input.values), 1e-10)
          << filter.name << ", " << frames << " frames";
    }
  }
}

TEST(EveryFilter, KeepsAStraightLineUpToItsEnds) {
  std::size_t checked = 0;
  for (const Filter& filter : all_filters()) {
    if (!filter.keeps_lines) continue;
    for (const std::size_t frames : {2u, 3u, 9u, 300u}) {
      PoseMatrix input(frames, 2);
      for (std::size_t t = 0; t < frames; ++t) {
        input(t, 0) = 3 - 0.5 * static_cast<double>(t);
        input(t, 1) = 0.25 * static_cast<double>(t);
      }
      // Butterworth settles only in a take long enough to be reflected over the settling length.
      if (filter.name == "butterworth, settled" && frames < 300) continue;
      EXPECT_LT(largest_difference(filtered(input, filter.apply).values, input.values),
                filter.line_tolerance)
          << filter.name << ", " << frames << " frames";
      ++checked;
    }
  }
  EXPECT_GE(checked, 30u);
}

TEST(EveryFilter, GivesTheNegatedResultForTheNegatedSignalBitForBit) {
  for (const Filter& filter : all_filters()) {
    const PoseMatrix input = noisy_sines(137, 11, 5, 0.3);
    PoseMatrix negated = input;
    for (double& value : negated.values) value = -value;
    const PoseMatrix a = filtered(input, filter.apply);
    const PoseMatrix b = filtered(negated, filter.apply);
    for (std::size_t i = 0; i < a.values.size(); ++i) {
      ASSERT_EQ(a.values[i], -b.values[i]) << filter.name << ", sample " << i;
    }
  }
}

TEST(EveryFilter, GivesAChannelTheSameBitsAloneAndAmongOthers) {
  for (const Filter& filter : all_filters()) {
    const PoseMatrix input = noisy_sines(90, 45, 6, 0.3);
    const PoseMatrix together = filtered(input, filter.apply);
    for (const std::size_t c : {0u, 7u, 16u, 31u, 32u, 41u, 44u}) {
      const PoseMatrix alone = filtered(column(channel(input, c)), filter.apply);
      ASSERT_EQ(channel(together, c), alone.values) << filter.name << ", channel " << c;
    }
  }
}

TEST(EveryFilter, GivesTheSameBitsOnEachInstructionSet) {
  const PoseMatrix input = noisy_sines(90, 29, 7, 0.3);
  for (const Filter& filter : all_filters()) {
    const PoseMatrix best = filtered(input, filter.apply);
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const PoseMatrix result = filtered(input, filter.apply);
      hwy::SetSupportedTargetsForTest(0);
      ASSERT_EQ(result.values, best.values) << filter.name << " on " << hwy::TargetName(target);
    }
  }
}

TEST(EveryFilter, IsLinearIfItIsSaidToBe) {
  std::size_t checked = 0;
  for (const Filter& filter : all_filters()) {
    if (!filter.linear) continue;
    const PoseMatrix a = noisy_sines(120, 4, 8, 0.3);
    const PoseMatrix b = noisy_sines(120, 4, 9, 1.0);
    PoseMatrix mixed = a;
    for (std::size_t i = 0; i < mixed.values.size(); ++i) {
      mixed.values[i] = 2 * a.values[i] - 3 * b.values[i];
    }
    const PoseMatrix fa = filtered(a, filter.apply);
    const PoseMatrix fb = filtered(b, filter.apply);
    PoseMatrix expected = fa;
    for (std::size_t i = 0; i < expected.values.size(); ++i) {
      expected.values[i] = 2 * fa.values[i] - 3 * fb.values[i];
    }
    EXPECT_LT(largest_difference(filtered(mixed, filter.apply).values, expected.values), 1e-7)
        << filter.name;
    ++checked;
  }
  EXPECT_GE(checked, 5u);
}

PoseMatrix reversed(const PoseMatrix& matrix) {
  PoseMatrix result = matrix;
  for (std::size_t t = 0; t < matrix.frames; ++t) {
    const auto row = matrix.row(matrix.frames - 1 - t);
    std::copy(row.begin(), row.end(), result.row(t).begin());
  }
  return result;
}

TEST(EveryFilter, RunsTheSameForwardAndBackwardInTimeIfItIsSaidTo) {
  std::size_t checked = 0;
  for (const Filter& filter : all_filters()) {
    if (!filter.time_symmetric) continue;
    const PoseMatrix input = noisy_sines(120, 5, 10, 0.4);
    const PoseMatrix forward = filtered(input, filter.apply);
    const PoseMatrix backward = reversed(filtered(reversed(input), filter.apply));
    EXPECT_LT(largest_difference(forward.values, backward.values), 1e-12) << filter.name;
    ++checked;
  }
  EXPECT_GE(checked, 4u);
}

TEST(ZeroPhaseFilters, AreTimeSymmetricUpToTheirPadding) {
  const PoseMatrix input = noisy_sines(200, 3, 11, 0.4);
  const auto sections = butterworth_lowpass(4, 10, 120);
  const auto settled = [&](PoseMatrix& m) {
    filter_zero_phase(m, sections, settling_frames(sections, 1e-12));
  };
  EXPECT_LT(largest_difference(filtered(input, settled).values,
                               reversed(filtered(reversed(input), settled)).values),
            1e-4);
}

TEST(EveryFilter, GivesTheShiftedResultForTheShiftedSignal) {
  constexpr std::size_t shift = 5;
  std::size_t checked = 0;
  for (const Filter& filter : all_filters()) {
    if (filter.reach == 0) continue;
    const PoseMatrix input = noisy_sines(100, 3, 12, 0.4);
    PoseMatrix later = input;
    later.frames -= shift;
    later.values.erase(later.values.begin(), later.values.begin() + shift * later.channels);
    const PoseMatrix a = filtered(input, filter.apply);
    const PoseMatrix b = filtered(later, filter.apply);
    for (std::size_t t = filter.reach; t + filter.reach < later.frames; ++t) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(a(t + shift, c), b(t, c)) << filter.name;
    }
    ++checked;
  }
  EXPECT_GE(checked, 3u);
}

TEST(EveryOfflineFilter, LeavesAPulseWhereItWas) {
  for (const Filter& filter : all_filters()) {
    PoseMatrix input(201, 1);
    Random random(13);
    for (std::size_t t = 0; t < 201; ++t) {
      const double z = (static_cast<double>(t) - 100) / 12;
      input(t, 0) = std::exp(-0.5 * z * z) + 0.001 * random.normal();
    }
    const PoseMatrix result = filtered(input, filter.apply);
    double mass = 0;
    double moment = 0;
    for (std::size_t t = 60; t <= 140; ++t) {
      mass += result(t, 0);
      moment += result(t, 0) * static_cast<double>(t);
    }
    EXPECT_NEAR(moment / mass, 100, 0.1) << filter.name;
  }
}

TEST(EveryDenoiser, BringsANoisySignalNearerToTheCleanOneAndBendsNoEnd) {
  const PoseMatrix clean = noisy_sines(400, 8, 14, 0.0);
  const PoseMatrix noisy = noisy_sines(400, 8, 14, 0.1);
  for (const Filter& filter : all_filters()) {
    if (filter.name == "wide gaussian") continue;  // is too strong for this signal
    const PoseMatrix result = filtered(noisy, filter.apply);
    const double share = filter.name == "universal soft wavelet" ? 0.9 : 0.75;  // it flattens
    EXPECT_LT(rms(result.values, clean.values), share * rms(noisy.values, clean.values))
        << filter.name;
    // The ends keep at most the noise of the end sample.
    for (std::size_t c = 0; c < 8; ++c) {
      EXPECT_LT(std::abs(result(0, c) - clean(0, c)), 0.45) << filter.name;
      EXPECT_LT(std::abs(result(399, c) - clean(399, c)), 0.45) << filter.name;
    }
  }
}

}  // namespace
}  // namespace kinemend::test
