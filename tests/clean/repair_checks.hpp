// Checks that a repair is not blended with the value it replaces.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "kinemend/clean.hpp"
#include "kinemend/extend/cleaner.hpp"
#include "kinemend/extend/random.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/take.hpp"

namespace kinemend::test {

inline constexpr double spike_deg = 60;

/// The place of an injected spike.
struct Thrown {
  std::size_t frame, joint;
};

/// Adds spikes to single samples of the given joints, each about a random axis and at least `apart`
/// frames from the next one of its joint.
inline std::vector<Thrown> throw_spikes(Take& clip, const std::vector<std::size_t>& joints,
                                        std::size_t apart, std::uint64_t seed) {
  Random random(seed);
  std::vector<Thrown> thrown;
  for (const std::size_t joint : joints) {
    for (std::size_t f = 10 + 7 * (joint % 4); f + 10 < clip.frame_count(); f += apart) {
      const Vec3 axis{random.normal(), random.normal(), random.normal()};
      const double angle = spike_deg * radians_per_degree;
      clip.rotation(f, joint) = clip.rotation(f, joint) * exp((angle / norm(axis)) * axis);
      thrown.push_back({f, joint});
    }
  }
  return thrown;
}

inline bool is_stated(const std::vector<ReportSpan>& spans, std::size_t frame, std::size_t track,
                      Action action) {
  for (const ReportSpan& span : spans) {
    if (span.joint == static_cast<std::int32_t>(track) && span.action == action &&
        span.first_frame <= frame && frame <= span.last_frame)
      return true;
  }
  return false;
}

/// At every strength above 0, a repaired sample keeps less than a tenth of its spike. Returns how
/// many of `thrown` were repaired.
inline std::size_t expect_whole_repairs(const Take& input, const std::vector<Thrown>& thrown,
                                        const Cleaner& cleaner) {
  const CleanResult whole = clean_take(input, cleaner);
  std::size_t repaired = 0;
  for (const double strength : {0.1, 0.5, 0.9}) {
    CleanSettings settings;
    settings.strength = strength;
    const CleanResult part = clean_take(input, cleaner, settings);
    repaired = 0;
    for (const Thrown& at : thrown) {
      if (!is_stated(whole.report.spans, at.frame, at.joint, Action::despiked)) continue;
      ++repaired;
      EXPECT_TRUE(is_stated(part.report.spans, at.frame, at.joint, Action::despiked));
      const double left = angle_between(part.take.rotation(at.frame, at.joint),
                                        whole.take.rotation(at.frame, at.joint));
      EXPECT_LT(left * degrees_per_radian, 0.1 * spike_deg)
          << "strength " << strength << ", frame " << at.frame << ", joint " << at.joint;
    }
  }
  return repaired;
}

}  // namespace kinemend::test
