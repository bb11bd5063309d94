// Tests of Butterworth filters, against their closed form and SciPy.
#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "kinemend/error.hpp"
#include "signal/support.hpp"

namespace kinemend::test {
namespace {

std::complex<double> response(const std::vector<Biquad>& sections, double frequency_hz,
                              double rate_hz) {
  const auto z = std::polar(1.0, -2 * std::numbers::pi * frequency_hz / rate_hz);
  std::complex<double> h = 1;
  for (const Biquad& q : sections) {
    h *= (q.b0 + q.b1 * z + q.b2 * z * z) / (1.0 + q.a1 * z + q.a2 * z * z);
  }
  return h;
}

TEST(Butterworth, HasTheClosedFormsGainAtEachOrderAndCutoff) {
  for (int order = 1; order <= 12; ++order) {
    for (const double cutoff_hz : {0.5, 6.0, 29.0, 59.0}) {
      const auto sections = butterworth_lowpass(order, cutoff_hz, 120);
      EXPECT_EQ(sections.size(), static_cast<std::size_t>((order + 1) / 2));
      for (const double f : {0.0, 0.3, 0.5, 2.0, 6.0, 17.0, 29.0, 50.0, 59.5}) {
        const double warped =
            std::tan(std::numbers::pi * f / 120) / std::tan(std::numbers::pi * cutoff_hz / 120);
        const double expected = 1 / (1 + std::pow(warped, 2 * order));
        EXPECT_NEAR(std::norm(response(sections, f, 120)), expected, 1e-7 * expected + 1e-10)
            << "order " << order << ", cutoff " << cutoff_hz << ", at " << f;
      }
    }
  }
}

TEST(Butterworth, HasItsPolesInsideTheUnitCircle) {
  for (int order = 1; order <= 12; ++order) {
    const auto sections = butterworth_lowpass(order, 3, 100);
    ASSERT_EQ(sections.size(), static_cast<std::size_t>(order + 1) / 2);
    for (const Biquad& q : sections) {
      EXPECT_LT(std::abs(q.a2), 1);
      EXPECT_LT(std::abs(q.a1), 1 + q.a2);
    }
  }
}

void expect_usage_error(const std::function<void()>& call) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(Butterworth, RefusesOrdersAndCutoffsThatMakeNoSense) {
  for (const int order : {-1, 0, 13}) {
    expect_usage_error([=] { butterworth_lowpass(order, 6, 120); });
  }
  const double nan = std::nan("");
  for (const double cutoff_hz : {-1.0, 0.0, 60.0, 100.0, nan}) {
    expect_usage_error([=] { butterworth_lowpass(4, cutoff_hz, 120); });
  }
  for (const double rate_hz : {-120.0, 0.0, nan, static_cast<double>(INFINITY)}) {
    expect_usage_error([=] { butterworth_lowpass(4, 6, rate_hz); });
  }
}

struct Case {
  int order;
  int cutoff_hz;
};
const Case cases[] = {{1, 6}, {2, 6}, {3, 10}, {4, 6}, {5, 20}, {7, 12}, {8, 30}, {12, 15}};

std::string label(const Case& c) {
  return std::string("/")
      .append(std::to_string(c.order))
      .append("/")
      .append(std::to_string(c.cutoff_hz));
}

TEST(ZeroPhase, GivesTheNumbersOfSciPysSosfiltfilt) {
  for (const Case& c : cases) {
    PoseMatrix take = column(reference().at("input/long"));
    filter_zero_phase(take, butterworth_lowpass(c.order, c.cutoff_hz, 120));
    EXPECT_LT(largest_difference(take.values, reference().at("sosfiltfilt" + label(c))), 1e-10)
        << label(c);
  }
}

TEST(ZeroPhase, PadsAShortTakeWithAllItHas) {
  for (const std::string frames : {"2", "3", "9", "16"}) {
    PoseMatrix take = column(reference().at("input/" + frames));
    filter_zero_phase(take, butterworth_lowpass(4, 6, 120));
    EXPECT_LT(largest_difference(take.values, reference().at("sosfiltfilt_short/" + frames)), 1e-10)
        << frames << " frames";
  }
}

TEST(ZeroPhase, StartsSectionsOfAnyGainAtRest) {
  const std::vector<Biquad> sections = {
      {0.5, 0.25, 0, -0.5, 0}, {1, 2, 3, 0.2, 0.3}, {0, 0.7, 0, 0, 0}};
  const double gain = 0.75 / 0.5 * 6 / 1.5 * 0.7;
  const PoseMatrix result =
      filtered(PoseMatrix(40, 9, 2.0), [&](PoseMatrix& m) { filter_zero_phase(m, sections); });
  for (const double value : result.values) ASSERT_NEAR(value / gain, 2 * gain, 1e-12);
}

// The response to a 1 in frame 1, by the definition of a section.
std::vector<double> impulse_response(const std::vector<Biquad>& sections, std::size_t frames) {
  std::vector<double> signal(frames, 0.0);
  signal[1] = 1;
  for (const Biquad& q : sections) {
    double x1 = 0, x2 = 0, y1 = 0, y2 = 0;
    for (double& value : signal) {
      const double y = q.b0 * value + q.b1 * x1 + q.b2 * x2 - q.a1 * y1 - q.a2 * y2;
      x2 = x1, x1 = value, y2 = y1, y1 = y;
      value = y;
    }
  }
  return signal;
}

TEST(SettlingFrames, IsHowLongTheImpulseResponseLasts) {
  for (const double cutoff_hz : {0.5, 3.0, 20.0}) {
    for (const int order : {1, 2, 4}) {
      const auto sections = butterworth_lowpass(order, cutoff_hz, 120);
      const std::size_t settled = settling_frames(sections, 1e-8);
      const std::vector<double> impulse = impulse_response(sections, settled + 401);
      double largest = 0;
      double late = 0;
      for (std::size_t t = 0; t < impulse.size(); ++t) {
        largest = std::max(largest, std::abs(impulse[t]));
        if (t > settled) late = std::max(late, std::abs(impulse[t]));
      }
      EXPECT_LT(late, 1e-6 * largest);
    }
  }
}

TEST(SettlingFrames, PadsSoThatALowCutoffBendsNoEnd) {
  // With the default padding, a slow filter tilts the ends of a steep line; with the settled
  // padding it does not.
  const auto sections = butterworth_lowpass(4, 1.5, 120);
  PoseMatrix line(1000, 1);
  for (std::size_t t = 0; t < 1000; ++t) line(t, 0) = static_cast<double>(t);
  PoseMatrix by_default = line;
  filter_zero_phase(by_default, sections);
  EXPECT_GT(largest_difference(by_default.values, line.values), 1.0);
  PoseMatrix by_settling = line;
  filter_zero_phase(by_settling, sections, settling_frames(sections));
  EXPECT_LT(largest_difference(by_settling.values, line.values), 1e-3);
}

}  // namespace
}  // namespace kinemend::test
