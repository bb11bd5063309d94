// Rounds the channels of both takes to quanta, predicts each sample from those before it, and packs
// the remainders.
#include "report/page/codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "base/portable.hpp"

namespace kinemend::page {

namespace {

using Words = std::vector<std::uint32_t>;

// Maps 0, -1, 1, ... to 0, 1, 2, ...
std::uint32_t folded(std::uint32_t remainder) {
  return (remainder << 1) ^ (0U - (remainder >> 31));
}

// Returns the approximate number of bits of the remainders.
double cost(const Words& remainders) {
  double bits = 0;
  for (const std::uint32_t word : remainders) bits += portable::log2(1.0 + word);
  return bits;
}

void append_coded(std::span<const Words> candidates, std::string& bytes) {
  std::size_t best = 0;
  for (std::size_t c = 1; c < candidates.size(); ++c) {
    if (cost(candidates[c]) < cost(candidates[best])) best = c;
  }
  bytes += static_cast<char>(best);
  for (int shift = 0; shift < 32; shift += 8) {
    for (const std::uint32_t word : candidates[best])
      bytes += static_cast<char>((word >> shift) & 0xFFU);
  }
}

Words words_of(const std::vector<std::int32_t>& samples) {
  return {samples.begin(), samples.end()};
}

Words difference(const Words& a, const Words& b) {
  Words result(a.size());
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), std::minus<>());
  return result;
}

void append_first(const Words& samples, std::size_t stride, std::string& bytes) {
  std::array<Words, 3> candidates;
  std::uint32_t last = 0, before_last = 0;
  for (std::size_t f = 0; f < samples.size(); f += stride) {
    const std::uint32_t sample = samples[f];
    candidates[0].push_back(folded(sample));
    candidates[1].push_back(folded(sample - last));
    candidates[2].push_back(folded(sample - 2 * last + before_last));
    before_last = f == 0 ? sample : last;
    last = sample;
  }
  append_coded(candidates, bytes);
}

// Returns the sample `part` of `stride` steps along the line from `a` to `b`, rounded down.
std::uint32_t between(std::uint32_t a, std::uint32_t b, std::size_t part, std::size_t stride) {
  const auto from = static_cast<std::int32_t>(a);
  const auto way = static_cast<std::int64_t>(static_cast<std::int32_t>(b)) - from;
  const auto scaled = static_cast<double>(way * static_cast<std::int64_t>(part));
  return a + static_cast<std::uint32_t>(
                 static_cast<std::int64_t>(std::floor(scaled / static_cast<double>(stride))));
}

void append_second(const Words& samples, std::size_t stride, std::string& bytes) {
  std::array<Words, 2> candidates;
  for (std::size_t f = 0; f < samples.size(); ++f) {
    const std::size_t part = f % stride;
    if (part == 0) continue;
    const std::size_t left = f - part, right = left + stride;
    const std::uint32_t line = right < samples.size()
                                   ? between(samples[left], samples[right], part, stride)
                                   : samples[left];
    candidates[0].push_back(folded(samples[f]));
    candidates[1].push_back(folded(samples[f] - line));
  }
  append_coded(candidates, bytes);
}

// Returns the roughness of a track: the size of its second differences.
double roughness(const std::vector<std::int32_t>& samples) {
  double sum = 0;
  for (std::size_t f = 2; f < samples.size(); ++f)
    sum += std::fabs(static_cast<double>(samples[f]) - 2.0 * samples[f - 1] + samples[f - 2]);
  return sum;
}

template <class Append>
std::string part_of(std::span<const Quantised> channels, const Append& append) {
  std::string bytes;
  for (const Quantised& channel : channels) {
    if (channel.before.empty()) continue;
    const Words before = words_of(channel.before), after = words_of(channel.after);
    if (after.empty()) {
      append(before, bytes);
      continue;
    }
    // Noise costs most, so it is coded only once, in the difference.
    const bool before_first = roughness(channel.before) < roughness(channel.after);
    bytes += static_cast<char>(before_first ? 1 : 0);
    const Words& first = before_first ? before : after;
    append(first, bytes);
    append(difference(before_first ? after : before, first), bytes);
  }
  return bytes;
}

}  // namespace

std::vector<std::int32_t> quantised(std::span<const double> values, double quantum) {
  std::vector<std::int32_t> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(), [&](double value) {
    return std::isfinite(value) ? static_cast<std::int32_t>(std::llround(value / quantum)) : 0;
  });
  return result;
}

double quantum_for(double quantum, double largest) {
  // The limit of 2^30 in codec.hpp. By definition.
  constexpr double most = 1 << 30;
  return std::max(quantum, largest / most);
}

std::string first_part(std::span<const Quantised> channels, std::size_t stride) {
  return part_of(channels, [&](const Words& samples, std::string& bytes) {
    append_first(samples, stride, bytes);
  });
}

std::string second_part(std::span<const Quantised> channels, std::size_t stride) {
  if (stride <= 1) return "";
  return part_of(channels, [&](const Words& samples, std::string& bytes) {
    append_second(samples, stride, bytes);
  });
}

