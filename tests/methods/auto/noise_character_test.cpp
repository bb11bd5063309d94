// Tests of the frequencies of a take's noise.
#include <gtest/gtest.h>

#include <cmath>

#include "kinemend/extend/cleaner.hpp"

namespace kinemend {
namespace {

// The share of the noise power below a frequency at 120 Hz, summed over the spectrum.
double share_below(double frequency_hz, double correlation) {
  double below = 0, all = 0;
  for (double f = 0.0005; f < 60; f += 0.001) {
    const double c = std::cos(2 * pi * f / 120);
    const double density = 1 / (1 - 2 * correlation * c + correlation * correlation);
    all += density;
    if (f < frequency_hz) below += density;
  }
  return below / all;
}

TEST(NoiseCharacter, KnowsBelowWhichFrequencyAShareOfItLies) {
  for (const double correlation : {0.0, 0.5, 0.95}) {
    const NoiseCharacter noise{Space::rotation, 1, correlation};
    for (const double share : {0.1, 0.5, 0.9}) {
      EXPECT_NEAR(share_below(noise.frequency_of_share(share, 120), correlation), share, 1e-3)
          << correlation;
    }
  }
  EXPECT_NEAR((NoiseCharacter{Space::rotation, 1, 0}).frequency_of_share(0.25, 120), 15, 1e-9);
}

TEST(NoiseCharacter, CountsMeasurementsNotFrames) {
  const NoiseCharacter frames{Space::rotation, 1, 0.8}, samples{Space::rotation, 1, 0.8, 4};
  EXPECT_NEAR(samples.frequency_of_share(0.5, 120), frames.frequency_of_share(0.5, 30), 1e-12);
}

}  // namespace
}  // namespace kinemend
