// Cuts tracks at long gaps, bridges short ones by cubics, lines or geodesics, and joins cleaned
// pieces again.
#include "cleaner/pieces.hpp"

#include <algorithm>
#include <optional>

#include "base/portable.hpp"
#include "kinemend/extend/frames.hpp"

namespace kinemend {

namespace {

using Path = Piece<Vec3>;

bool is_seen(const Path& path, std::size_t i) {
  return path.observed.empty() || path.observed[i] != 0;
}

// Velocity, per frame, of the least-squares line through up to `most` consecutive observed samples
// from `end` on in the direction of `step`; none if there are fewer than three.
std::optional<Vec3> velocity_beside(const Path& path, std::size_t end, int step, std::size_t most) {
  const std::size_t room = step > 0 ? path.samples.size() - end : end + 1;
  const auto at = [&](std::size_t k) { return step > 0 ? end + k : end - k; };
  std::size_t count = 0;
  while (count < std::min(most, room) && is_seen(path, at(count))) ++count;
  if (count < 3) return std::nullopt;
  const double middle = static_cast<double>(count - 1) / 2;
  Vec3 moment;
  double squares = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) - middle;
    moment += t * (path.samples[at(k)] - path.samples[end]);
    squares += t * t;
  }
  return (static_cast<double>(step) / squares) * moment;
}

// Fills the gap between the observed samples `before` and `after` with a cubic.
void bridge_smoothly(Path& path, std::size_t before, std::size_t after, std::size_t support) {
  const double length = static_cast<double>(after - before);
  const Vec3 start = path.samples[before];
  const Vec3 way = path.samples[after] - start;
  const Vec3 straight = (1 / length) * way;
  const Vec3 leaving = velocity_beside(path, before, -1, support).value_or(straight);
  const Vec3 arriving = velocity_beside(path, after, 1, support).value_or(straight);
  for (std::size_t f = before + 1; f < after; ++f) {
    const double u = static_cast<double>(f - before) / length;
    path.samples[f] = start + smooth_step(u) * way + (length * u * (1 - u) * (1 - u)) * leaving -
                      (length * u * u * (1 - u)) * arriving;
  }
}

void bridge_smoothly(Path& path, std::size_t support) {
  if (path.observed.empty()) return;
  std::size_t before = 0;
  for (std::size_t f = 1; f < path.observed.size(); ++f) {
    if (path.observed[f] == 0) continue;
    if (f > before + 1) bridge_smoothly(path, before, f, support);
    before = f;
  }
}

std::vector<Path> cut_paths(const TakeView& take, std::size_t number) {
  const Track& track = take.tracks[number];
  const std::size_t frames = take.frames, longest = longest_bridge(take.frame_rate_hz);
  const std::size_t support = bridge_support(take.frame_rate_hz);
  std::vector<Path> paths;
  for (std::size_t f = 0; f < frames;) {
    if (!track.is_observed(f)) {
      ++f;
      continue;
    }
    std::size_t last = f;
    bool whole = true;
    for (std::size_t next = f + 1; next < frames && next - last <= longest + 1; ++next) {
      if (!track.is_observed(next)) continue;
      whole = whole && next == last + 1;
      last = next;
    }
    Path path{number, f, {}, {}, {}};
    for (std::size_t t = f; t <= last; ++t) {
      const bool seen = track.is_observed(t);
      path.samples.push_back(seen ? track.position(t) : Vec3{});
      if (!whole) path.observed.push_back(seen);
    }
    bridge_smoothly(path, support);
    paths.push_back(std::move(path));
    f = last + 1;
  }
  return paths;
}

std::vector<std::size_t> observed_frames(std::span<const std::uint8_t> observed) {
  std::vector<std::size_t> frames;
  for (std::size_t f = 0; f < observed.size(); ++f) {
    if (observed[f] != 0) frames.push_back(f);
  }
  return frames;
}

