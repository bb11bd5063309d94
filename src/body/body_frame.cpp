// Removes spikes by a running median and fits parabolas with Gaussian weights; follows the root of
// a body of joints, smooths its heading and place, and finds the floor.
#include "body/body_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "base/frame_span.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "body/representation.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/frames.hpp"
#include "motion/take.hpp"

namespace kinemend::representation {

namespace {

double middle_of(std::vector<double>& values) { return upper_median_of(values); }

Vec3 middle_of(std::vector<Vec3>& values) {
  Vec3 best = values.front();
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3 candidate : values) {
    double sum = 0;
    for (const Vec3 other : values) sum += norm(candidate - other);
    if (sum < least) {
      least = sum;
      best = candidate;
    }
  }
  return best;
}

// Windows stay centred near the ends, so that a straight line is unchanged; the end samples follow
// Tukey's rule, which also removes a spike there.
template <class Value>
std::vector<Value> running_median(const std::vector<Value>& track, std::size_t half_window) {
  const std::size_t frames = track.size();
  std::vector<Value> result(track), window;
  for (std::size_t f = 1; f + 1 < frames; ++f) {
    const std::size_t half = std::min({half_window, f, frames - 1 - f});
    const auto first = track.begin() + static_cast<std::ptrdiff_t>(f - half);
    window.assign(first, first + static_cast<std::ptrdiff_t>(2 * half + 1));
    result[f] = middle_of(window);
  }
  const auto end_value = [&](Value end, Value next, Value second) {
    window = {end, next, next + 2 * (next - second)};
    return middle_of(window);
  };
  if (frames >= 3) {
    result.front() = end_value(track.front(), result[1], result[2]);
    result.back() = end_value(track.back(), result[frames - 2], result[frames - 3]);
  }
  return result;
}

template <class Value>
std::vector<Value> despiked(std::vector<Value> track, std::span<const double> weights,
                            double frame_rate_hz) {
  // The window of the median: see docs/details/bodies.md, "Trend". Chosen by hand, not swept.
  constexpr double median_s = 0.1;
  const auto is_known = [&](std::size_t f) { return weights[f] > 0; };
  bridge(track.size(), is_known, [&](std::size_t f) -> Value& { return track[f]; });
  if (std::none_of(weights.begin(), weights.end(), [](double w) { return w > 0; }))
    std::fill(track.begin(), track.end(), Value{});
  const double half_window =
      std::max(2.0, std::round(0.5 * median_s * window_rate_hz(frame_rate_hz)));
  return running_median(track, static_cast<std::size_t>(half_window));
}

// Fits parabolas with Gaussian weights; towards the ends of the track they become straight lines,
// because noise bends those less.
class LocalFit {
 public:
  LocalFit(const std::vector<double>& track, const std::vector<double>& weights,
           double deviation_frames)
      : track_(track),
        weights_(weights),
        kernel_(static_cast<std::size_t>(std::ceil(3 * deviation_frames)) + 1),
        end_frames_(1.5 * deviation_frames) {
    for (std::size_t k = 0; k < kernel_.size(); ++k) {
      const double z = static_cast<double>(k) / deviation_frames;
      kernel_[k] = portable::exp(-0.5 * z * z);
    }
  }

  double at(std::size_t frame) const {
    const Sums sums = sums_around(frame);
    const double line = sums.line();
    const auto to_end = static_cast<double>(std::min(frame, track_.size() - 1 - frame));
    const double u = std::min(1.0, to_end / end_frames_);
    return line + smooth_step(u) * (sums.parabola(line) - line);
  }

 private:
  // Sums of w k^i and w k^i y, where k counts frames from the middle.
  struct Sums {
    double s0 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, t0 = 0, t1 = 0, t2 = 0;

    double line() const {
      const double determinant = s0 * s2 - s1 * s1;
      return determinant > 1e-9 * s0 * s2 ? (s2 * t0 - s1 * t1) / determinant : t0 / s0;
    }
    // `instead`: returned if the samples do not determine a parabola.
    double parabola(double instead) const {
      const double a = s2 * s4 - s3 * s3, b = s2 * s3 - s1 * s4, c = s1 * s3 - s2 * s2;
      const double determinant = s0 * a + s1 * b + s2 * c;
      if (!(determinant > 1e-6 * s0 * s2 * s4)) return instead;
      return (a * t0 + b * t1 + c * t2) / determinant;
    }
  };