namespace {

/// One value for each stored frame.
using Values = std::vector<double>;

double largest_of(const Values& values) {
  double largest = 0;
  for (const double value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::fabs(value));
  }
  return largest;
}

void add(const Values& before, const Values& after, double quantum, Channels& channels) {
  const double used = quantum_for(quantum, std::max(largest_of(before), largest_of(after)));
  channels.samples.push_back({quantised(before, used), quantised(after, used)});
  channels.quanta.push_back(used);
}

Channels empty_channels(std::size_t frames, std::size_t count) {
  Channels channels;
  channels.step = frame_step(frames, count);
  channels.frames = (frames + channels.step - 1) / channels.step;
  return channels;
}

void append(Channels more, Channels& channels) {
  std::move(more.samples.begin(), more.samples.end(), std::back_inserter(channels.samples));
  channels.quanta.insert(channels.quanta.end(), more.quanta.begin(), more.quanta.end());
}

using PositionAt = std::function<Vec3(std::size_t frame)>;

std::array<Values, 3> positions(const Channels& channels, const PositionAt& at) {
  std::array<Values, 3> axes;
  for (std::size_t f = 0; f < channels.frames; ++f) {
    const Vec3 p = at(f * channels.step);
    axes[0].push_back(p.x);
    axes[1].push_back(p.y);
    axes[2].push_back(p.z);
  }
  return axes;
}

// `after` is empty if there is one take.
void add_positions(const PositionAt& before, const PositionAt& after, double quantum,
                   Channels& channels) {
  const auto old_values = positions(channels, before);
  const auto new_values = after ? positions(channels, after) : std::array<Values, 3>();
  for (std::size_t axis = 0; axis < 3; ++axis)
    add(old_values[axis], new_values[axis], quantum, channels);
}

PositionAt position_of(const Take* clip, std::size_t track) {
  if (clip == nullptr) return {};
  return [clip, track](std::size_t frame) { return clip->position(frame, track); };
}

void add_rotation(const Take& before, const Take* after, std::size_t joint, RotationOrder order,
                  double quantum_deg, Channels& channels) {
  std::array<Values, 3> old_angles, new_angles;
  std::array<double, 3> angles{};
  for (std::size_t f = 0; f < before.frame_count(); f += channels.step) {
    angles = to_euler_near(before.rotation(f, joint), order, angles);
    for (std::size_t a = 0; a < order.count; ++a)
      old_angles[a].push_back(angles[a] * degrees_per_radian);
    if (after == nullptr) continue;
    const auto other = to_euler_near(after->rotation(f, joint), order, angles);
    for (std::size_t a = 0; a < order.count; ++a)
      new_angles[a].push_back(other[a] * degrees_per_radian);
  }
  for (std::size_t a = 0; a < order.count; ++a)
    add(old_angles[a], new_angles[a], quantum_deg, channels);
}

bool turns(const Take& clip, std::size_t joint) {
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (angle_between(clip.rotation(f, joint), Quat{}) > 1e-9) return true;
  }
  return false;
}

PositionAt held_position_of(const Take* clip, std::size_t marker) {
  if (clip == nullptr) return {};
  return [clip, marker, last = Vec3()](std::size_t frame) mutable {
    if (clip->is_observed(frame, marker)) last = clip->position(frame, marker);
    return last;
  };
}

}  // namespace

double position_quantum(double body_height) { return body_height > 0 ? body_height / 17000 : 1e-4; }

std::size_t frame_step(std::size_t frames, std::size_t channels) {
  return std::max<std::size_t>(1, (frames * channels + most_samples - 1) / most_samples);
}

std::size_t part_stride(std::size_t frames, std::size_t channels) {
  return frames * channels > most_samples_at_once ? stride_of_parts : 1;
}

std::size_t channel_count(const Take& take) {
  std::size_t count = 3 * take.point_count();
  for (std::size_t j = 0; j < take.joint_count(); ++j)
    count += take.skeleton.rotation_order(j).count;
  return count;
}

RotationOrder told_order(const Take& before, const Take* after, std::size_t joint) {
  const RotationOrder order = before.skeleton.rotation_order(joint);
  if (order.count > 0) return order;
  const bool does_turn = turns(before, joint) || (after != nullptr && turns(*after, joint));
  return does_turn ? parse_rotation_order("ZXY") : order;
}

Channels channels_of(const Take& before, const Take* after, double body_height, double share) {
  Channels channels = empty_channels(before.frame_count(), channel_count(before));
  const double quantum = share * position_quantum(body_height);
  const bool joints = before.has_joints();
  std::vector<Channels> of_joints(before.joint_count(), channels);
  for (std::size_t p = 0; p < before.point_count(); ++p) {
    if (joints)
      add_positions(position_of(&before, p), position_of(after, p), quantum, channels);
    else
      add_positions(held_position_of(&before, p), held_position_of(after, p), quantum, channels);
  }
  for_each_parallel(of_joints.size(), of_joints.size() * channels.frames, [&](std::size_t j) {
    add_rotation(before, after, j, told_order(before, after, j), share * rotation_quantum_deg,
                 of_joints[j]);
  });
  for (Channels& joint : of_joints) append(std::move(joint), channels);
  return channels;
}

}  // namespace kinemend::page
