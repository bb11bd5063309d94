// Every format reads an impossible frame rate as unknown, with a warning.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "io/acclaim/acclaim.hpp"
#include "kinemend/extend/frames.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"
#include "support.hpp"

namespace kinemend {
namespace {

using namespace test;

const double unusable_hz[] = {1e-300, 1e-9, 0.0999, 100001, 1e7, 1e12, 1e30, 1e300};
const double usable_hz[] = {0.1, 1, 29.97, 120, 1000, 1e5};

Take still_walk() {
  SynthOptions options;
  options.duration_s = 0.1;
  return synthesize(options);
}

// A take of the format that states this rate, edited by hand where a writer would refuse it.
std::string stating(const std::string& format, double rate_hz) {
  const Take joints = still_walk();
  Take markers = joint_markers(joints);
  markers.unit = "mm";
  if (format == "bvh") {
    std::string text = write_take(joints);
    const std::size_t at = text.find("Frame Time: ") + 12;
    text.replace(at, text.find('\n', at) - at, fmt::format("{:.17g}", 1 / rate_hz));
    return text;
  }
  if (format == "csv" || format == "csv of joints") {
    std::string text = format == "csv" ? write_take(markers, "csv") : write_take(joints, "csv");
    const std::size_t at = text.find("# rate_hz: ") + 11;
    text.replace(at, text.find('\n', at) - at, fmt::format("{:.17g}", rate_hz));
    // A column of times would give another rate.
    text.replace(text.find("time_s"), 6, "other");
    return text;
  }
  if (format == "trc") {
    std::string text = write_take(markers, "trc");
    const std::size_t at = text.find("120.00");
    text.replace(at, 6, fmt::format("{:.17g}", rate_hz));
    for (std::size_t row = text.find("\n1\t") + 1; row < text.size();
         row = text.find('\n', row) + 1) {
      const std::size_t time = text.find('\t', row) + 1;
      text.replace(time, text.find('\t', time) - time, "");
    }
    return text;
  }
  std::string bytes = write_take(markers, "c3d");
  const auto single = static_cast<float>(rate_hz);
  const float usual = 120;
  const std::string_view old(reinterpret_cast<const char*>(&usual), sizeof usual);
  for (std::size_t at = bytes.find(old); at < 4 * 512 && at != bytes.npos;
       at = bytes.find(old, at + 4)) {
    bytes.replace(at, sizeof single, reinterpret_cast<const char*>(&single), sizeof single);
  }
  return bytes;
}

double rate_of(const TakeResult& result) { return result.take.frame_rate_hz; }

class EveryFormatWithRates : public testing::TestWithParam<const char*> {
 protected:
  std::string format_ = GetParam();
  TakeResult read(double rate_hz, double asked_hz = 0) const {
    ReadOptions options;
    options.format = format_.substr(0, format_.find(' '));
    options.frame_rate_hz = asked_hz;
    return read_take(stating(format_, rate_hz), "take", options);
  }
};

TEST_P(EveryFormatWithRates, TakesTheRatesThatATakeMayHave) {
  for (const double rate_hz : usable_hz) {
    const TakeResult result = read(rate_hz, 77);
    EXPECT_NEAR(rate_of(result), rate_hz, 1e-6 * rate_hz);
    EXPECT_EQ(result.diagnostics.count("frame_rate_unusable") +
                  result.diagnostics.count("frame_time_unusable"),
              0u);
  }
}

TEST_P(EveryFormatWithRates, TakesAnyOtherForUnknownAndSaysSo) {
  for (const double rate_hz : unusable_hz) {
    SCOPED_TRACE(rate_hz);
    const TakeResult assumed = read(rate_hz), asked = read(rate_hz, 77);
    EXPECT_TRUE(is_usable_frame_rate(rate_of(assumed)));
    EXPECT_GE(rate_of(assumed), 30);
    EXPECT_LE(rate_of(assumed), 120);
    EXPECT_EQ(rate_of(asked), 77);
    assumed.take.validate();
    // A C3D file holds single floats, which cannot represent the smallest and largest rates here.
    const bool is_stated = format_ != "c3d" || (rate_hz > 1e-30 && rate_hz < 1e35);
    if (is_stated) {
      EXPECT_EQ(assumed.diagnostics.count("frame_rate_unusable") +
                    assumed.diagnostics.count("frame_time_unusable"),
                1u);
    }
  }
}

TEST_P(EveryFormatWithRates, IsWrittenAtTheRateThatItWasReadWith) {
  for (const double rate_hz : {1e-9, 1e12}) {
    const TakeResult result = read(rate_hz, 77);
    const std::string format = format_.substr(0, format_.find(' '));
    Take take = resample(result.take, 38.5);
    ReadOptions options;
    options.format = format;
    const TakeResult again = read_take(write_take(take, format), "take", options);
    EXPECT_NEAR(rate_of(again), 38.5, 1e-3);
    EXPECT_EQ(again.diagnostics.count("frame_rate_unusable"), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, EveryFormatWithRates,
                         testing::Values("bvh", "csv", "csv of joints", "trc", "c3d"),
                         [](const auto& format) {
                           std::string name = format.param;
                           std::erase(name, ' ');
                           return name;
                         });

TEST(Rates, AskedForOutsideOfTheRangeAreRefused) {
  for (const double rate_hz : unusable_hz) {
    ReadOptions options;
    options.frame_rate_hz = rate_hz;
    EXPECT_THROW(read_take(figure_amc(), "take.amc", options), Error);
    EXPECT_THROW(resample(still_walk(), rate_hz), Error);
    Take clip = still_walk();
    clip.frame_rate_hz = rate_hz;
    EXPECT_THROW(clip.validate(), Error);
    EXPECT_THROW(write_take(clip), Error);
  }
}

}  // namespace
}  // namespace kinemend
