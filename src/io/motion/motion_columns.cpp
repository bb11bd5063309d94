// Computes the products of channel rotations, holds missing samples, makes the position frames of
// formats, and computes sines of half angles by series that compilers turn into SIMD code.
#include "io/motion/motion_columns.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/portable.hpp"
#include "io/text/text.hpp"
#include "kinemend/extend/rotation.hpp"

namespace kinemend {

std::optional<Channel> channel_named(std::string_view word) {
  for (std::size_t i = 0; i < channel_names.size(); ++i) {
    if (equal_ignoring_case(word, channel_names[i])) return static_cast<Channel>(i);
  }
  return std::nullopt;
}

namespace {

// For speed, not swept.
constexpr std::size_t block_samples = 1024;

struct Track {
  const double* sines;
  const double* cosines;
  std::size_t angle_stride;
  Quat* out;
  std::size_t out_stride;
  std::size_t frames;
};

// Three different axes a, b, c: the product (ca + sa a)(cb + sb b)(cc + sc c) expanded, with ab =
// +-c.
template <int a, int b, int c>
void compose_three(const Track& track) {
  constexpr double e = (a + 1) % 3 == b ? 1.0 : -1.0;
  for (std::size_t f = 0; f < track.frames; ++f) {
    const double* s = track.sines + f * track.angle_stride;
    const double* k = track.cosines + f * track.angle_stride;
    const double cc = k[0] * k[1], sc = s[0] * k[1], cs = k[0] * s[1], ss = e * (s[0] * s[1]);
    const double w = cc * k[2] - ss * s[2];
    const double along[3] = {sc * k[2] + e * (cs * s[2]), cs * k[2] - e * (sc * s[2]),
                             cc * s[2] + ss * k[2]};
    constexpr int at_x = a == 0   ? 0
                         : b == 0 ? 1
                                  : 2,
                  at_y = a == 1   ? 0
                         : b == 1 ? 1
                                  : 2,
                  at_z = 3 - at_x - at_y;
    track.out[f * track.out_stride] = {w, along[at_x], along[at_y], along[at_z]};
  }
}

Quat turn(Axis axis, double sine, double cosine) {
  return {cosine, axis == Axis::x ? sine : 0, axis == Axis::y ? sine : 0,
          axis == Axis::z ? sine : 0};
}

void compose_any(const Track& track, RotationOrder order) {
  for (std::size_t f = 0; f < track.frames; ++f) {
    Quat q;
    for (std::size_t i = 0; i < order.count; ++i) {
      const std::size_t at = f * track.angle_stride + i;
      q = q * turn(order.axes[i], track.sines[at], track.cosines[at]);
    }
    track.out[f * track.out_stride] = q;
  }
}

void compose(const Track& track, RotationOrder order) {
  const auto code = order.count == 3
                        ? static_cast<int>(order.axes[0]) * 9 +
                              static_cast<int>(order.axes[1]) * 3 + static_cast<int>(order.axes[2])
                        : -1;
  switch (code) {
    case 0 * 9 + 1 * 3 + 2:
      return compose_three<0, 1, 2>(track);
    case 0 * 9 + 2 * 3 + 1:
      return compose_three<0, 2, 1>(track);
    case 1 * 9 + 0 * 3 + 2:
      return compose_three<1, 0, 2>(track);
    case 1 * 9 + 2 * 3 + 0:
      return compose_three<1, 2, 0>(track);
    case 2 * 9 + 0 * 3 + 1:
      return compose_three<2, 0, 1>(track);
    case 2 * 9 + 1 * 3 + 0:
      return compose_three<2, 1, 0>(track);
    default:
      return compose_any(track, order);
  }
}

}  // namespace

MotionColumns::MotionColumns(const Skeleton& skeleton) {
  const std::size_t joints = skeleton.joint_count();
  rotations_.resize(joints);
  for (std::size_t j = 0; j < joints; ++j) {
    Rotation& rotation = rotations_[j];
    rotation.order = skeleton.rotation_order(j);
    std::int32_t translated = -1;
    if (j > 0 && skeleton.has_position_channels(j)) {
      translated = static_cast<std::int32_t>(translated_joints_.size());
      translated_joints_.push_back(static_cast<std::int32_t>(j));
    }
    std::size_t turns = 0;
    for (const Channel channel : skeleton.channels[j]) {
      if (is_rotation(channel)) {
        rotation.columns[turns++] = count_;
      } else {
        positions_.push_back({count_, translated, axis_of(channel)});
      }
      ++count_;
    }
  }
  block_frames_ = std::max<std::size_t>(1, block_samples / std::max<std::size_t>(1, joints));
}

void MotionColumns::decode_rotations(const double* rows, std::size_t frames, Quat* rotations) {
  const std::size_t joints = rotations_.size(), width = 3 * joints;
  if (degrees_.empty()) {
    degrees_.resize(block_frames_ * width);
    sines_.resize(degrees_.size());
    cosines_.resize(degrees_.size());
  }
  for (std::size_t f = 0; f < frames; ++f) {
    const double* row = rows + f * count_;
    double* degrees = degrees_.data() + f * width;
    for (std::size_t j = 0; j < joints; ++j) {
      const Rotation& rotation = rotations_[j];
      for (std::size_t i = 0; i < rotation.order.count; ++i)
        degrees[3 * j + i] = row[rotation.columns[i]];
    }
  }
  half_angle_sincos(degrees_.data(), frames * width, sines_.data(), cosines_.data());
  for (std::size_t j = 0; j < joints; ++j) {
    compose({sines_.data() + 3 * j, cosines_.data() + 3 * j, width, rotations + j, joints, frames},
            rotations_[j].order);
  }
}

bool is_gap(Quat q) {
  return std::isnan(q.w) || std::isnan(q.x) || std::isnan(q.y) || std::isnan(q.z);
}

void hold_rotations(Quat* rotations, std::size_t frames, std::size_t joints, const Quat* previous,
                    std::uint8_t* observed) {
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      const std::size_t at = f * joints + j;
      if (!is_gap(rotations[at])) continue;
      rotations[at] = f == 0 ? previous[j] : rotations[at - joints];
      if (observed != nullptr) observed[at] = 0;
    }
  }
}

