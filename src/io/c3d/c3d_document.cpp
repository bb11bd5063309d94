// Keeps the document of a C3D file through conversions. Decodes points and analog samples that are
// stored as reals or integers of any processor type, and hides the zeros that mean gaps.
#include "io/c3d/c3d_document.hpp"

#include <algorithm>
#include <cmath>

#include "io/text/text.hpp"

namespace kinemend {

std::shared_ptr<const SourceDocument> C3dDocument::after(const TakeChange& further) const {
  auto converted = std::make_shared<ConvertedC3d>();
  converted->original = shared_from_this();
  converted->change = further;
  return converted;
}

std::shared_ptr<const SourceDocument> ConvertedC3d::after(const TakeChange& further) const {
  auto converted = std::make_shared<ConvertedC3d>();
  converted->original = original;
  converted->change = both(change, further);
  return converted;
}

C3dOrigin c3d_origin(const SourceInfo& source) {
  const SourceDocument* const document = source.document.get();
  if (const auto* converted = dynamic_cast<const ConvertedC3d*>(document))
    return {converted->original.get(), true, converted->change};
  return {dynamic_cast<const C3dDocument*>(document), false, {}};
}

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

C3dSourceFrames::C3dSourceFrames(const C3dDocument& document)
    : document_(document), decoder_(document.processor, document.layout) {
  const C3dLayout& layout = document.layout;
  points_.resize(c3d_block_frames(layout) * layout.point_count);
  if (document.zero_gaps.empty()) return;
  hidden_.resize(layout.frame_count * layout.point_count);
  for (const ZeroGap& gap : document.zero_gaps) {
    for (std::size_t f = gap.first; f < gap.last; ++f)
      hidden_[f * layout.point_count + gap.marker] = 1;
  }
}

bool C3dSourceFrames::next() {
  const C3dLayout& layout = document_.layout;
  first_ += count_;
  count_ = std::min(c3d_block_frames(layout), layout.frame_count - first_);
  if (count_ == 0 || layout.point_count == 0) return false;
  decoder_.decode(document_.bytes.data() + frame_begin(0), count_, points_);
  if (!hidden_.empty()) hide_zero_gaps();
  return true;
}

std::size_t C3dSourceFrames::frame_begin(std::size_t block_frame) const {
  return document_.layout.data_begin + (first_ + block_frame) * document_.layout.frame_bytes();
}

void C3dSourceFrames::hide_zero_gaps() {
  const std::size_t points = document_.layout.point_count;
  const std::uint8_t* const hidden = hidden_.data() + first_ * points;
  for (std::size_t i = 0; i < count_ * points; ++i) {
    if (hidden[i] == 0) continue;
    points_.observed[i] = 0;
    points_.residuals[i] = -1;
  }
}

std::int32_t C3dSourceFrames::word(std::size_t block_frame, std::size_t point) const {
  const C3dLayout& layout = document_.layout;
  if (points_.observed[block_frame * layout.point_count + point] == 0) return missing_point_word;
  const char* const place =
      document_.bytes.data() + frame_begin(block_frame) + (4 * point + 3) * layout.value_bytes();
  return with_words(document_.processor, [&](auto words) {
    return layout.is_float ? static_cast<std::int32_t>(words.real(place))
                           : static_cast<std::int32_t>(words.word(place));
  });
}

namespace {

std::vector<double> per_channel(const C3dDocument& document, const char* name, double otherwise) {
  std::vector<double> values = document.parameters.numbers("ANALOG", name);
  values.resize(document.layout.analog_count, otherwise);
  return values;
}

}  // namespace

C3dAnalogDecoder::C3dAnalogDecoder(const C3dDocument& document)
    : document_(document),
      is_unsigned_(equal_ignoring_case(document.parameters.text("ANALOG", "FORMAT"), "UNSIGNED")),
      // Some writers call it OFFSETS.
      offsets_(per_channel(document,
                           document.parameters.find("ANALOG", "OFFSET") ? "OFFSET" : "OFFSETS", 0)),
      scales_(per_channel(document, "SCALE", 1)) {
  for (double& offset : offsets_) offset += is_unsigned_ && offset < 0 ? 65536 : 0;
  const double general = document.parameters.number("ANALOG", "GEN_SCALE").value_or(1);
  for (double& scale : scales_) scale *= general;
}

void C3dAnalogDecoder::stored(std::size_t frame, std::vector<double>& values) const {
  const C3dLayout& layout = document_.layout;
  const char* const from = document_.bytes.data() + layout.data_begin +
                           frame * layout.frame_bytes() + layout.point_bytes();
  values.resize(layout.analog_values);
  with_words(document_.processor, [&](auto words) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const char* const p = from + i * layout.value_bytes();
      if (layout.is_float) {
        values[i] = words.real(p);
      } else {
        const std::uint16_t word = words.word(p);
        values[i] = is_unsigned_ ? word : static_cast<std::int16_t>(word);
      }
    }
  });
}

}  // namespace kinemend
