// Makes the take of the turning chain.
#include "lab/synthesis/spin.hpp"

#include <array>
#include <string>
#include <vector>

#include "base/portable.hpp"
#include "kinemend/extend/random.hpp"

namespace kinemend::synth {

namespace {

// Chosen by hand.
constexpr std::size_t links = 5;

struct Link {
  double turns_per_s, pitch_hz, pitch_phase, roll_deg, roll_hz;

  Quat at(double t, RotationOrder order) const {
    const double yaw = 360 * turns_per_s * t;
    const double pitch = 88 * portable::sin(2 * pi * (pitch_hz * t + pitch_phase));
    const double roll = roll_deg * portable::sin(2 * pi * roll_hz * t);
    return from_euler(
        {yaw * radians_per_degree, pitch * radians_per_degree, roll * radians_per_degree}, order);
  }
};

}  // namespace

Take spin(const SynthOptions& options, std::size_t frames) {
  Random random(options.seed);
  const RotationOrder order = parse_rotation_order("ZYX");
  std::array<Link, links> chain;
  Take clip;
  for (std::size_t i = 0; i < links; ++i) {
    const double direction = i % 2 == 0 ? 1 : -1;
    chain[i] = {direction * random.uniform(0.25, 0.4), random.uniform(0.2, 0.35), random.uniform(),
                random.uniform(10, 30), random.uniform(0.3, 0.6)};
    const auto parent = static_cast<std::int32_t>(i) - 1;
    clip.skeleton.add_joint("Link" + std::to_string(i), parent, {0, i == 0 ? 0.0 : 20.0, 0},
                            make_channels(i == 0, order));
  }
  clip.skeleton.end_sites.push_back({static_cast<std::int32_t>(links) - 1, {0, 20, 0}, ""});
  const std::size_t rows = frames + (options.t_pose_first ? 1 : 0);
  clip.positions.assign(rows, {0, 100, 0});
  clip.rotations.assign(options.t_pose_first ? links : 0, Quat{});
  for (std::size_t f = 0; f < frames; ++f) {
    const double t = static_cast<double>(f) / options.frame_rate_hz;
    for (const Link& link : chain) clip.rotations.push_back(link.at(t, order));
  }
  return clip;
}

}  // namespace kinemend::synth