Path straight_path(const TakeView& take, std::size_t number) {
  const Track& track = take.tracks[number];
  Path path{number, 0, positions_of(track), {}, {}};
  const std::vector<std::size_t> seen = observed_frames(observed_of(track));
  if (seen.empty()) return path;
  for (std::size_t f = 0, next = 0; f < take.frames; ++f) {
    while (next < seen.size() && seen[next] < f) ++next;
    const std::size_t after = seen[std::min(next, seen.size() - 1)];
    const std::size_t before = next == 0 || after == f ? after : seen[next - 1];
    if (after == f) continue;
    const double share =
        after > before ? static_cast<double>(f - before) / static_cast<double>(after - before) : 0;
    const Vec3 start = path.samples[before];
    path.samples[f] = start + share * (path.samples[after] - start);
  }
  return path;
}

void bridge_geodesic(std::vector<Quat>& track, std::size_t before, std::size_t after) {
  const Quat a = track[before];
  const Vec3 step = (1.0 / static_cast<double>(after - before)) * log(conjugate(a) * track[after]);
  for (std::size_t f = before + 1; f < after; ++f)
    track[f] = normalized(a * exp(static_cast<double>(f - before) * step));
}

// A position and its velocity, per frame.
struct PathEnd {
  Vec3 place, velocity;

  // The position after `frames` frames of decaying movement; both arguments are negative before the
  // path.
  Vec3 after(double frames, double decay_frames) const {
    return place + (decay_frames * (1 - portable::exp(-frames / decay_frames))) * velocity;
  }
};

PathEnd last_of(const Path& path, std::size_t support) {
  const std::size_t end = path.samples.size() - 1;
  return {path.samples[end], velocity_beside(path, end, -1, support).value_or(Vec3{})};
}

PathEnd first_of(const Path& path, std::size_t support) {
  return {path.samples[0], velocity_beside(path, 0, 1, support).value_or(Vec3{})};
}

// Fills the frames between the last of one path and the first of the next; one may be absent.
void fill_between(const Path* before, const Path* after, double frame_rate_hz,
                  std::vector<Vec3>& positions) {
  const std::size_t support = bridge_support(frame_rate_hz);
  const double decay_frames = 0.1 * frame_rate_hz;
  const std::size_t first = before ? before->first_frame + before->samples.size() : 0;
  const std::size_t last = after ? after->first_frame : positions.size();
  PathEnd left, right;
  if (before) left = last_of(*before, support);
  if (after) right = first_of(*after, support);
  for (std::size_t f = first; f < last; ++f) {
    const double since = static_cast<double>(f - first + 1), until = static_cast<double>(last - f);
    const double u = !before ? 1 : !after ? 0 : since / (since + until);
    const double share = smooth_step(u);
    positions[f] = {};
    if (before) positions[f] += (1 - share) * left.after(since, decay_frames);
    if (after) positions[f] += share * right.after(-until, -decay_frames);
  }
}

}  // namespace

std::size_t longest_bridge(double frame_rate_hz) {
  return frames_in(0.25, window_rate_hz(frame_rate_hz), 1);
}

std::size_t bridge_support(double frame_rate_hz) {
  return frames_in(0.05, window_rate_hz(frame_rate_hz), 3);
}

void bridge_rotations(Piece<Quat>& piece) {
  std::vector<Quat>& track = piece.samples;
  const std::vector<std::size_t> seen = observed_frames(piece.observed);
  if (seen.empty()) return;
  for (std::size_t f = 0; f < seen.front(); ++f) track[f] = track[seen.front()];
  for (std::size_t i = 1; i < seen.size(); ++i) bridge_geodesic(track, seen[i - 1], seen[i]);
  for (std::size_t f = seen.back() + 1; f < track.size(); ++f) track[f] = track[seen.back()];
}

Piece<Quat> rotation_piece(const TakeView& take, std::size_t track) {
  const Track& source = take.tracks[track];
  Piece<Quat> piece{track, 0, rotations_of(source), observed_of(source), {}};
  bridge_rotations(piece);
  return piece;
}

