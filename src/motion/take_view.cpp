// Makes the tracks of a take, and writes cleaned samples back into it.
#include "kinemend/extend/take_view.hpp"

#include <algorithm>

namespace kinemend {

namespace {

// Returns null for an empty array.
template <class T>
const T* column(const std::vector<T>& values, std::size_t offset) {
  return values.empty() ? nullptr : values.data() + offset;
}

bool has_gap(const Track& track) {
  if (track.observed == nullptr) return false;
  for (std::size_t f = 0; f < track.frames; ++f) {
    if (!track.is_observed(f)) return true;
  }
  return false;
}

bool is_seen(const Track& track) {
  for (std::size_t f = 0; f < track.frames; ++f) {
    if (track.is_observed(f)) return true;
  }
  return false;
}

Track rotation_track(const Take& clip, std::size_t joint) {
  Track track;
  track.frames = clip.frame_count();
  track.space = Space::rotation;
  track.owner = static_cast<std::int32_t>(joint);
  track.rotations = column(clip.rotations, joint);
  track.stride = clip.joint_count();
  track.observed = column(clip.observed, joint);
  track.observed_stride = clip.joint_count();
  return track;
}

// `number` is a point as in `Take::is_position_observed`.
Track track_of_positions(const Take& clip, std::size_t number) {
  Track track;
  track.frames = clip.frame_count();
  track.owner = number == 0 ? -1 : clip.translated_joints[number - 1];
  track.positions = column(clip.positions, number);
  track.observed = column(clip.observed_positions, number);
  track.stride = track.observed_stride = clip.point_count();
  return track;
}

void tell_noise(const TakeNoise& noise, TakeView& take) {
  take.noise_correlation = noise.correlation;
  for (std::size_t n = 0; n < noise.strengths.size(); ++n)
    take.tracks[n].noise = noise.strengths[n];
}

void add_joints(const Take& clip, const Selection& selection, TakeView& take) {
  take.joints = &clip;
  take.owners = clip.joint_count();
  take.tracks.reserve(take.owners + 1 + clip.translated_joints.size());
  for (std::size_t j = 0; j < take.owners; ++j) {
    take.tracks.push_back(rotation_track(clip, j));
    take.tracks.back().selected = selection.includes(j);
  }
  const double bone = typical_bone_length(clip.skeleton);
  for (std::size_t p = 0; p <= clip.translated_joints.size(); ++p) {
    Track track = track_of_positions(clip, p);
    track.radian = bone;
    track.selected = p == 0 ? selection.root_position
                            : selection.translations &&
                                  selection.includes(static_cast<std::size_t>(track.owner));
    take.tracks.push_back(track);
  }
}

void add_markers(const Take& clip, const Selection& selection, TakeView& take) {
  take.markers = &clip;
  take.owners = clip.marker_count();
  take.gaps = GapTreatment::cut;
  take.body_height = selection.body_height > 0 ? selection.body_height : body_height(clip);
  for (std::size_t m = 0; m < take.owners; ++m) {
    Track track;
    track.frames = take.frames;
    track.owner = static_cast<std::int32_t>(m);
    track.positions = column(clip.positions, m);
    track.observed = column(clip.observed, m);
    track.stride = track.observed_stride = take.owners;
    track.radian = take.body_height / 4;
    track.selected = selection.includes(m) && clip.holds_positions(m);
    take.tracks.push_back(track);
  }
}

}  // namespace

TakeView view_of(const Take& take, const Selection& selection) {
  TakeView view;
  view.frames = take.frame_count();
  view.frame_rate_hz = take.frame_rate_hz;
  if (take.has_joints()) {
    add_joints(take, selection, view);
  } else {
    add_markers(take, selection, view);
  }
  tell_noise(selection.noise, view);
  view.source = selection.source;
  return view;
}

double radian_of_positions(const TakeView& take) {
  return take.tracks.empty() ? 1 : take.tracks.back().radian;
}

bool moves(const Track& track) {
  if (track.space == Space::position) return true;
  for (std::size_t f = 1; f < track.frames; ++f) {
    if (track.rotation(f) != track.rotation(0)) return true;
  }
  return false;
}

std::vector<std::size_t> changeable_tracks(const TakeView& take) {
  std::vector<std::size_t> tracks;
  for (std::size_t n = 0; n < take.tracks.size(); ++n) {
    const Track& track = take.tracks[n];
    if (track.selected && moves(track) && is_seen(track)) tracks.push_back(n);
  }
  return tracks;
}

std::vector<Quat> rotations_of(const Track& track) {
  std::vector<Quat> samples(track.space == Space::rotation ? track.frames : 0);
  for (std::size_t f = 0; f < samples.size(); ++f) samples[f] = track.rotation(f);
  return samples;
}

std::vector<Vec3> positions_of(const Track& track) {
  std::vector<Vec3> samples(track.space == Space::position ? track.frames : 0);
  for (std::size_t f = 0; f < samples.size(); ++f) samples[f] = track.position(f);
  return samples;
}

std::vector<std::uint8_t> observed_of(const Track& track) {
  std::vector<std::uint8_t> observed;
  if (!has_gap(track)) return observed;
  observed.resize(track.frames);
  for (std::size_t f = 0; f < track.frames; ++f) observed[f] = track.is_observed(f) ? 1 : 0;
  return observed;
}

void set_track(Take& take, std::size_t track, std::span<const Quat> samples, std::size_t first) {
  for (std::size_t i = 0; i < samples.size(); ++i) take.rotation(first + i, track) = samples[i];
}

void set_track(Take& take, std::size_t track, std::span<const Vec3> samples, std::size_t first) {
  const std::size_t point = track - take.joint_count();
  for (std::size_t i = 0; i < samples.size(); ++i) take.position(first + i, point) = samples[i];
}

double typical_bone_length(const Skeleton& skeleton) {
  double sum = 0, count = 0;
  for (const Vec3& offset : skeleton.offsets) {
    const double length = norm(offset);
    if (length > 0) sum += length, count += 1;
  }
  for (const EndSite& site : skeleton.end_sites) {
    const double length = norm(site.offset);
    if (length > 0) sum += length, count += 1;
  }
  return count > 0 ? sum / count : 1.0;
}

}  // namespace kinemend