void hold_positions(double* rows, std::size_t frames, const MotionColumns& columns,
                    std::span<const double> previous) {
  for (std::size_t f = 0; f < frames; ++f) {
    for (std::size_t i = 0; i < previous.size(); ++i) {
      const std::size_t at = f * columns.count() + columns.positions()[i].column;
      if (std::isnan(rows[at])) rows[at] = f == 0 ? previous[i] : rows[at - columns.count()];
    }
  }
}

namespace {

template <class MakeFrame>
std::vector<PositionFrame> frames_of(const Skeleton& skeleton, MakeFrame&& make_frame) {
  std::vector<PositionFrame> frames;
  for (std::size_t j = 0; j < skeleton.joint_count(); ++j) {
    if (j == 0 || skeleton.has_position_channels(j)) frames.push_back(make_frame(j));
  }
  return frames;
}

}  // namespace

std::vector<PositionFrame> offset_replacing_frames(const Skeleton& skeleton) {
  return frames_of(skeleton, [&](std::size_t j) {
    return PositionFrame{skeleton.offsets[j], {}, {}};
  });
}

std::vector<PositionFrame> offset_adding_frames(const Skeleton& skeleton) {
  return frames_of(skeleton, [&](std::size_t j) {
    return PositionFrame{{}, skeleton.offsets[j], j == 0 ? Quat{} : skeleton.rest_rotations[j]};
  });
}

namespace {

// Taylor series; the error on [-pi/4, pi/4] is below 1e-18.
double sine_kernel(double x) {
  const double z = x * x;
  double sum = 1.0 / 355687428096000.0;
  sum = sum * z - 1.0 / 1307674368000.0;
  sum = sum * z + 1.0 / 6227020800.0;
  sum = sum * z - 1.0 / 39916800.0;
  sum = sum * z + 1.0 / 362880.0;
  sum = sum * z - 1.0 / 5040.0;
  sum = sum * z + 1.0 / 120.0;
  sum = sum * z - 1.0 / 6.0;
  return x + x * (z * sum);
}

double cosine_kernel(double x) {
  const double z = x * x;
  double sum = 1.0 / 20922789888000.0;
  sum = sum * z - 1.0 / 87178291200.0;
  sum = sum * z + 1.0 / 479001600.0;
  sum = sum * z - 1.0 / 3628800.0;
  sum = sum * z + 1.0 / 40320.0;
  sum = sum * z - 1.0 / 720.0;
  sum = sum * z + 1.0 / 24.0;
  sum = sum * z - 0.5;
  return 1.0 + z * sum;
}

// The loop has no branches so that it becomes SIMD code. |degrees| is at most 1e12.
void sincos_block(const double* __restrict degrees, std::size_t count, double* __restrict sines,
                  double* __restrict cosines) {
  // Adding 1.5 * 2^52 rounds to an integer and leaves it in the low bits.
  constexpr double rounder = 6755399441055744.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = degrees[i] * (1.0 / 180.0) + rounder;
    const double remainder = degrees[i] - 180.0 * (shifted - rounder);
    const std::uint64_t quarter = bits_as<std::uint64_t>(shifted);
    const double x = remainder * (pi / 360.0);
    const std::uint64_t s = bits_as<std::uint64_t>(sine_kernel(x));
    const std::uint64_t c = bits_as<std::uint64_t>(cosine_kernel(x));
    const std::uint64_t swap = 0 - (quarter & 1);
    const std::uint64_t exchange = (s ^ c) & swap;
    sines[i] = bits_as<double>((s ^ exchange) ^ (quarter & 2) << 62);
    cosines[i] = bits_as<double>((c ^ exchange) ^ ((quarter + 1) & 2) << 62);
  }
}

}  // namespace

void half_angle_sincos(const double* degrees, std::size_t count, double* sines, double* cosines) {
  sincos_block(degrees, count, sines, cosines);
  // Degrees above which the fast sines lose digits; chosen by hand, not swept.
  constexpr double exact_limit = 1e12;
  for (std::size_t i = 0; i < count; ++i) {
    if (std::fabs(degrees[i]) <= exact_limit) continue;
    const double reduced = std::fmod(degrees[i], 720.0);
    sincos_block(&reduced, 1, sines + i, cosines + i);
  }
}

}  // namespace kinemend
