// Makes gaps in takes without gaps, and compares the expected errors with the real ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kinemend/extend/random.hpp"
#include "kinemend/fill.hpp"
#include "kinemend/take.hpp"

namespace kinemend::fill {

/// One filled gap: the expected error, the real error, and the error of a spline.
struct Kept {
  double promised = 0, error = 0, spline_error = 0;
  double length_s = 0;
  bool inside = true;  ///< whether the gap lies inside the take
};

struct Figures {
  std::size_t gaps = 0, within_twice = 0, above_ten = 0;
  std::size_t short_gaps = 0, worse_than_spline = 0;
  double worst = 0;  ///< largest ratio of error to expected error

  double share_within_twice() const {
    return static_cast<double>(within_twice) / static_cast<double>(gaps);
  }
};

/// `least` is the smallest error of a short gap that is counted.
inline Figures figures_of(const std::vector<Kept>& all, double least) {
  Figures figures;
  for (const Kept& kept : all) {
    const double ratio = kept.error / kept.promised;
    figures.gaps += 1;
    figures.within_twice += ratio <= 2;
    figures.above_ten += ratio > 10;
    figures.worst = std::max(figures.worst, ratio);
    if (kept.length_s > 0.1001 || !kept.inside) continue;
    figures.short_gaps += 1;
    figures.worse_than_spline += kept.error > std::max(2 * kept.spline_error, least);
  }
  return figures;
}

/// Draws a length of 1 frame to 1 s, uniform in its logarithm.
inline std::size_t random_length(Random& random, double frame_rate_hz) {
  const double longest = std::log(frame_rate_hz);
  return static_cast<std::size_t>(std::lround(std::exp(random.uniform(0, longest))));
}

/// Distance in file units, or in degrees for joints.
inline double distance(const Take& a, const Take& b, std::size_t frame, std::size_t track) {
  if (!a.has_joints()) return norm(a.position(frame, track) - b.position(frame, track));
  return angle_between(a.rotation(frame, track), b.rotation(frame, track)) * degrees_per_radian;
}

/// Step from one frame to the next, in file units, or in degrees for joints.
inline Vec3 step_vector(const Take& clip, std::size_t frame, std::size_t track) {
  if (!clip.has_joints()) return clip.position(frame + 1, track) - clip.position(frame, track);
  return degrees_per_radian *
         log(conjugate(clip.rotation(frame, track)) * clip.rotation(frame + 1, track));
}

inline const std::string& name_of(const Take& clip, std::size_t track) {
  return clip.owner_names()[track];
}

inline std::size_t track_of(const Take& clip, const std::string& name) {
  return static_cast<std::size_t>(clip.has_joints() ? clip.skeleton.find(name) : clip.find(name));
}

/// Marks frames `first` to `last`, inclusive, of a joint or marker as missing.
inline void hide(Take& clip, const std::string& name, std::size_t first, std::size_t last) {
  const NamedGap gap{name, first, last};
  mark_gaps(clip, {&gap, 1});
}

/// Puts wrong values into the gaps of joints, which filling must ignore; markers have no values
/// there.
inline Take spoilt(Take clip) {
  if (!clip.has_joints()) return clip;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    for (std::size_t j = 0; j < clip.joint_count(); ++j) {
      if (!clip.is_observed(f, j))
        clip.rotation(f, j) = exp({0, 0, 1 + 0.1 * static_cast<double>(f)});
    }
    if (!clip.is_position_observed(f, 0)) clip.root_position(f) = {1e6, -1e6, 0};
  }
  return clip;
}

inline FillReport fill_with(Take& clip, const std::string& method, bool fill_all = false) {
  FillSettings settings;
  settings.method = method;
  settings.fill_all = fill_all;
  return fill_gaps(clip, settings);
}

