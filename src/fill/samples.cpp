// Finds the frames beside a gap and the markers that help, and places the mean shape of a group of
// markers in each frame.
#include "fill/samples.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "fill/judgement.hpp"
#include "motion/rotation.hpp"

namespace kinemend::fill {

namespace {

// The support of the splines, doubled because it may contain other gaps, and a minimum of frames.
constexpr double window_s = 0.5;
constexpr std::size_t least_window = 64;
// Chosen with the memories of `Bridge`, on the takes that docs/measured/fill.md names.
constexpr std::size_t most_beside = 12;
constexpr double beside_s = 0.5;
constexpr std::size_t most_radius_frames = 64;  // for speed

}  // namespace

std::size_t Samples::frames_in(double seconds, std::size_t least) const {
  return kinemend::frames_in(seconds, frame_rate_hz, least);
}

double body_radius(const Samples& samples) {
  double sum = 0, count = 0;
  const std::size_t step = samples.frames / most_radius_frames + 1;
  for (std::size_t f = 0; f < samples.frames; f += step) {
    Vec3 centre;
    double seen = 0;
    for (const std::size_t m : samples.bodies) {
      if (samples.sees(f, m)) centre += samples.at(f, m), seen += 1;
    }
    if (seen < 2) continue;
    centre = (1 / seen) * centre;
    for (const std::size_t m : samples.bodies) {
      if (!samples.sees(f, m)) continue;
      const Vec3 off = samples.at(f, m) - centre;
      sum += dot(off, off), count += 1;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

Track track_around(const Samples& samples, const MarkerGap& gap) {
  const FrameSpan window = surroundings(
      gap.span, gap.ends, 2 * samples.frames_in(window_s, least_window), samples.frames);
  Track track{std::vector<Vec3>(window.length()), std::vector<std::uint8_t>(window.length())};
  track.first_frame = window.first;
  for (std::size_t f = window.first; f <= window.last; ++f) {
    if (!samples.measures(f, gap.marker) || gap.covers(f)) continue;
    track.values[f - window.first] = samples.at(f, gap.marker);
    track.observed[f - window.first] = 1;
  }
  return track;
}

std::vector<std::size_t> frames_showing(const Samples& samples, const MarkerGap& gap,
                                        std::span<const std::size_t> others) {
  const FrameSpan evidence = evidence_around(gap.span, samples.frames, samples.frame_rate_hz);
  std::vector<std::size_t> frames;
  for (std::size_t f = evidence.first; f <= evidence.last; ++f) {
    if (samples.measures(f, gap.marker) && !gap.covers(f) && samples.sees(f, others))
      frames.push_back(f);
  }
  return frames;
}

std::vector<std::size_t> frames_beside(const Samples& samples, const MarkerGap& gap,
                                       std::span<const std::size_t> others) {
  const FrameSpan reached =
      surroundings(gap.span, gap.ends, samples.frames_in(beside_s, most_beside), samples.frames);
  std::vector<std::size_t> found;
  for (std::size_t f = gap.span.first; f-- > reached.first && found.size() < most_beside;) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  std::reverse(found.begin(), found.end());
  const std::size_t most = found.size() + most_beside;
  for (std::size_t f = gap.span.last + 1; f <= reached.last && found.size() < most; ++f) {
    if (samples.measures(f, gap.marker)) found.push_back(f);
  }
  std::erase_if(found, [&](std::size_t f) { return !samples.sees(f, others); });
  return found;
}

std::vector<std::size_t> helpers_of(const Samples& samples, const MarkerGap& gap) {
  std::vector<std::size_t> helpers;
  for (const std::size_t m : samples.bodies) {
    if (m == gap.marker) continue;
    bool whole = true;
    for (std::size_t f = gap.span.first; whole && f <= gap.span.last; ++f) {
      whole = samples.sees(f, m);
    }
    if (whole) helpers.push_back(m);
  }
  return helpers;
}

namespace {

// Not swept. Points lie on one line if the sum of the principal 2 x 2 minors of their scatter is
// below this share of its squared trace.
constexpr double least_plane = 0.0025;
constexpr int shape_rounds = 2;                     // iterations of a mean shape
constexpr std::size_t most_companion_frames = 192;  // for speed
// Fewer common frames give no reliable distance.
constexpr double least_common = 3;

// Returns the unit quaternion q that maximises the sum of w (R(q) a) . b (Horn 1987), from the sums
// s[i][j] = w a_i b_j. `size` is at least the sum of w |a| |b|; it makes all eigenvalues positive.
Quat best_rotation(const double (&s)[3][3], double size) {
  const rotation::Matrix4 matrix = {{
      {size + s[0][0] + s[1][1] + s[2][2], s[1][2] - s[2][1], s[2][0] - s[0][2], s[0][1] - s[1][0]},
      {s[1][2] - s[2][1], size + s[0][0] - s[1][1] - s[2][2], s[0][1] + s[1][0], s[2][0] + s[0][2]},
      {s[2][0] - s[0][2], s[0][1] + s[1][0], size - s[0][0] + s[1][1] - s[2][2], s[1][2] + s[2][1]},
      {s[0][1] - s[1][0], s[2][0] + s[0][2], s[1][2] + s[2][1], size - s[0][0] - s[1][1] + s[2][2]},
  }};
  return rotation::leading_eigenvector(matrix);
}

}  // namespace

MarkerGroup::MarkerGroup(std::vector<std::size_t> markers, std::vector<double> weights)
    : markers_(std::move(markers)), weights_(std::move(weights)), shape_(markers_.size()) {
  const double sum = std::accumulate(weights_.begin(), weights_.end(), 0.0);
  for (double& weight : weights_) weight /= sum;
}

Vec3 MarkerGroup::centre_of(const Samples& samples, std::size_t frame) const {
  Vec3 centre;
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    centre += weights_[k] * samples.at(frame, markers_[k]);
  }
  return centre;
}

Placement MarkerGroup::placement(const Samples& samples, std::size_t frame) const {
  if (!turns_) return {{}, centre_of(samples, frame)};
  // The shape's weighted sum is zero, so the sums of products need no centring.
  Vec3 centre;
  double sums[3][3] = {}, own = 0, other = 0;
  for (std::size_t k = 0; k < markers_.size(); ++k) {
    const Vec3 a = shape_[k], b = samples.at(frame, markers_[k]), weighted = weights_[k] * b;
    const double left[3] = {a.x, a.y, a.z}, right[3] = {weighted.x, weighted.y, weighted.z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sums[i][j] += left[i] * right[j];
    }
    centre += weighted;
    own += weights_[k] * dot(a, a);
    other += dot(weighted, b);
  }
  const double spread = std::max(0.0, other - dot(centre, centre));
  return {best_rotation(sums, std::sqrt(own * spread)), centre};
}

void MarkerGroup::fit_shape(const Samples& samples, std::span<const std::size_t> frames) {
  const auto take_shape = [&](std::size_t frame) {
    const Vec3 centre = centre_of(samples, frame);
    for (std::size_t k = 0; k < markers_.size(); ++k) {
      shape_[k] = samples.at(frame, markers_[k]) - centre;
    }
  };
  // A limb that is straight in one frame may be bent in another, so several frames are tried.
  turns_ = false;
  for (const std::size_t part : {4U, 2U, 6U, 1U, 7U}) {
    if (turns_) break;
    take_shape(frames[part * frames.size() / 8]);
    turns_ = spans_a_plane();
  }
  for (int round = 0; round < shape_rounds; ++round) {
    std::vector<Vec3> mean(markers_.size());
    for (const std::size_t f : frames) {
      const Placement placed = placement(samples, f);
      for (std::size_t k = 0; k < markers_.size(); ++k) {
        mean[k] += placed.to_local(samples.at(f, markers_[k]));
      }
    }
    for (std::size_t k = 0; k < markers_.size(); ++k) {
      shape_[k] = (1.0 / static_cast<double>(frames.size())) * mean[k];
    }
  }
  turns_ = spans_a_plane();
}

bool MarkerGroup::spans_a_plane() const {
  if (markers_.size() < 3) return false;
  Vec3 centre;
  for (const Vec3& p : shape_) centre += (1 / static_cast<double>(shape_.size())) * p;
  double s[3][3] = {};
  for (const Vec3& place : shape_) {
    const Vec3 off = place - centre;
    const double p[3] = {off.x, off.y, off.z};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) s[i][j] += p[i] * p[j];
    }
  }
  const double trace = s[0][0] + s[1][1] + s[2][2];
  const double minors = s[0][0] * s[1][1] - s[0][1] * s[0][1] + s[0][0] * s[2][2] -
                        s[0][2] * s[0][2] + s[1][1] * s[2][2] - s[1][2] * s[1][2];
  return minors > least_plane * trace * trace;
}

std::vector<Companion> companions_of(const Samples& samples, const MarkerGap& gap,
                                     std::span<const std::size_t> helpers) {
  const std::vector<std::size_t> frames =
      evenly(frames_showing(samples, gap, {}), most_companion_frames);
  std::vector<Companion> companions;
  for (const std::size_t m : helpers) {
    double count = 0, origin = 0, sum = 0, squares = 0;
    for (const std::size_t f : frames) {
      if (!samples.sees(f, m)) continue;
      const double distance = norm(samples.at(f, m) - samples.at(f, gap.marker));
      if (count == 0) origin = distance;
      const double off = distance - origin;
      count += 1;
      sum += off;
      squares += off * off;
    }
    if (count < least_common) continue;
    const double mean = sum / count;
    companions.push_back({m, std::sqrt(std::max(0.0, squares / count - mean * mean))});
  }
  std::stable_sort(companions.begin(), companions.end(),
                   [](const Companion& a, const Companion& b) { return a.spread < b.spread; });
  return companions;
}

}  // namespace kinemend::fill
