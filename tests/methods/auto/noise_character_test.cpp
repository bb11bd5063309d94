#include <gtest/gtest.h>

#include "kinemend/cleaner.hpp"
#include "methods/auto/noise_spectrum.hpp"

namespace kinemend {
namespace {

TEST(NoiseCharacter, KnowsBelowWhichFrequencyAShareOfItLies) {
  NoiseSpectrum spectrum;
  for (const double correlation : {0.0, 0.5, 0.95}) {
    spectrum.correlation = correlation;
    const NoiseCharacter noise{Space::rotation, 1, correlation};
    for (const double share : {0.1, 0.5, 0.9}) {
      const double frequency_hz = noise.frequency_of_share(share, 120);
      EXPECT_NEAR(spectrum.share_below(frequency_hz, 120), share, 1e-12);
    }
  }
}

TEST(NoiseCharacter, CountsMeasurementsNotFrames) {
  const NoiseCharacter frames{Space::rotation, 1, 0.8}, samples{Space::rotation, 1, 0.8, 4};
  EXPECT_NEAR(samples.frequency_of_share(0.5, 120), frames.frequency_of_share(0.5, 30), 1e-12);
}

}  // namespace
}  // namespace kinemend
