// A take that slowly turns as a whole is cleaned as accurately as without the turn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "long_tests.hpp"
#include "quality/real_takes.hpp"

namespace kinemend::quality {
namespace {

constexpr double noise_deg = 4;

Take turned(Take clip, Vec3 speed_deg_s) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const double time_s = static_cast<double>(f) / clip.frame_rate_hz;
    const Quat turn = exp(radians_per_degree * time_s * speed_deg_s);
    clip.rotation(f, 0) = turn * clip.rotation(f, 0);
    clip.root_position(f) = rotate(turn, clip.root_position(f));
  }
  return clip;
}

// About a level axis, the root turns beyond the range of its channels and is cleaned by `auto`; no
// other joint may suffer.
TEST(SlowTurns, OfAnyAxisLeaveSparseAsGood) {
  KINEMEND_LONG_TEST();
  for (const char* name : {"02_05", "05_13"}) {
    const Take whole = real_clip(name);
    const Take truth = slice(whole, 0, std::min<std::size_t>(whole.frame_count(), 1200));
    const Take noisy = damaged(truth, noise_deg, 0, 7);
    const double still = figures(truth, cleaned(noisy, "sparse")).rms;
    for (const Vec3 speed : {Vec3{0, 40, 0}, Vec3{40, 0, 0}, Vec3{0, 0, 40}, Vec3{-20, 30, 20}}) {
      const Take result = cleaned(turned(noisy, speed), "sparse");
      const double growth = figures(turned(truth, speed), result).rms / still;
      const std::string text =
          fmt::format("{}: {} {} {} degrees a second", name, speed.x, speed.y, speed.z);
      printf("  %s: %.3f times\n", text.c_str(), growth);
      EXPECT_LT(growth, 1.01) << text;
    }
  }
}

}  // namespace
}  // namespace kinemend::quality
