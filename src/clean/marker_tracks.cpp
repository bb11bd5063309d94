#include "clean/marker_tracks.hpp"

#include <algorithm>
#include <optional>

#include "clean/filter_tracks.hpp"
#include "kinemend/frame_rate.hpp"
#include "metrics/track_noise.hpp"

namespace kinemend {

namespace {

// Velocity, per frame, of the straight line of least squares through up to `most` observed samples
// from `end` on in the direction of `step`; nothing where fewer than three stand together.
std::optional<Vec3> velocity_beside(const MarkerPath& path, std::size_t end, int step,
                                    std::size_t most) {
  const std::size_t room = step > 0 ? path.positions.size() - end : end + 1;
  const auto at = [&](std::size_t k) { return step > 0 ? end + k : end - k; };
  std::size_t count = 0;
  while (count < std::min(most, room) && (path.observed.empty() || path.observed[at(count)] != 0))
    ++count;
  if (count < 3) return std::nullopt;
  const double middle = static_cast<double>(count - 1) / 2;
  Vec3 moment;
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) - middle;
    moment += t * (path.positions[at(k)] - path.positions[end]);
    squares += t * t;
  }
  return (static_cast<double>(step) / squares) * moment;
}

// Fills the gap between the observed samples `before` and `after`.
void bridge(MarkerPath& path, std::size_t before, std::size_t after, std::size_t support) {
  const double length = static_cast<double>(after - before);
  const Vec3 start = path.positions[before];
  const Vec3 way = path.positions[after] - start;
  const Vec3 straight = (1 / length) * way;
  const Vec3 leaving = velocity_beside(path, before, -1, support).value_or(straight);
  const Vec3 arriving = velocity_beside(path, after, 1, support).value_or(straight);
  for (std::size_t f = before + 1; f < after; ++f) {
    const double u = static_cast<double>(f - before) / length;
    path.positions[f] = start + (u * u * (3 - 2 * u)) * way +
                        (length * u * (1 - u) * (1 - u)) * leaving -
                        (length * u * u * (1 - u)) * arriving;
  }
}

void bridge_gaps(MarkerPath& path, std::size_t support) {
  if (path.observed.empty()) return;
  std::size_t before = 0;
  for (std::size_t f = 1; f < path.observed.size(); ++f) {
    if (path.observed[f] == 0) continue;
    if (f > before + 1) bridge(path, before, f, support);
    before = f;
  }
}

// Appends the paths of one marker.
void append_paths(const MarkerClip& clip, std::size_t marker, std::vector<MarkerPath>& paths) {
  const std::size_t frames = clip.frame_count(), longest = longest_bridge(clip.frame_rate_hz);
  const std::size_t support = bridge_support(clip.frame_rate_hz);
  for (std::size_t f = 0; f < frames;) {
    if (!clip.is_observed(f, marker)) {
      ++f;
      continue;
    }
    std::size_t last = f;
    bool whole = true;
    for (std::size_t next = f + 1; next < frames && next - last <= longest + 1; ++next) {
      if (!clip.is_observed(next, marker)) continue;
      whole = whole && next == last + 1;
      last = next;
    }
    MarkerPath path{marker, f, {}, {}};
    for (std::size_t t = f; t <= last; ++t) {
      const bool seen = clip.is_observed(t, marker);
      path.positions.push_back(seen ? clip.position(t, marker) : Vec3{});
      if (!whole) path.observed.push_back(seen);
    }
    bridge_gaps(path, support);
    paths.push_back(std::move(path));
    f = last + 1;
  }
}

// The paths [first, last) cover the same frames.
void filter_block(std::span<MarkerPath> paths, const std::function<void(PoseMatrix&)>& filter) {
  const std::size_t frames = paths.front().positions.size();
  PoseMatrix matrix(frames, 3 * paths.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Vec3 origin = paths[i].positions.front();
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p = paths[i].positions[f] - origin;
      matrix(f, 3 * i) = p.x;
      matrix(f, 3 * i + 1) = p.y;
      matrix(f, 3 * i + 2) = p.z;
    }
  }
  filter(matrix);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Vec3 origin = paths[i].positions.front();
    for (std::size_t f = 0; f < frames; ++f) {
      paths[i].positions[f] =
          origin + Vec3{matrix(f, 3 * i), matrix(f, 3 * i + 1), matrix(f, 3 * i + 2)};
    }
  }
}

}  // namespace

std::size_t longest_bridge(double frame_rate_hz) {
  return frames_in(0.25, window_rate_hz(frame_rate_hz), 1);
}