  Sums sums_around(std::size_t frame) const {
    const std::size_t reach = kernel_.size() - 1;
    const std::size_t last = std::min(track_.size() - 1, frame + reach);
    Sums sums;
    for (std::size_t g = frame > reach ? frame - reach : 0; g <= last; ++g) {
      const double k = static_cast<double>(g) - static_cast<double>(frame);
      const double w = weights_[g] * kernel_[g > frame ? g - frame : frame - g];
      const double wk = w * k, wkk = wk * k, y = track_[g];
      sums.s0 += w;
      sums.s1 += wk;
      sums.s2 += wkk;
      sums.s3 += wkk * k;
      sums.s4 += wkk * k * k;
      sums.t0 += w * y;
      sums.t1 += wk * y;
      sums.t2 += wkk * y;
    }
    return sums;
  }

  const std::vector<double>& track_;
  const std::vector<double>& weights_;
  std::vector<double> kernel_;
  double end_frames_;
};

// Interpolates between four equally spaced values: u = 0 at the second, 1 at the third.
double cubic(const double* y, double u) {
  const double a = u + 1, b = u, c = u - 1, d = u - 2;
  return -y[0] * b * c * d / 6 + y[1] * a * c * d / 2 - y[2] * a * b * d / 2 + y[3] * a * b * c / 6;
}

// The trend bends so little that a value every eighth of the deviation suffices, except at the
// ends, where a value has no neighbours.
std::vector<double> local_fit(const std::vector<double>& track, std::span<const double> weights,
                              double deviation_frames) {
  // Bridged samples have almost no weight, but leave no frame without any sample. Chosen by hand,
  // not swept.
  constexpr double least_weight = 1e-4;
  const std::size_t frames = track.size();
  std::vector<double> known(weights.begin(), weights.end()), trend(frames);
  for (double& weight : known) weight = std::max(weight, least_weight);
  const LocalFit fit(track, known, deviation_frames);
  const auto step = static_cast<std::size_t>(std::max(1.0, std::floor(deviation_frames / 8)));
  std::vector<double> knots;
  for (std::size_t f = 0; f < frames; f += step) knots.push_back(fit.at(f));
  for (std::size_t f = 0; f < frames; ++f) {
    const std::size_t knot = f / step;
    if (f % step == 0)
      trend[f] = knots[knot];
    else if (knot == 0 || knot + 2 >= knots.size())
      trend[f] = fit.at(f);
    else
      trend[f] = cubic(&knots[knot - 1], static_cast<double>(f % step) / static_cast<double>(step));
  }
  return trend;
}

double deviation_frames(double frame_rate_hz, double deviation_s) {
  return std::max(deviation_s * window_rate_hz(frame_rate_hz), 1e-3);
}

}  // namespace

std::vector<double> smooth_trend(std::vector<double> track, std::span<const double> weights,
                                 double frame_rate_hz, double deviation_s) {
  return local_fit(despiked(std::move(track), weights, frame_rate_hz), weights,
                   deviation_frames(frame_rate_hz, deviation_s));
}

std::vector<Vec3> smooth_path(std::vector<Vec3> path, std::span<const double> weights,
                              double frame_rate_hz, double deviation_s) {
  for (Vec3& point : path) point.y = 0;
  path = despiked(std::move(path), weights, frame_rate_hz);
  std::vector<double> x, z;
  for (const Vec3 point : path) {
    x.push_back(point.x);
    z.push_back(point.z);
  }
  const double deviation = deviation_frames(frame_rate_hz, deviation_s);
  x = local_fit(x, weights, deviation);
  z = local_fit(z, weights, deviation);
  for (std::size_t f = 0; f < path.size(); ++f) path[f] = {x[f], 0, z[f]};
  return path;
}

void continue_angles(std::span<double> angles, std::span<const double> weights) {
  bool started = false;
  double steady = 0, previous = 0;
  int frames_away = 0;
  for (std::size_t f = 0; f < angles.size(); ++f) {
    if (!(weights[f] > 0)) continue;
    if (!started) {
      steady = previous = angles[f];
      started = true;
      continue;
    }
    const double from_steady = wrap_angle(angles[f] - steady, pi);
    const double from_previous = wrap_angle(angles[f] - previous, pi);
    angles[f] = std::fabs(from_steady) < std::fabs(from_previous) ? steady + from_steady
                                                                  : previous + from_previous;
    previous = angles[f];
    if (std::fabs(previous - steady) < steady_rad || ++frames_away > patience_frames) {
      steady = previous;
      frames_away = 0;
    }
  }
}

