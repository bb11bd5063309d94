// Draws noise of many colours and strengths, and varies clean motion.
#include "lab/samples/motion_noise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "kinemend/extend/rotation.hpp"
#include "kinemend/extend/signal.hpp"
#include "lab/samples/sequence_damage.hpp"

namespace kinemend {

namespace {

// Noise of deviation 1 in every channel: white, of the first order, or low-passed.
struct UnitNoise {
  PoseMatrix values;
  bool is_slow = false;
};

UnitNoise unit_noise(std::size_t frames, std::size_t channels, double rate_hz, bool has_slow,
                     Random& random) {
  // Slower noise hardly changes from frame to frame. Chosen by hand, not swept.
  constexpr double slow_time_s = 0.1, slow_cutoff_hz = 6;
  PoseMatrix noise(frames, channels);
  for (double& value : noise.values) value = random.normal();
  const double kind = random.uniform();
  if (kind < 0.4) return {std::move(noise), false};
  if (kind < 0.65 || !has_slow) {
    const double correlation = random.uniform(0.2, 0.98),
                 fresh = std::sqrt(1 - correlation * correlation);
    for (std::size_t f = 1; f < frames; ++f) {
      for (std::size_t c = 0; c < channels; ++c)
        noise(f, c) = correlation * noise(f - 1, c) + fresh * noise(f, c);
    }
    const bool is_slow = -1 / (portable::log(correlation) * rate_hz) > slow_time_s;
    return {std::move(noise), is_slow};
  }
  // Separate statements: compilers evaluate two draws among the arguments of one call in different
  // orders.
  const double cutoff_hz = log_uniform(random, 0.7, 12);
  low_pass(noise, 1 + static_cast<int>(random.below(4)), cutoff_hz, rate_hz);
  double square = 0;
  for (const double value : noise.values) square += value * value;
  const double unit = std::sqrt(static_cast<double>(noise.values.size()) / std::max(square, 1e-12));
  for (double& value : noise.values) value *= unit;
  return {std::move(noise), cutoff_hz < slow_cutoff_hz};
}

// Noise in bursts: a factor for each frame.
std::vector<double> bursts(std::size_t frames, double rate_hz, Random& random) {
  PoseMatrix slow(frames, 1);
  for (double& value : slow.values) value = random.normal();
  low_pass(slow, 2, random.uniform(0.3, 1), rate_hz);
  double square = 0;
  for (const double value : slow.values) square += value * value;
  const double unit = std::sqrt(static_cast<double>(frames) / std::max(square, 1e-12));
  for (double& value : slow.values) value = portable::exp(0.8 * unit * value);
  return slow.values;
}

}  // namespace

std::vector<double> deviations_of(const PoseMatrix& poses) {
  std::vector<double> result;
  for (std::size_t c = 0; c < poses.channels; ++c) {
    double sum = 0, square = 0;
    for (std::size_t f = 0; f < poses.frames; ++f) {
      sum += poses(f, c);
      square += poses(f, c) * poses(f, c);
    }
    const auto n = static_cast<double>(poses.frames);
    result.push_back(std::sqrt(std::max(0.0, square / n - sum * sum / (n * n))));
  }
  return result;
}

void low_pass(PoseMatrix& poses, int order, double cutoff_hz, double rate_hz) {
  filter_zero_phase(poses,
                    butterworth_lowpass(order, std::min(cutoff_hz, 0.45 * rate_hz), rate_hz));
}

bool add_random_noise(PoseMatrix& poses, double rate_hz, std::vector<double> strengths,
                      bool has_slow, Random& random) {
  if (random.chance(0.3)) {
    for (double& strength : strengths) strength *= portable::exp(0.5 * random.normal());
  }
  const UnitNoise noise = unit_noise(poses.frames, poses.channels, rate_hz, has_slow, random);
  const std::vector<double> factors = random.chance(0.15) ? bursts(poses.frames, rate_hz, random)
                                                          : std::vector<double>(poses.frames, 1.0);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t c = 0; c < poses.channels; ++c)
      poses(f, c) += factors[f] * strengths[c] * noise.values(f, c);
  }
  return noise.is_slow;
}

std::vector<double> random_strengths(const PoseMatrix& poses, double chance_of_shares,
                                     Random& random) {
  std::vector<double> strengths(poses.channels, log_uniform(random, 0.15, 6));
  if (!random.chance(chance_of_shares)) return strengths;
  const double share = log_uniform(random, 0.08, 1);
  strengths = deviations_of(poses);
  for (double& strength : strengths) strength *= share;
  return strengths;
}

bool low_pass_at_random(PoseMatrix& poses, double rate_hz, double chance, Random& random) {
  if (!random.chance(chance)) return false;
  const double cutoff_hz = random.uniform(3, 12);
  low_pass(poses, 1 + static_cast<int>(random.below(3)), cutoff_hz, rate_hz);
  return true;
}