std::size_t bridge_support(double frame_rate_hz) {
  return frames_in(0.05, window_rate_hz(frame_rate_hz), 3);
}

bool marker_selected(const MarkerClip& clip, const MarkerSelection& selection, std::size_t marker) {
  return selection.markers[marker] != 0 && clip.holds_positions(marker);
}

std::vector<MarkerPath> marker_paths(const MarkerClip& clip, const MarkerSelection& selection) {
  std::vector<MarkerPath> paths;
  for (std::size_t m = 0; m < clip.marker_count(); ++m) {
    if (marker_selected(clip, selection, m)) append_paths(clip, m, paths);
  }
  return paths;
}

Vec3 end_velocity(const MarkerPath& path, bool at_last, std::size_t support) {
  const std::size_t end = at_last ? path.positions.size() - 1 : 0;
  return velocity_beside(path, end, at_last ? -1 : 1, support).value_or(Vec3{});
}

void put_back(const MarkerPath& path, MarkerClip& clip) {
  for (std::size_t i = 0; i < path.positions.size(); ++i) {
    if (path.observed.empty() || path.observed[i] != 0)
      clip.position(path.first_frame + i, path.marker) = path.positions[i];
  }
}

double observed_noise(const MarkerClip& clip, std::size_t marker) {
  std::vector<Vec3> seen;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, marker)) seen.push_back(clip.position(f, marker));
  }
  return track_noise(seen);
}

MarkerTrace filter_marker_paths(MarkerClip& clip, const MarkerSelection& selection,
                                const std::function<void(MarkerPath&)>& filter) {
  std::vector<MarkerPath> paths = marker_paths(clip, selection);
  for_each_parallel(paths.size(), clip.positions.size(), [&](std::size_t i) {
    filter(paths[i]);
    put_back(paths[i], clip);
  });
  return {};
}

MarkerTrace filter_marker_tracks(
    MarkerClip& clip, const MarkerSelection& selection,
    const std::function<void(VectorTrack&, const std::vector<double>&)>& filter) {
  return filter_marker_paths(clip, selection, [&](MarkerPath& path) {
    const PositionTrack positions{path.positions.data(), 1};
    VectorTrack track = load_positions(positions, path.positions.size());
    std::vector<double> weights(path.observed.begin(), path.observed.end());
    if (!weights.empty()) weights.resize(weights.size() + lane_room);
    filter(track, weights);
    store_positions(track, positions);
  });
}

MarkerTrace filter_marker_channels(MarkerClip& clip, const MarkerSelection& selection,
                                   const std::function<void(PoseMatrix&)>& filter) {
  constexpr std::size_t most_in_block = 8;
  std::vector<MarkerPath> paths = marker_paths(clip, selection);
  const auto span_of = [](const MarkerPath& path) {
    return std::pair(path.first_frame, path.positions.size());
  };
  std::stable_sort(paths.begin(), paths.end(), [&](const MarkerPath& a, const MarkerPath& b) {
    return span_of(a) < span_of(b);
  });
  std::vector<std::span<MarkerPath>> blocks;
  for (MarkerPath& path : paths) {
    if (blocks.empty() || blocks.back().size() == most_in_block ||
        span_of(blocks.back().front()) != span_of(path)) {
      blocks.push_back({&path, 1});
    } else {
      blocks.back() = {blocks.back().data(), blocks.back().size() + 1};
    }
  }
  for_each_parallel(blocks.size(), clip.positions.size(), [&](std::size_t b) {
    filter_block(blocks[b], filter);
    for (const MarkerPath& path : blocks[b]) put_back(path, clip);
  });
  return {};
}

MarkerTrace clean_markers_causally(const Cleaner& cleaner, MarkerClip& clip,
                                   const MarkerSelection& selection) {
  const auto filter = cleaner.make_marker_filter(clip, selection.body_height);
  const std::size_t markers = clip.marker_count();
  MarkerFrame frame;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    const auto row = static_cast<std::ptrdiff_t>(f * markers);
    const auto width = static_cast<std::ptrdiff_t>(markers);
    frame.positions.assign(clip.positions.begin() + row, clip.positions.begin() + row + width);
    frame.observed.assign(clip.observed.begin() + row, clip.observed.begin() + row + width);
    filter->filter(frame);
    for (std::size_t m = 0; m < markers; ++m) {
      if (clip.is_observed(f, m) && marker_selected(clip, selection, m))
        clip.position(f, m) = frame.positions[m];
    }
  }
  return {};
}

}  // namespace kinemend