namespace {

// A joint and its ancestors from the top, with the point that holds each one's offset.
class Chain {
 public:
  Chain(const Take& clip, std::int32_t joint) : clip_(clip) {
    for (; joint >= 0; joint = clip.skeleton.parents[static_cast<std::size_t>(joint)]) {
      const auto j = static_cast<std::size_t>(joint);
      links_.push_back({j, point_of_joint(clip, j)});
    }
    std::reverse(links_.begin(), links_.end());
  }

  std::size_t length() const { return links_.size(); }

  struct Point {
    Quat rotation;
    Vec3 position;
  };
  // Returns the global point after the first `count` joints of the chain.
  Point at(std::size_t frame, std::size_t count) const {
    Point point;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t joint = links_[i].joint;
      point.position += rotate(point.rotation, offset(frame, links_[i]));
      point.rotation =
          point.rotation * clip_.skeleton.rest_rotations[joint] * clip_.rotation(frame, joint);
    }
    return point;
  }
  Quat rotation_at_rest(std::size_t count) const {
    Quat rotation;
    for (std::size_t i = 0; i < count; ++i)
      rotation = rotation * clip_.skeleton.rest_rotations[links_[i].joint];
    return rotation;
  }

 private:
  struct Link {
    std::size_t joint;
    std::optional<std::size_t> point;
  };

  Vec3 offset(std::size_t frame, const Link& link) const {
    return link.point ? clip_.position(frame, *link.point) : clip_.skeleton.offsets[link.joint];
  }

  const Take& clip_;
  std::vector<Link> links_;
};

std::size_t root_joint(const BodyMatch& match) { return static_cast<std::size_t>(match.tracks[0]); }

}  // namespace

RootMotion root_motion(const Take& clip, const BodyMatch& match) {
  const std::size_t frames = clip.frame_count();
  const Chain chain(clip, match.tracks[0]);
  const std::size_t above = chain.length() - 1;
  const Quat unturned = conjugate(match.upright * chain.rotation_at_rest(above));
  RootMotion root;
  for (std::size_t f = 0; f < frames; ++f) {
    const Chain::Point parent = chain.at(f, above);
    const Chain::Point point =
        above == 0 ? Chain::Point{{}, clip.root_position(f)} : chain.at(f, above + 1);
    root.ancestors.push_back(above == 0 ? Quat{} : match.upright * parent.rotation * unturned);
    root.rotations.push_back(root.ancestors.back() * match.before[0] *
                             clip.rotation(f, root_joint(match)) * match.after[0]);
    root.positions.push_back(rotate(match.upright, point.position));
  }
  return root;
}

Heading heading_of(Quat q) {
  // Chosen by hand, not swept.
  constexpr double least_weight = 0.1;  // within 37 degrees of upside down
  const double weight = q.w * q.w + q.y * q.y;
  return {2 * portable::atan2(q.y, q.w), weight > least_weight ? weight : 0};
}

std::size_t root_track(const Take& clip, const BodyMatch& match) {
  return point_of_joint(clip, root_joint(match)).value_or(0);
}

void place_root(Take& clip, const BodyMatch& match, std::size_t frame, Vec3 position) {
  const Vec3 global = rotate(conjugate(match.upright), position);
  const std::size_t joint = root_joint(match);
  if (joint == 0) {
    clip.root_position(frame) = global;
    return;
  }
  const Chain chain(clip, match.tracks[0]);
  if (const auto point = point_of_joint(clip, joint)) {
    const Chain::Point parent = chain.at(frame, chain.length() - 1);
    clip.position(frame, *point) = rotate(conjugate(parent.rotation), global - parent.position);
    return;
  }
  clip.root_position(frame) += global - chain.at(frame, chain.length()).position;
}

void follow_root(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                 const RootMotion& root, BodyChannels& channels) {
  const std::size_t frames = clip.frame_count();
  const std::size_t joint = root_joint(match), track = root_track(clip, match);
  std::vector<double> headings(frames), turned(frames), placed(frames);
  for (std::size_t f = 0; f < frames; ++f) {
    const Heading heading = heading_of(root.rotations[f]);
    headings[f] = heading.angle;
    turned[f] = clip.is_observed(f, joint) ? heading.weight : 0;
    placed[f] = clip.is_position_observed(f, track) ? 1 : 0;
  }
  follow(layout, std::move(headings), turned, root.positions, placed, clip.frame_rate_hz,
         floor_height(clip, layout, match, root), channels);
}

