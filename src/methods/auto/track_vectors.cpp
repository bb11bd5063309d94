// Builds the vectors of a track by its chart, without the spikes that would bend it, or by its
// scale, and finds neighbours by the skeleton or by distances that hardly change.
#include "methods/auto/track_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "base/portable.hpp"
#include "base/quantiles.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/extend/frames.hpp"
#include "methods/auto/spikes.hpp"

namespace kinemend {

namespace {

// Dense outliers bend a reference most at the ends of the take, where its mean has few samples; the
// reference is then computed without them.
RotationChart chart_of(const std::vector<Quat>& rotations, double frame_rate_hz,
                       std::vector<std::uint8_t>* gross = nullptr) {
  std::vector<Quat> track = rotations;
  std::vector<std::uint8_t> marks = replace_gross_spikes(track);
  if (gross) *gross = std::move(marks);
  RotationChart chart = smooth_chart(track, frame_rate_hz);
  std::vector<Vec3> vectors;
  vectors.reserve(rotations.size());
  for (std::size_t t = 0; t < rotations.size(); ++t)
    vectors.push_back(degrees_per_radian * chart.vector_of(t, rotations[t]));
  const std::vector<std::uint8_t> dense = dense_outliers(vectors, {}, frame_rate_hz);
  if (dense.empty()) return chart;
  fill_marked(vectors, dense);
  for (std::size_t t = 0; t < track.size(); ++t)
    track[t] = dense[t] != 0 ? chart.rotation_of(t, radians_per_degree * vectors[t]) : rotations[t];
  return smooth_chart(track, frame_rate_hz);
}

// A bridge follows the sample at its start even if that is a spike, so the samples beside gaps are
// the first suspects.
std::vector<std::uint8_t> beside_gaps(const Track& track, std::size_t frames) {
  std::vector<std::uint8_t> marks(frames);
  for (std::size_t t = 1; t < frames; ++t) {
    const bool before = track.is_observed(t - 1), now = track.is_observed(t);
    if (before != now) marks[now ? t : t - 1] = 1;
  }
  return marks;
}

}  // namespace

TrackVectors vectors_of(const TakeView& take, std::size_t number) {
  TrackVectors curve;
  const Track& track = take.tracks[number];
  if (track.space == Space::rotation) {
    const std::vector<Quat> rotations = rotation_piece(take, number).samples;
    curve.chart = chart_of(rotations, take.frame_rate_hz, &curve.suspects);
    for (std::size_t t = 0; t < take.frames; ++t)
      curve.vectors.push_back(degrees_per_radian * curve.chart->vector_of(t, rotations[t]));
    return curve;
  }
  const double degrees = degrees_per_unit(take);
  if (take.markers) curve.suspects = beside_gaps(track, take.frames);
  curve.vectors = take.markers ? whole_positions(take, number)
                               : std::move(position_pieces(take, number).front().samples);
  for (Vec3& vector : curve.vectors) vector = degrees * vector;
  return curve;
}

TracksRead read_tracks(const TakeView& take, const std::vector<std::size_t>& numbers,
                       bool keep_charts, ShareProgress* progress) {
  const std::size_t frames = take.frames, count = numbers.size();
  TracksRead read{
      VectorTracks(frames, count), SampleMarks(frames, count), SampleMarks(frames, count), {}};
  if (keep_charts) read.charts.resize(count);
  for_each_parallel(count, frames * count, [&](std::size_t n) {
    TrackVectors curve = vectors_of(take, numbers[n]);
    for (std::size_t t = 0; t < frames; ++t) {
      read.vectors.set(t, n, curve.vectors[t]);
      if (!curve.suspects.empty()) read.suspects(t, n) = curve.suspects[t];
      read.gaps(t, n) = take.tracks[numbers[n]].is_observed(t) ? 0 : 1;
    }
    if (keep_charts) read.charts[n] = std::move(curve.chart);
    if (progress != nullptr) progress->step();
  });
  return read;
}

CleanedTrack track_of(const TakeView& take, std::size_t number, std::span<const Vec3> vectors,
                      std::span<const std::uint8_t> spikes, bool smoothed,
                      const RotationChart* chart) {
  const Track& track = take.tracks[number];
  const auto is_new = [&](std::size_t t) { return smoothed || spikes[t] != 0; };
  if (track.space == Space::rotation) {
    Piece<Quat> piece = rotation_piece(take, number);
    piece.actions.assign(take.frames, Action::kept);
    RotationChart made;
    if (!chart) {
      made = chart_of(piece.samples, take.frame_rate_hz);
      chart = &made;
    }
    for (std::size_t t = 0; t < take.frames; ++t) {
      if (is_new(t)) piece.samples[t] = chart->rotation_of(t, radians_per_degree * vectors[t]);
      if (spikes[t] != 0) piece.actions[t] = Action::despiked;
    }
    return assemble(std::move(piece));
  }
  std::vector<Piece<Vec3>> pieces = position_pieces(take, number);
  for (Piece<Vec3>& piece : pieces) {
    piece.actions.assign(piece.samples.size(), Action::kept);
    for (std::size_t i = 0; i < piece.samples.size(); ++i) {
      const std::size_t t = piece.first_frame + i;
      if (is_new(t)) piece.samples[i] = (1 / degrees_per_unit(take)) * vectors[t];
      if (spikes[t] != 0) piece.actions[i] = Action::despiked;
    }
  }
  return assemble(take, number, pieces);
}

namespace {

std::vector<Quat> smooth_reference(std::vector<Quat> track, double width_frames) {
  align_hemispheres(track);
  const std::size_t frames = track.size();
  const auto reach = static_cast<std::size_t>(std::ceil(2.5 * width_frames));
  std::vector<double> weights(reach + 1);
  for (std::size_t k = 0; k <= reach; ++k) {
    const double z = static_cast<double>(k) / width_frames;
    weights[k] = portable::exp(-0.5 * z * z);
  }
  std::vector<Quat> reference(frames);
  for (std::size_t t = 0; t < frames; ++t) {
    Quat sum = track[t];
    // Both sides extend as far as the shorter one: an asymmetric mean would lag behind a turn at
    // the ends.
    for (std::size_t k = 1; k <= std::min({reach, t, frames - 1 - t}); ++k) {
      sum = sum + weights[k] * (track[t - k] + track[t + k]);
    }
    reference[t] = norm(sum) > 1e-3 ? normalized(sum) : track[t];
  }
  return reference;
}

}  // namespace

RotationChart smooth_chart(std::span<const Quat> track, double frame_rate_hz,
                           const ChartTuning& tuning) {
  RotationChart chart;
  chart.reference = smooth_reference({track.begin(), track.end()},
                                     tuning.width_s * window_rate_hz(frame_rate_hz));
  chart.path.resize(track.size());
  for (std::size_t t = 1; t < track.size(); ++t) {
    chart.path[t] = chart.path[t - 1] + log(conjugate(chart.reference[t - 1]) * chart.reference[t]);
  }
  return chart;
}

namespace {

Quat mean_of(Quat a, Quat b) {
  const Quat sum = a + align_hemisphere(b, a);
  return norm(sum) > 1e-9 ? normalized(sum) : a;
}

// Smallest distance of the first of five samples from lines through three of the next four; one
// spike among those four hardly changes it. `at(k)` is the k-th sample from the end.
template <class At>
double end_deviation(const At& at) {
  // Value at 0 of the least-squares line through samples at 1, 2, 3; at 2, 3, 4; and at 1, 3, 4.
  struct Line {
    std::array<std::size_t, 3> samples;
    std::array<double, 3> weights;
  };
  static constexpr Line lines[] = {{{1, 2, 3}, {4.0 / 3, 1.0 / 3, -2.0 / 3}},
                                   {{2, 3, 4}, {11.0 / 6, 1.0 / 3, -7.0 / 6}},
                                   {{1, 3, 4}, {9.0 / 7, 1.0 / 7, -3.0 / 7}}};
  double least = pi;
  for (const Line& line : lines) {
    const Quat base = at(line.samples[0]);
    Vec3 sum;
    for (std::size_t i = 1; i < 3; ++i)
      sum += line.weights[i] * log(conjugate(base) * at(line.samples[i]));
    least = std::min(least, angle_between(base * exp(sum), at(0)));
  }
  return least;
}

std::vector<double> deviations(const std::vector<Quat>& track) {
  const std::size_t last = track.size() - 1;
  std::vector<double> result(track.size());
  for (std::size_t t = 1; t < last; ++t)
    result[t] = angle_between(mean_of(track[t - 1], track[t + 1]), track[t]);
  result[0] = end_deviation([&](std::size_t k) { return track[k]; });
  result[last] = end_deviation([&](std::size_t k) { return track[last - k]; });
  return result;
}

double median_within(const std::vector<double>& values, std::size_t first, std::size_t last) {
  std::vector<double> window(values.begin() + static_cast<std::ptrdiff_t>(first),
                             values.begin() + static_cast<std::ptrdiff_t>(last));
  return upper_median_of(window);
}

bool is_gross_spike(const std::vector<double>& deviation, std::size_t t, double median,
                    const GrossSpikeTuning& tuning) {
  const std::size_t frames = deviation.size();
  if (deviation[t] <= std::max(tuning.ratio * median, tuning.least_deg * radians_per_degree))
    return false;
  for (std::size_t k = t < 2 ? 0 : t - 2; k < std::min(t + 3, frames); ++k) {
    if (deviation[k] > deviation[t]) return false;
  }
  const std::size_t reach = tuning.window_frames;
  const std::size_t first = t < reach ? 0 : t - reach, last = std::min(t + reach + 1, frames);
  return deviation[t] > tuning.ratio * median_within(deviation, first, last);
}

}  // namespace

std::vector<std::uint8_t> replace_gross_spikes(std::vector<Quat>& track,
                                               const GrossSpikeTuning& tuning) {
  const std::size_t frames = track.size();
  std::vector<std::uint8_t> marks(frames);
  if (frames < 5) return marks;
  for (int pass = 0; pass < tuning.passes; ++pass) {
    const std::vector<double> deviation = deviations(track);
    const double median = median_within(deviation, 1, deviation.size() - 1);
    std::vector<std::size_t> peaks;
    for (std::size_t t = 0; t < frames; ++t) {
      if (is_gross_spike(deviation, t, median, tuning)) peaks.push_back(t);
    }
    if (peaks.empty()) break;
    std::vector<Quat> replaced = track;
    for (const std::size_t t : peaks) {
      marks[t] = 1;
      replaced[t] = t == 0            ? track[1]
                    : t == frames - 1 ? track[frames - 2]
                                      : mean_of(track[t - 1], track[t + 1]);
    }
    track = std::move(replaced);
  }
  return marks;
}

std::vector<std::vector<std::size_t>> joints_nearby(std::span<const std::int32_t> parents) {
  const std::size_t count = parents.size();
  std::vector<std::vector<std::size_t>> neighbours(count), nearby(count);
  for (std::size_t j = 0; j < count; ++j) {
    if (parents[j] < 0) continue;
    const auto parent = static_cast<std::size_t>(parents[j]);
    neighbours[j].push_back(parent);
    neighbours[parent].push_back(j);
  }
  for (std::size_t j = 0; j < count; ++j) {
    std::vector<std::uint8_t> seen(count);
    seen[j] = 1;
    std::vector<std::size_t> ring{j};
    for (int bones = 0; bones < 3; ++bones) {
      std::vector<std::size_t> next;
      for (const std::size_t from : ring) {
        for (const std::size_t to : neighbours[from]) {
          if (std::exchange(seen[to], std::uint8_t{1}) == 0) next.push_back(to);
        }
      }
      nearby[j].insert(nearby[j].end(), next.begin(), next.end());
      ring = std::move(next);
    }
  }
  return nearby;
}

namespace {

std::vector<std::vector<std::size_t>> rigid_neighbours(const TakeView& take,
                                                       const std::vector<std::size_t>& markers) {
  // Frames used, evenly over the take, for speed; frames that two markers must share; neighbours
  // kept. All are chosen by hand, not swept.
  constexpr std::size_t most_frames = 50, least_frames = 10, most_neighbours = 4;
  constexpr double farthest = 0.3, largest_spread = 0.02;  // body heights
  const Take& clip = *take.markers;
  const std::size_t frames = take.frames, sampled = std::min(frames, most_frames);
  std::vector<std::vector<std::size_t>> result(markers.size());
  for_each_parallel(markers.size(), markers.size() * markers.size() * sampled, [&](std::size_t n) {
    std::vector<std::pair<double, std::size_t>> near;
    std::vector<double> distances;
    for (std::size_t other = 0; other < markers.size(); ++other) {
      if (other == n) continue;
      distances.clear();
      for (std::size_t i = 0; i < sampled; ++i) {
        const std::size_t f = sampled < 2 ? 0 : i * (frames - 1) / (sampled - 1);
        if (clip.is_observed(f, markers[n]) && clip.is_observed(f, markers[other]))
          distances.push_back(
              norm(clip.position(f, markers[n]) - clip.position(f, markers[other])));
      }
      if (distances.size() < std::min(least_frames, sampled) || distances.empty()) continue;
      const double usual = upper_median_of(distances);
      if (usual > farthest * take.body_height) continue;
      for (double& distance : distances) distance = std::fabs(distance - usual);
      if (upper_median_of(distances) < largest_spread * take.body_height)
        near.emplace_back(usual, other);
    }
    std::sort(near.begin(), near.end());
    for (std::size_t i = 0; i < std::min(near.size(), most_neighbours); ++i)
      result[n].push_back(near[i].second);
  });
  return result;
}

std::vector<std::vector<std::size_t>> joint_neighbours(const Skeleton& skeleton,
                                                       const std::vector<std::size_t>& joints) {
  const auto joints_near = joints_nearby(skeleton.parents);
  std::vector<std::vector<std::size_t>> result(joints.size());
  for (std::size_t n = 0; n < joints.size(); ++n) {
    for (const std::size_t other : joints_near[joints[n]]) {
      const auto found = std::lower_bound(joints.begin(), joints.end(), other);
      if (found != joints.end() && *found == other)
        result[n].push_back(static_cast<std::size_t>(found - joints.begin()));
    }
  }
  return result;
}

}  // namespace

std::vector<std::vector<std::size_t>> tracks_nearby(const TakeView& take,
                                                    const std::vector<std::size_t>& tracks) {
  if (take.markers) return rigid_neighbours(take, tracks);
  if (tracks.empty() || take.tracks[tracks.front()].space == Space::position)
    return std::vector<std::vector<std::size_t>>(tracks.size());
  return joint_neighbours(take.joints->skeleton, tracks);
}

}  // namespace kinemend
