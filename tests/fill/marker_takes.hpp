// Synthetic takes of markers on body segments, for tests of filling.
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "fill/made_gaps.hpp"
#include "kinemend/extend/motion.hpp"
#include "kinemend/lab/synth.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

/// A synthetic motion as an optical system records it: three markers on each of thirteen segments,
/// in centimetres. `names` are those of the joints with _a, _b, _c. Each marker sways on its skin
/// by `sway_cm`, independently of all other markers.
inline Take marker_take(const std::string& motion = "walk", double duration_s = 5,
                        double sway_cm = 0) {
  constexpr double frame_rate_hz = 120;
  const Take clip =
      synthesize({.motion = motion, .duration_s = duration_s, .frame_rate_hz = frame_rate_hz});
  const char* joints[] = {"Hips",        "LeftUpLeg", "LeftLeg",     "LeftFoot", "RightUpLeg",
                          "RightLeg",    "RightFoot", "Spine1",      "Head",     "LeftArm",
                          "LeftForeArm", "RightArm",  "RightForeArm"};
  const Vec3 places[] = {{4, -6, 5}, {-5, -8, 3}, {1, -11, -6}};
  std::vector<std::size_t> used;
  std::vector<std::string> names;
  for (const char* joint : joints) {
    used.push_back(static_cast<std::size_t>(clip.skeleton.find(joint)));
    for (const char* suffix : {"_a", "_b", "_c"}) names.push_back(std::string(joint) + suffix);
  }
  Take take = make_marker_take(names, clip.frame_count(), frame_rate_hz);
  take.unit = "cm";
  take.observed.assign(take.positions.size(), 1);
  take.residuals.assign(take.positions.size(), 0.5F);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const Pose pose = forward_kinematics(clip, f);
    for (std::size_t k = 0; k < used.size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        const auto m = static_cast<double>(3 * k + i);
        const double phase = 2 * pi * (0.5 + 0.011 * m) * static_cast<double>(f) / frame_rate_hz;
        const Vec3 sway{std::sin(phase + m), std::cos(phase + 2 * m), std::sin(phase + 4 * m)};
        take.position(f, 3 * k + i) =
            pose.positions[used[k]] + rotate(pose.rotations[used[k]], places[i] + sway_cm * sway);
      }
    }
  }
  return take;
}

inline double mean_error(const Take& truth, const Take& filled, const Gap& gap) {
  double sum = 0;
  for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f) {
    sum += norm(filled.position(f, gap.track) - truth.position(f, gap.track));
  }
  return sum / static_cast<double>(gap.length());
}

inline double mean_error(const Take& truth, const Take& filled, const FillReport& report) {
  double sum = 0, count = 0;
  for (const GapOutcome& outcome : report.gaps) {
    const auto length = static_cast<double>(outcome.gap.length());
    sum += length * mean_error(truth, filled, outcome.gap);
    count += length;
  }
  return sum / count;
}

}  // namespace kinemend::fill
