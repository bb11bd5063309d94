// Decodes points that are stored as reals or integers of any processor type.
#include "io/c3d/c3d_points.hpp"

#include <algorithm>
#include <cmath>

namespace kinemend {

namespace {

struct Sample {
  float x, y, z;
  float fourth;  // the fourth word as a real; 0 in files of integers
  std::int32_t word;
};

template <class Words>
struct RealSamples {
  static constexpr std::size_t bytes = 16;
  static Sample load(const char* p) {
    const float word = Words::real(p + 12);
    // A value beyond 16 bits is not a valid word, and NaN compares false.
    const bool usable = word >= 0.0f && word < 32768.0f;
    return {Words::real(p), Words::real(p + 4), Words::real(p + 8), word,
            usable ? static_cast<std::int32_t>(word) : missing_point_word};
  }
};

template <class Words>
struct IntegerSamples {
  static constexpr std::size_t bytes = 8;
  static Sample load(const char* p) {
    const auto number = [&](std::size_t i) {
      return static_cast<float>(static_cast<std::int16_t>(Words::word(p + 2 * i)));
    };
    return {number(0), number(1), number(2), 0, static_cast<std::int16_t>(Words::word(p + 6))};
  }
};

// Whether all numbers are finite: zero times infinity is NaN.
bool is_finite(const Sample& s) {
  return (s.x * 0.0f + s.y * 0.0f + s.z * 0.0f + s.fourth * 0.0f) == 0.0f;
}

template <class Samples>
void decode_frame(const char* p, std::size_t points, double scale, float residual_scale,
                  Vec3* positions, std::uint8_t* observed, float* residuals,
                  C3dPointCounts& counts) {
  std::size_t not_finite = 0, missing_not_finite = 0, zeros = 0;
  std::uint32_t cameras = 0;
  for (std::size_t i = 0; i < points; ++i, p += Samples::bytes) {
    const Sample s = Samples::load(p);
    const bool marked = s.word < 0, finite = is_finite(s), here = !marked && finite;
    const auto word = static_cast<std::uint32_t>(here ? s.word : 0);
    positions[i] = here ? Vec3{scale * static_cast<double>(s.x), scale * static_cast<double>(s.y),
                               scale * static_cast<double>(s.z)}
                        : Vec3{};
    observed[i] = here ? 1 : 0;
    residuals[i] = here ? residual_scale * static_cast<float>(word & 255) : -1.0f;
    cameras |= word >> 8;
    not_finite += !marked && !finite ? 1 : 0;
    missing_not_finite += marked && !finite ? 1 : 0;
    zeros += here && s.x == 0 && s.y == 0 && s.z == 0 ? 1 : 0;
  }
  counts.not_finite += not_finite;
  counts.missing_not_finite += missing_not_finite;
  counts.zeros += zeros;
  counts.cameras |= cameras;
}

}  // namespace

void C3dPoints::resize(std::size_t count) {
  positions.resize(count);
  observed.resize(count);
  residuals.resize(count);
}

std::int32_t c3d_point_word(float residual, double scale, std::int32_t before) {
  const auto unit = static_cast<float>(scale);
  if (before >= 0 && residual == unit * static_cast<float>(before & 255)) return before;
  if (!(residual > 0)) return 0;
  const double steps = std::clamp(std::round(static_cast<double>(residual) / scale), 1.0, 255.0);
  return static_cast<std::int32_t>(steps) | (before >= 0 ? before & 0x7F00 : 0);
}

std::size_t c3d_block_frames(const C3dLayout& layout) {
  // For speed, not swept.
  constexpr std::size_t block_samples = 512;
  return std::max<std::size_t>(1, block_samples / std::max<std::size_t>(layout.point_count, 1));
}

void C3dPointDecoder::decode(const char* frames, std::size_t count, C3dPoints& out) {
  const std::size_t points = layout_.point_count, stride = layout_.frame_bytes();
  with_words(processor_, [&](auto words) {
    using Words = decltype(words);
    const auto decode_as = [&]<class Samples>(Samples, double scale) {
      for (std::size_t f = 0; f < count; ++f) {
        decode_frame<Samples>(frames + f * stride, points, scale, static_cast<float>(layout_.scale),
                              out.positions.data() + f * points, out.observed.data() + f * points,
                              out.residuals.data() + f * points, counts_);
      }
    };
    if (layout_.is_float) {
      decode_as(RealSamples<Words>{}, 1.0);
    } else {
      decode_as(IntegerSamples<Words>{}, layout_.scale);
    }
  });
}

}  // namespace kinemend
