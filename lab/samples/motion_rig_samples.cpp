// Draws stretches of other rigs' takes, and adds the errors of real systems to clean motion.
#include <algorithm>
#include <utility>
#include <vector>

#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"
#include "lab/samples/motion_noise.hpp"
#include "lab/samples/motion_samples.hpp"
#include "lab/samples/sequence_damage.hpp"
#include "lab/samples/warped_sequence.hpp"

namespace kinemend {

namespace {

// Repeats the part forwards and backwards up to `frames` frames.
PoseMatrix prolonged(const PoseMatrix& part, std::size_t frames) {
  PoseMatrix result(frames, part.channels);
  const std::size_t last = part.frames - 1, round = std::max<std::size_t>(2 * last, 1);
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t at = f % round;
    const auto row = part.row(at <= last ? at : round - at);
    std::copy(row.begin(), row.end(), result.row(f).begin());
  }
  return result;
}

// A random stretch of `frames` frames at that pace, forwards and backwards if the motion is too
// short.
PoseMatrix played(const PoseMatrix& motion, double pace, std::size_t frames, Random& random) {
  const auto wanted = static_cast<std::size_t>(pace * static_cast<double>(frames)) + 3;
  return warped(prolonged(random_part(motion, wanted, random), wanted), pace, frames);
}

// Tracks that move, at most `most`, in random order.
std::vector<std::size_t> some_tracks(const PoseMatrix& values, std::size_t most, Random& random) {
  constexpr double least_deg = 0.02;
  const std::vector<double> deviations = deviations_of(values);
  std::vector<std::size_t> tracks;
  for (std::size_t n = 0; n < values.channels / 3; ++n) {
    if (*std::max_element(deviations.begin() + static_cast<std::ptrdiff_t>(3 * n),
                          deviations.begin() + static_cast<std::ptrdiff_t>(3 * n + 3)) > least_deg)
      tracks.push_back(n);
  }
  if (tracks.empty()) tracks.push_back(0);
  for (std::size_t i = tracks.size() - 1; i > 0; --i)
    std::swap(tracks[i], tracks[random.below(i + 1)]);
  tracks.resize(std::min(tracks.size(), most));
  return tracks;
}

SampleDamage damage_rig(PoseMatrix& values, double rate_hz, const MotionSources& sources,
                        const MotionSampling& sampling, std::vector<std::uint8_t>& observed,
                        Random& random) {
  bool is_slow = false;
  if (sampling.has_slow_noise && !sources.pairs.empty() && random.chance(sampling.residual_share)) {
    add_residuals(values, rate_hz, sources.pairs, random);
    is_slow = true;
  } else {
    is_slow = add_random_noise(values, rate_hz, random_strengths(values, 0.5, random),
                               sampling.has_slow_noise, random);
  }
  if (random.chance(0.15)) observed = lose_samples_at_random(values, rate_hz, random);
  if (sampling.has_slow_noise && low_pass_at_random(values, rate_hz, 0.2, random)) is_slow = true;
  return is_slow ? SampleDamage::slow : SampleDamage::quick;
}

}  // namespace

void add_residuals(PoseMatrix& poses, double rate_hz, std::span<const MotionPair> pairs,
                   Random& random) {
  constexpr double least_error_deg = 0.05;
  const MotionSample& pair = pairs[random.below(pairs.size())].sample;
  const MotionTake& take = pair.take;
  PoseMatrix errors(take.frames, take.channels);
  for (std::size_t i = 0; i < errors.values.size(); ++i)
    errors.values[i] = static_cast<double>(take.values[i]) - static_cast<double>(pair.truth[i]);
  const std::vector<double> sizes = deviations_of(errors);
  std::vector<std::size_t> erring;
  for (std::size_t c = 0; c < sizes.size(); ++c)
    if (sizes[c] > least_error_deg) erring.push_back(c);
  if (erring.empty()) return;
  const double pace = random_pace(random) * take.frame_rate_hz / rate_hz;
  const PoseMatrix stretch = played(errors, pace, poses.frames, random);
  const double size_deg = log_uniform(random, 0.5, 8);
  for (std::size_t n = 0; n < poses.channels / 3; ++n) {
    const double own_deg = size_deg * portable::exp(0.5 * random.normal());
    for (std::size_t c = 3 * n; c < 3 * n + 3; ++c) {
      const std::size_t from = erring[random.below(erring.size())];
      // Separate statements: compilers evaluate two draws in one expression in different orders.
      const double sign = random.chance(0.5) ? 1 : -1;
      const double factor = sign * own_deg * random.uniform(0.3, 1) / sizes[from];
      for (std::size_t f = 0; f < poses.frames; ++f) poses(f, c) += factor * stretch(f, from);
    }
  }
}

MotionSample random_rig_sample(const MotionSources& sources, std::size_t channels,
                               const MotionSampling& sampling, Random random) {
  const RigMotion& motion = sources.rigs[random.below(sources.rigs.size())];
  const double rate_hz = random.chance(0.7) ? motion.rate_hz : random_rate_hz(random);
  const double pace = random_pace(random) * motion.rate_hz / rate_hz;
  const PoseMatrix all = played(motion.values, pace, sample_frames(sampling, rate_hz), random);
  const std::vector<std::size_t> tracks = some_tracks(all, channels / 3, random);
  PoseMatrix truth(all.frames, 3 * tracks.size());
  MotionSample sample;
  MotionTake& take = sample.take;
  take.slots.assign(channels, -1);
  take.is_position.assign(channels, 0);
  const bool is_known = random.chance(0.7);
  for (std::size_t n = 0; n < tracks.size(); ++n) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t to = 3 * n + axis, from = 3 * tracks[n] + axis;
      for (std::size_t f = 0; f < all.frames; ++f) truth(f, to) = all(f, from);
      take.is_position[to] = motion.is_position[from];
      if (is_known) take.slots[to] = motion.slots[from];
    }
    if (take.slots[3 * n] < 0) turn_track(truth, n, random);
  }
  PoseMatrix seen = truth;
  std::vector<std::uint8_t> observed;
  SampleDamage damage = SampleDamage::none;
  // In practice, takes of other rigs are mostly clean.
  if (random.chance(0.5)) damage = damage_rig(seen, rate_hz, sources, sampling, observed, random);
  const std::vector<double> origin(truth.channels, 0.0);
  put_values(sample, seen, truth, origin, observed, channels);
  take.frame_rate_hz = rate_hz;
  take.expects_slow_noise = is_said_to_be_slow(damage, random);
  return sample;
}

}  // namespace kinemend
