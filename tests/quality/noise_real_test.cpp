// Real pairs of takes: one motion from a video or depth camera and from optical markers.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "kinemend/extend/motion.hpp"
#include "kinemend/io.hpp"
#include "quality/marker_quality.hpp"

namespace kinemend::quality {
namespace {

Take half_of(const std::string& pair, const std::string& half) {
  const std::filesystem::path folder = KINEMEND_DATA_FOLDER;
  return read_take(folder / "real" / (pair + "." + half + ".trc")).take;
}

// Root mean square of the velocity difference, units per second.
double velocity_error(const Take& a, const Take& b) {
  double sum = 0, count = 0;
  for (std::size_t f = 1; f + 1 < a.frame_count(); ++f) {
    for (std::size_t m = 0; m < a.marker_count(); ++m) {
      if (!a.is_observed(f - 1, m) || !a.is_observed(f + 1, m) || !b.is_observed(f - 1, m) ||
          !b.is_observed(f + 1, m))
        continue;
      const Vec3 off = (a.position(f + 1, m) - a.position(f - 1, m)) -
                       (b.position(f + 1, m) - b.position(f - 1, m));
      sum += dot(off, off);
      count += 1;
    }
  }
  return std::sqrt(sum / count) * a.frame_rate_hz / 2;
}

class RealPairs : public testing::TestWithParam<const char*> {};

TEST_P(RealPairs, ComeNearerToTheirReference) {
  const Take reference = half_of(GetParam(), "reference"), noisy = half_of(GetParam(), "noisy");
  EXPECT_LT(velocity_error(cleaned_markers(noisy, "auto"), reference),
            0.75 * velocity_error(noisy, reference));
}

TEST_P(RealPairs, LeaveTheirReferenceAlone) {
  const Take reference = half_of(GetParam(), "reference");
  EXPECT_LT(test::rms_distance(cleaned_markers(reference, "auto"), reference), 0.3);
}

// Slow dances whose markers hardly move, at the rates of video and depth cameras.
TEST(CleanMarkersAtLowRates, AreLeftAlone) {
  const std::filesystem::path folder = KINEMEND_DATA_FOLDER;
  for (const char* take : {"49_09", "49_22"}) {
    const Take clip = read_take(folder / "cmu" / "bvh" / (take + std::string(".bvh"))).take;
    for (const double rate_hz : {30.0, 60.0}) {
      const Take markers = joint_markers(resample(clip, rate_hz));
      EXPECT_LT(test::rms_distance(cleaned_markers(markers, "auto"), markers), 1e-3)
          << take << " at " << rate_hz << " Hz";
    }
  }
}

// White noise in proportion to the motion of each channel: quiet joints have almost none.
TEST(NoiseOfEachChannel, IsNotTakenForSlow) {
  const std::filesystem::path folder = KINEMEND_DATA_FOLDER;
  for (const char* take : {"07_11", "08_02", "09_03"}) {
    const Take truth = read_take(folder / "cmu" / "bvh" / (take + std::string(".bvh"))).take;
    Take noisy = truth;
    Random random(1);
    apply_damage(noisy, "gaussian-channels", {{"k", 0.1}}, random);
    EXPECT_LT(figures(truth, cleaned(noisy, "auto")).rms, 0.8 * figures(truth, noisy).rms) << take;
  }
}

INSTANTIATE_TEST_SUITE_P(Systems, RealPairs,
                         testing::Values("video-regular_FULL", "video-60fps_01_HEAVY", "depth-CTK",
                                         "depth-RTK"),
                         [](const auto& pair) {
                           std::string name = pair.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace kinemend::quality