std::vector<Piece<Vec3>> position_pieces(const TakeView& take, std::size_t track) {
  if (take.gaps == GapTreatment::cut) return cut_paths(take, track);
  std::vector<Path> paths;
  paths.push_back(straight_path(take, track));
  return paths;
}

std::vector<Vec3> whole_positions(const TakeView& take, std::size_t track) {
  const std::vector<Path> paths = position_pieces(take, track);
  if (paths.empty()) return {};
  std::vector<Vec3> positions(take.frames);
  for (std::size_t p = 0; p <= paths.size(); ++p) {
    const Path* before = p == 0 ? nullptr : &paths[p - 1];
    const Path* after = p == paths.size() ? nullptr : &paths[p];
    fill_between(before, after, take.frame_rate_hz, positions);
    if (!after) break;
    std::copy(after->samples.begin(), after->samples.end(),
              positions.begin() + static_cast<std::ptrdiff_t>(after->first_frame));
  }
  return positions;
}

std::vector<Quat> observed_rotations(const TakeView& take, std::size_t track) {
  std::vector<Quat> seen;
  for (std::size_t f = 0; f < take.frames; ++f) {
    if (take.tracks[track].is_observed(f)) seen.push_back(take.tracks[track].rotation(f));
  }
  return seen;
}

std::vector<Vec3> observed_positions(const TakeView& take, std::size_t track) {
  std::vector<Vec3> seen;
  for (std::size_t f = 0; f < take.frames; ++f) {
    if (take.tracks[track].is_observed(f)) seen.push_back(take.tracks[track].position(f));
  }
  return seen;
}

CleanedTrack assemble(Piece<Quat> piece) {
  CleanedTrack cleaned{std::move(piece.samples), {}, std::move(piece.actions)};
  if (piece.observed.empty()) return cleaned;
  if (cleaned.actions.empty()) cleaned.actions.assign(piece.observed.size(), Action::kept);
  for (std::size_t f = 0; f < piece.observed.size(); ++f) {
    if (piece.observed[f] == 0) cleaned.actions[f] = Action::filled;
  }
  return cleaned;
}

CleanedTrack assemble(const TakeView& take, std::size_t track, std::span<Piece<Vec3>> pieces) {
  CleanedTrack cleaned;
  cleaned.positions = positions_of(take.tracks[track]);
  for (const Path& piece : pieces) {
    if (!piece.actions.empty() && cleaned.actions.empty())
      cleaned.actions.assign(take.frames, Action::kept);
    for (std::size_t i = 0; i < piece.samples.size(); ++i) {
      if (!is_seen(piece, i)) continue;
      cleaned.positions[piece.first_frame + i] = piece.samples[i];
      if (!piece.actions.empty()) cleaned.actions[piece.first_frame + i] = piece.actions[i];
    }
  }
  return cleaned;
}

Frame frame_of(const TakeView& take, std::size_t frame) {
  Frame result;
  bool all = true;
  for (std::size_t n = 0; n < take.tracks.size(); ++n) {
    const Track& track = take.tracks[n];
    if (track.space == Space::rotation) {
      result.rotations.push_back(track.rotation(frame));
    } else {
      result.positions.push_back(track.position(frame));
    }
    if (n >= take.owners) continue;
    result.observed.push_back(track.is_observed(frame) ? 1 : 0);
    all = all && track.observed == nullptr;
  }
  if (all) result.observed.clear();
  return result;
}

Vec3& position_in(const TakeView& take, std::size_t track, Frame& frame) {
  return frame.positions[take.joints ? track - take.owners : track];
}

VectorTrack::VectorTrack(std::size_t frame_count)
    : frames(frame_count),
      x(frame_count + lane_room),
      y(frame_count + lane_room),
      z(frame_count + lane_room) {}

RotationTrack::RotationTrack(std::size_t frame_count)
    : frames(frame_count),
      w(frame_count + lane_room, 1.0),
      x(frame_count + lane_room),
      y(frame_count + lane_room),
      z(frame_count + lane_room) {}

}  // namespace kinemend