double floor_height(const Take& clip, const BodyLayout& layout, const BodyMatch& match,
                    const RootMotion& root) {
  // Height of the ankle of a standing person in body heights (Drillis and Contini 1966).
  constexpr double ankle_share = 0.039;
  const std::size_t frames = clip.frame_count();
  if (frames == 0) return 0;
  if (match.feet.empty()) {
    // Without feet, the floor follows from the root's median height.
    std::vector<double> heights;
    for (const Vec3 p : root.positions) heights.push_back(p.y);
    return median_of(heights) - layout.place.y * match.body_height;
  }
  const std::vector<double> all(frames, 1.0);
  std::vector<double> lowest;
  for (const std::int32_t foot : match.feet) {
    const Chain chain(clip, foot);
    std::vector<double> heights(frames);
    for (std::size_t f = 0; f < frames; ++f)
      heights[f] = rotate(match.upright, chain.at(f, chain.length()).position).y;
    heights = smooth_trend(std::move(heights), all, clip.frame_rate_hz, floor_mean_s);
    if (lowest.empty()) {
      lowest = std::move(heights);
      continue;
    }
    for (std::size_t f = 0; f < frames; ++f) lowest[f] = std::min(lowest[f], heights[f]);
  }
  return quantile_of(lowest, floor_quantile) - ankle_share * match.body_height;
}

void follow(const BodyLayout& layout, std::vector<double> headings, std::span<const double> turned,
            std::vector<Vec3> places, std::span<const double> placed, double frame_rate_hz,
            double floor, BodyChannels& channels) {
  continue_angles(headings, turned);
  channels.headings = smooth_trend(std::move(headings), turned, frame_rate_hz, layout.trend_s);
  channels.places = smooth_path(std::move(places), placed, frame_rate_hz, layout.trend_s);
  for (Vec3& place : channels.places) place.y = floor;
}

double degrees_per_unit(const BodyMatch& match) {
  return degrees_per_radian / (0.25 * match.body_height);
}

void take_frame(const BodyChannels& guide, const BodyLayout& layout, std::size_t frames,
                BodyChannels& channels) {
  if (guide.poses.frames != frames || guide.poses.channels != layout.channel_count() ||
      guide.headings.size() != frames || guide.places.size() != frames)
    throw Error(ErrorKind::usage, "the guide's channels are not of a copy of the take");
  channels.headings = guide.headings;
  channels.places = guide.places;
  channels.degrees_per_unit = guide.degrees_per_unit;
}

void put_channels(BodyChannels& channels, std::size_t frame, std::size_t channel, Vec3 v) {
  const std::size_t at = frame * channels.poses.channels + channel;
  channels.poses.values[at] = v.x;
  channels.poses.values[at + 1] = v.y;
  channels.poses.values[at + 2] = v.z;
  std::fill_n(channels.observed.begin() + static_cast<std::ptrdiff_t>(at), 3, std::uint8_t{1});
}

Vec3 channels_at(const BodyChannels& channels, std::size_t frame, std::size_t channel) {
  const double* row = channels.poses.row(frame).data() + channel;
  return {row[0], row[1], row[2]};
}

void check_fit(const BodyChannels& channels, const BodyLayout& layout, const BodyMatch& match,
               std::size_t frames, std::span<const std::uint8_t> chosen) {
  const std::size_t choices =
      layout.track_count() + (layout.kind == BodyKind::joints && layout.with_place ? 1 : 0);
  if (channels.poses.frames == frames && channels.headings.size() == frames &&
      channels.places.size() == frames && channels.poses.channels == layout.channel_count() &&
      match.tracks.size() == layout.track_count() && (chosen.empty() || chosen.size() == choices))
    return;
  throw Error(ErrorKind::usage, "the body's channels do not fit the take they are written into");
}

void hold_last_seen(PoseMatrix& poses, std::span<const std::uint8_t> observed) {
  if (std::find(observed.begin(), observed.end(), 0) == observed.end()) return;
  const std::size_t width = poses.channels;
  for (std::size_t c = 0; c < width; ++c) {
    std::size_t first = 0;
    while (first < poses.frames && observed[first * width + c] == 0) ++first;
    if (poses.frames > 0) poses(0, c) = first < poses.frames ? poses(first, c) : 0;
  }
  for (std::size_t i = width; i < poses.values.size(); ++i) {
    if (observed[i] == 0) poses.values[i] = poses.values[i - width];
  }
}

}  // namespace kinemend::representation