// Keeps poses at keys and interpolates between them as animators do: straight, eased, or held.
void keyframe(PoseMatrix& poses, double rate_hz, Random& random) {
  const double apart_s = log_uniform(random, 0.08, 0.5);
  const double kind = random.uniform();
  std::vector<std::size_t> keys{0};
  while (keys.back() + 1 < poses.frames) {
    const auto on = static_cast<std::size_t>(apart_s * rate_hz * random.uniform(0.4, 1.6)) + 1;
    keys.push_back(std::min(poses.frames - 1, keys.back() + on));
  }
  const PoseMatrix keyed = poses;
  for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
    const std::size_t from = keys[k], to = keys[k + 1];
    for (std::size_t f = from + 1; f < to; ++f) {
      const double t = static_cast<double>(f - from) / static_cast<double>(to - from);
      const double share = kind < 0.3 ? t : kind < 0.85 ? smooth_step(t) : 0;
      for (std::size_t c = 0; c < poses.channels; ++c)
        poses(f, c) = keyed(from, c) + share * (keyed(to, c) - keyed(from, c));
    }
  }
}

// Scales each channel's motion about its mean up or down.
void exaggerate(PoseMatrix& poses, Random& random) {
  const double factor = log_uniform(random, 0.5, 2);
  for (std::size_t c = 0; c < poses.channels; ++c) {
    double mean = 0;
    for (std::size_t f = 0; f < poses.frames; ++f) mean += poses(f, c);
    mean /= static_cast<double>(poses.frames);
    for (std::size_t f = 0; f < poses.frames; ++f)
      poses(f, c) = mean + factor * (poses(f, c) - mean);
  }
}

void vary_motion(PoseMatrix& poses, double rate_hz, const Shaking& shaking, Random& random) {
  if (random.chance(0.1)) exaggerate(poses, random);
  if (random.chance(0.08)) keyframe(poses, rate_hz, random);
  if (random.chance(0.2)) {
    const double cutoff_hz = log_uniform(random, 4, 20);
    low_pass(poses, 1 + static_cast<int>(random.below(3)), cutoff_hz, rate_hz);
  }
  if (!random.chance(shaking.chance)) return;
  const double frequency_hz = log_uniform(random, 0.2, 12), share = random.uniform(0.05, 0.5);
  const double largest_deg =
      log_uniform(random, 0.1, shaking.largest_deg) / std::max(1.0, frequency_hz / 2);
  const std::size_t frames = poses.frames, first = random.below(frames),
                    last = first + random.below(frames - first) + 1;
  const auto ramp = 0.3 * rate_hz;  // frames of fading in and out
  constexpr double turn = 2 * std::numbers::pi;
  for (std::size_t c = 0; c < poses.channels; ++c) {
    if (!random.chance(share)) continue;
    const double size = largest_deg * random.uniform(0.1, 1), outset = random.uniform(0, turn);
    for (std::size_t f = first; f < last; ++f) {
      const auto inside = static_cast<double>(std::min(f - first, last - 1 - f));
      poses(f, c) += size * std::min(1.0, inside / ramp) *
                     portable::sin(outset + turn * frequency_hz * static_cast<double>(f) / rate_hz);
    }
  }
}

bool is_said_to_be_slow(SampleDamage damage, Random& random) {
  // A video system can be accurate, and other systems err slowly, too. Chosen by hand, not swept.
  return random.chance(damage == SampleDamage::none    ? 0.1
                       : damage == SampleDamage::quick ? 0.25
                                                       : 0.6);
}

Quat random_turn(Random& random) {
  return normalized(Quat{random.normal(), random.normal(), random.normal(), random.normal()});
}

void turn_track(PoseMatrix& poses, std::size_t track, Random& random) {
  const Quat turn = random_turn(random);
  for (std::size_t f = 0; f < poses.frames; ++f) {
    double* const v = &poses(f, 3 * track);
    const Vec3 turned = rotate(turn, Vec3{v[0], v[1], v[2]});
    v[0] = turned.x, v[1] = turned.y, v[2] = turned.z;
  }
}

PoseMatrix random_part(const PoseMatrix& motion, std::size_t frames, Random& random) {
  const std::size_t taken = std::min(frames, motion.frames);
  const std::size_t first = random.below(motion.frames - taken + 1);
  PoseMatrix part(taken, motion.channels);
  std::copy_n(motion.row(first).begin(), part.values.size(), part.values.begin());
  return part;
}

std::size_t drawn_index(std::span<const double> weights, Random& random) {
  std::vector<double> ends(weights.size());
  std::partial_sum(weights.begin(), weights.end(), ends.begin());
  const double at = random.uniform() * ends.back();
  return static_cast<std::size_t>(std::upper_bound(ends.begin(), ends.end(), at) - ends.begin());
}

double random_rate_hz(Random& random) {
  // Common rates; most takes keep the 120 Hz of the recordings. Chosen by hand, not swept.
  static constexpr std::array<double, 10> rates{20, 24, 25, 30, 30, 50, 60, 60, 100, 240};
  return random.chance(0.4) ? rates[random.below(rates.size())] : 120;
}

double random_pace(Random& random) {
  // Shares of the speed of the recorded motion. Chosen by hand, not swept.
  constexpr double least = 0.7, fastest = 1.4, slowed = 0.5, hurried = 3;
  return random.chance(0.2) ? log_uniform(random, slowed, hurried) : random.uniform(least, fastest);
}

}  // namespace kinemend