inline double rms_error(const Take& truth, const Take& filled, const Gap& gap) {
  double sum = 0;
  for (std::size_t f = gap.first_frame; f <= gap.last_frame; ++f)
    sum += std::pow(distance(truth, filled, f, gap.track), 2);
  return std::sqrt(sum / static_cast<double>(gap.length()));
}

/// Makes one gap in each of some tracks, half of them where the track is fast, and fills them.
inline std::vector<Kept> make_and_fill(const Take& truth, std::vector<std::size_t> tracks,
                                       std::size_t most, std::uint64_t seed) {
  Random random(seed);
  Take clip = truth;
  std::vector<NamedGap> gaps;
  for (std::size_t i = 0; i < std::min(most, tracks.size()); ++i) {
    std::swap(tracks[i], tracks[i + random.below(tracks.size() - i)]);
    const std::size_t length = random_length(random, truth.frame_rate_hz);
    if (truth.frame_count() < 2 * length + 20) continue;
    const int tries = random.chance(0.5) ? 1 : 12;
    std::size_t first = 0;
    double fastest = -1;
    for (int t = 0; t < tries; ++t) {
      const std::size_t start = 5 + random.below(truth.frame_count() - length - 10);
      double way = 0;
      for (std::size_t f = start; f < start + length; ++f)
        way += norm(step_vector(truth, f, tracks[i]));
      if (way > fastest) fastest = way, first = start;
    }
    gaps.push_back({name_of(truth, tracks[i]), first, first + length - 1});
  }
  mark_gaps(clip, gaps);
  Take splined = clip;
  const FillReport report = fill_gaps(clip);
  fill_with(splined, "spline", true);
  std::vector<Kept> all;
  for (const GapOutcome& outcome : report.gaps) {
    const bool made = std::any_of(gaps.begin(), gaps.end(), [&](const NamedGap& gap) {
      return gap.name == name_of(truth, outcome.gap.track) &&
             gap.first_frame == outcome.gap.first_frame && gap.last_frame == outcome.gap.last_frame;
    });
    if (!made || !outcome.filled || outcome.is_position) continue;
    const auto frames = static_cast<double>(outcome.gap.length());
    all.push_back(
        {outcome.expected_error, rms_error(truth, clip, outcome.gap),
         rms_error(truth, splined, outcome.gap), frames / truth.frame_rate_hz,
         outcome.gap.first_frame > 0 && outcome.gap.last_frame + 1 < truth.frame_count()});
  }
  return all;
}

/// First frames of three gaps of that length, `apart` frames from each other and from the ends.
inline std::vector<std::size_t> three_starts(Random& random, std::size_t frames, std::size_t length,
                                             std::size_t apart) {
  std::vector<std::size_t> starts;
  while (starts.size() < 3) {
    const std::size_t start = apart + random.below(frames - length - 2 * apart);
    const bool is_free = std::all_of(starts.begin(), starts.end(), [&](std::size_t other) {
      return std::max(start, other) - std::min(start, other) > length + apart;
    });
    if (is_free) starts.push_back(start);
    // If three gaps do not fit, all are drawn again.
    else if (random.chance(0.05))
      starts.clear();
  }
  return starts;
}

/// Markers that are observed in every frame.
inline std::vector<std::size_t> whole_markers(const Take& clip) {
  std::vector<std::size_t> whole;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    bool seen = true;
    for (std::size_t f = 0; seen && f < clip.frame_count(); ++f) seen = clip.is_observed(f, m);
    if (seen) whole.push_back(m);
  }
  return whole;
}

/// Joints that rotate by more than 0.02 radians.
inline std::vector<std::size_t> moving_joints(const Take& clip) {
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < clip.joint_count(); ++j) {
    double farthest = 0;
    for (std::size_t f = 0; f < clip.frame_count(); ++f)
      farthest = std::max(farthest, angle_between(clip.rotation(0, j), clip.rotation(f, j)));
    if (farthest > 0.02) moving.push_back(j);
  }
  return moving;
}

}  // namespace kinemend::fill
