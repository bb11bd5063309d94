// Places markers at random and damages them like cameras and optical systems.
#include "lab/samples/motion_samples.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "kinemend/extend/rotation.hpp"
#include "lab/samples/motion_noise.hpp"
#include "lab/samples/sequence_damage.hpp"
#include "lab/samples/warped_sequence.hpp"

namespace kinemend {

namespace {

PoseMatrix marker_stretch(std::span<const MarkerMotion> markers, double rate_hz, std::size_t frames,
                          Random& random) {
  std::vector<double> shares;
  for (const MarkerMotion& motion : markers)
    shares.push_back(std::sqrt(static_cast<double>(motion.positions.frames)));
  const MarkerMotion& motion = markers[drawn_index(shares, random)];
  const double pace = random_pace(random) * motion.rate_hz / rate_hz;
  const auto wanted = static_cast<std::size_t>(pace * static_cast<double>(frames)) + 3;
  const PoseMatrix part = random_part(motion.positions, wanted, random);
  // A stretch that is too short is played more slowly.
  return warped(part, pace * static_cast<double>(part.frames) / static_cast<double>(wanted),
                frames);
}

// Positions relative to the root, the first three channels.
PoseMatrix from_root(PoseMatrix positions) {
  for (std::size_t f = 0; f < positions.frames; ++f) {
    for (std::size_t c = positions.channels; c-- > 0;) positions(f, c) -= positions(f, c % 3);
  }
  return positions;
}

// Turns and scales all markers together by a random orientation and size.
void place_at_random(PoseMatrix& positions, Random& random) {
  const Quat turn = random_turn(random);
  double size = log_uniform(random, 0.6, 2);
  if (!random.chance(0.5)) size = -size;
  for (std::size_t f = 0; f < positions.frames; ++f) {
    for (std::size_t c = 0; c < positions.channels; c += 3) {
      const Vec3 at =
          size * rotate(turn, {positions(f, c), positions(f, c + 1), positions(f, c + 2)});
      positions(f, c) = at.x, positions(f, c + 1) = at.y, positions(f, c + 2) = at.z;
    }
  }
}

// Noise of one size, or in proportion to each marker's motion about the root; in some samples one
// axis, as of depth, has more.
std::vector<double> marker_noise(const PoseMatrix& positions, Random& random) {
  std::vector<double> strengths(positions.channels, log_uniform(random, 0.1, 25));
  if (random.chance(0.4)) {
    const double share = log_uniform(random, 0.02, 0.7);
    strengths = deviations_of(from_root(positions));
    for (double& strength : strengths) strength = std::max(share * strength, 0.05);
  }
  if (random.chance(0.25)) {
    const double further = random.uniform(2, 5);
    for (std::size_t c = 2; c < strengths.size(); c += 3) strengths[c] *= further;
  }
  return strengths;
}

// Holds or interpolates positions between every few frames.
void lower_marker_rate(PoseMatrix& positions, Random& random) {
  const std::size_t step = 2 + random.below(4);
  const bool is_held = random.chance(0.4);
  for (std::size_t f = 0; f < positions.frames; ++f) {
    const std::size_t before = f - f % step, after = std::min(before + step, positions.frames - 1);
    if (f == before || after <= f) continue;
    const double share =
        is_held ? 0 : static_cast<double>(f - before) / static_cast<double>(after - before);
    for (std::size_t c = 0; c < positions.channels; ++c)
      positions(f, c) = positions(before, c) + share * (positions(after, c) - positions(before, c));
  }
}

void add_jumps(PoseMatrix& positions, Random& random) {
  const double share = log_uniform(random, 0.001, 0.02), size = log_uniform(random, 5, 100);
  for (std::size_t f = 0; f < positions.frames; ++f) {
    for (std::size_t c = 0; c < positions.channels; c += 3) {
      if (!random.chance(share)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) positions(f, c + axis) += size * random.normal();
    }
  }
}

SampleDamage damage_markers(PoseMatrix& positions, double rate_hz, const MotionSampling& sampling,
                            std::vector<std::uint8_t>& observed, Random& random) {
  bool is_slow = add_random_noise(positions, rate_hz, marker_noise(positions, random),
                                  sampling.has_slow_noise, random);
  if (random.chance(0.2)) add_jumps(positions, random);
  if (random.chance(0.15)) observed = lose_samples_at_random(positions, rate_hz, random);
  if (rate_hz >= 100 && random.chance(0.15)) lower_marker_rate(positions, random);
  if (sampling.has_slow_noise && low_pass_at_random(positions, rate_hz, 0.3, random))
    is_slow = true;
  return is_slow ? SampleDamage::slow : SampleDamage::quick;
}

}  // namespace

MotionSample random_marker_sample(std::span<const MarkerMotion> markers, std::size_t channels,
                                  const MotionSampling& sampling, Random random) {
  const double rate_hz = random_rate_hz(random);
  PoseMatrix positions = marker_stretch(markers, rate_hz, sample_frames(sampling, rate_hz), random);
  if (random.chance(0.3)) positions = from_root(std::move(positions));
  place_at_random(positions, random);
  // A shaking hand moves by the width of a hand.
  vary_motion(positions, rate_hz, {0.25, 150}, random);
  MotionSample sample;
  PoseMatrix seen = positions;
  std::vector<std::uint8_t> observed;
  SampleDamage damage = SampleDamage::none;
  if (!random.chance(sampling.clean_share)) {
    damage = damage_markers(seen, rate_hz, sampling, observed, random);
  } else if (random.chance(0.4)) {
    observed = lose_samples_at_random(seen, rate_hz, random);
  }
  put_values(sample, seen, positions, positions.row(0), observed, channels);
  MotionTake& take = sample.take;
  take.frame_rate_hz = rate_hz;
  take.expects_slow_noise = is_said_to_be_slow(damage, random);
  take.slots.assign(channels, -1);
  take.is_position.assign(channels, 1);
  if (random.chance(0.6)) lose_whole_tracks(sample, random.uniform(0.1, 0.9), random);
  return sample;
}

}  // namespace kinemend
