// Tests of the motion codec of pages: samples are restored within half a quantum.
#include "report/page/codec.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/random.hpp"
#include "report/page/page_parts.hpp"

namespace kinemend::test {
namespace {

using page::Quantised;

std::vector<std::int64_t> wide(const std::vector<std::int32_t>& samples) {
  return {samples.begin(), samples.end()};
}

// A smooth track with noise, a constant one, and the first one reversed.
std::vector<Quantised> tracks(std::size_t frames) {
  Random random(7);
  std::vector<Quantised> all(3);
  for (std::size_t f = 0; f < frames; ++f) {
    const double smooth = 4000 * std::sin(0.03 * static_cast<double>(f));
    all[0].after.push_back(static_cast<std::int32_t>(std::lround(smooth)));
    all[0].before.push_back(static_cast<std::int32_t>(std::lround(smooth + 80 * random.normal())));
    all[1].after.push_back(-5);
    all[1].before.push_back(-5);
    // The track before cleaning may also be the smoother one.
    all[2].before.push_back(all[0].after.back());
    all[2].after.push_back(all[0].before.back());
  }
  return all;
}

void expect_round_trip(const std::vector<Quantised>& all, std::size_t stride) {
  const std::size_t frames = all[0].before.size();
  PageReader first(page::first_part(all, stride)), second(page::second_part(all, stride));
  PageReader* const rest = stride > 1 ? &second : nullptr;
  for (const Quantised& channel : all) {
    const auto [before, after] = read_pair(first, rest, frames, stride);
    EXPECT_EQ(after, wide(channel.after)) << frames << " frames by " << stride;
    EXPECT_EQ(before, wide(channel.before)) << frames << " frames by " << stride;
  }
  EXPECT_TRUE(first.is_done());
  EXPECT_TRUE(second.is_done());
}

TEST(PageCodec, GivesBackEverySampleInOnePartAndInTwo) {
  for (const std::size_t frames : {0, 1, 2, 7, 8, 9, 100, 1001}) {
    for (const std::size_t stride : {1, 8}) expect_round_trip(tracks(frames), stride);
  }
}

TEST(PageCodec, TellsSmallRemaindersOfSmoothTracks) {
  auto all = tracks(7200);
  all.resize(1);
  const std::string bytes = page::deflated(page::first_part(all, 1));
  // Noise of 80 quanta has log2(80 sqrt(2 pi e)) = 8.4 bits; the smooth track has about 4.
  EXPECT_LT(bytes.size() * 8.0 / 7200, 8.4 + 5);
}

TEST(PageCodec, KeepsValuesWithinHalfAQuantum) {
  const std::vector<double> values = {0, 0.019, -0.021, 359.99, -1e7, 1e7};
  const double quantum = page::quantum_for(0.04, 1e7);
  EXPECT_EQ(quantum, 0.04);
  const auto samples = page::quantised(values, quantum);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(samples[i] * quantum, values[i], quantum / 2 + 1e-9);
  EXPECT_EQ(page::quantised(std::vector<double>{std::nan(""), INFINITY}, 1),
            (std::vector<std::int32_t>{0, 0}));
}

TEST(PageCodec, WidensTheQuantumWhereValuesAreHuge) {
  const double quantum = page::quantum_for(0.04, 1e12);
  EXPECT_EQ(page::quantised(std::vector{1e12}, quantum)[0], 1 << 30);
  EXPECT_EQ(page::quantised(std::vector{-1e12}, quantum)[0], -(1 << 30));
}

TEST(PageCodec, DeflatesAndWritesBase64ForAnyLength) {
  std::string bytes;
  for (int i = 0; i < 300; ++i) {
    EXPECT_EQ(from_base64(page::base64(bytes)), bytes);
    EXPECT_EQ(page::base64(bytes).size() % 4, 0u);
    EXPECT_EQ(inflated(page::deflated(bytes)), bytes);
    bytes += static_cast<char>(i * 37);
  }
  EXPECT_EQ(page::base64("any carnal pleas"), "YW55IGNhcm5hbCBwbGVhcw==");
}

TEST(PageChannels, TellNotMoreThanSoManySamples) {
  EXPECT_EQ(page::frame_step(72'000, 96), 1u);   // ten minutes at 120 Hz
  EXPECT_EQ(page::frame_step(432'000, 96), 5u);  // an hour
  EXPECT_EQ(page::frame_step(0, 96), 1u);
  EXPECT_EQ(page::part_stride(7'200, 96), 1u);
  EXPECT_EQ(page::part_stride(72'000, 96), page::stride_of_parts);
}

}  // namespace
}  // namespace kinemend::test
