// Removes spikes from tracks and converts them to channels. Matches a take with the model's body,
// calibrates its joints, and leaves out parts that its channels cannot describe.
#include "methods/learned/motion_channels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "base/quantiles.hpp"
#include "body/body_rotations.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/rotation.hpp"
#include "methods/auto/spikes.hpp"
#include "methods/auto/track_vectors.hpp"
#include "methods/auto/vector_tracks.hpp"
#include "methods/learned/noise_floor.hpp"

namespace kinemend {

namespace {

void put(MotionTake& take, std::size_t frame, std::size_t n, Vec3 vector) {
  float* const to = take.values.data() + frame * take.channels + 3 * n;
  to[0] = static_cast<float>(vector.x);
  to[1] = static_cast<float>(vector.y);
  to[2] = static_cast<float>(vector.z);
}

// Reads the tracks of one space and removes their spikes.
void read_together(const TakeView& take, const std::vector<std::size_t>& own,
                   MotionTracks& tracks) {
  if (own.empty()) return;
  std::vector<std::size_t> numbers;
  numbers.reserve(own.size());
  for (const std::size_t n : own) numbers.push_back(tracks.numbers[n]);
  TracksRead read = read_tracks(take, numbers, true);
  const DetectedSpikes spikes = find_spikes(
      read.vectors, read.suspects, tracks_nearby(take, numbers), take.frame_rate_hz, &read.gaps);
  for (std::size_t i = 0; i < own.size(); ++i) {
    tracks.charts[own[i]] = std::move(read.charts[i]);
    // Relative positions make single precision sufficient far from the world's origin.
    const bool turns = tracks.charts[own[i]].has_value();
    const Vec3 origin = turns ? Vec3{} : read.vectors.at(0, i);
    tracks.origins[own[i]] = origin;
    for (std::size_t f = 0; f < take.frames; ++f) {
      put(tracks.take, f, own[i], read.vectors.at(f, i) - origin);
      const bool is_spike = spikes.marked(f, i) != 0;
      tracks.is_spike[f * tracks.numbers.size() + own[i]] = is_spike ? 1 : 0;
      if (!is_spike && read.gaps(f, i) == 0) continue;
      for (std::size_t axis = 0; axis < 3; ++axis)
        tracks.take.missing[f * tracks.take.channels + 3 * own[i] + axis] = 1;
    }
  }
}

}  // namespace

MotionTracks motion_tracks_of(const TakeView& take, std::vector<std::size_t> numbers) {
  MotionTracks tracks;
  tracks.numbers = std::move(numbers);
  const std::size_t count = tracks.numbers.size();
  tracks.charts.resize(count);
  tracks.origins.resize(count);
  tracks.is_spike.resize(take.frames * count);
  tracks.degrees_per_unit = degrees_per_unit(take, Space::position);
  tracks.take.frames = take.frames;
  tracks.take.channels = 3 * count;
  tracks.take.frame_rate_hz = take.frame_rate_hz;
  tracks.take.values.resize(take.frames * 3 * count);
  tracks.take.missing.resize(tracks.take.values.size());
  tracks.take.slots.assign(3 * count, -1);
  std::vector<std::size_t> turning, moving;
  for (std::size_t n = 0; n < count; ++n) {
    const bool turns = take.tracks[tracks.numbers[n]].space == Space::rotation;
    (turns ? turning : moving).push_back(n);
    tracks.take.is_position.insert(tracks.take.is_position.end(), 3, turns ? 0 : 1);
  }
  read_together(take, turning, tracks);
  read_together(take, moving, tracks);
  return tracks;
}

std::vector<float> values_in(const MotionTracks& tracks, const TakeView& other) {
  MotionTake take = tracks.take;
  const double same_unit = tracks.degrees_per_unit / degrees_per_unit(other, Space::position);
  for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
    const std::size_t number = tracks.numbers[n];
    if (const auto& chart = tracks.charts[n]) {
      const std::vector<Quat> rotations = rotation_piece(other, number).samples;
      for (std::size_t f = 0; f < take.frames; ++f)
        put(take, f, n, degrees_per_radian * chart->vector_of(f, rotations[f]));
      continue;
    }
    const std::vector<Vec3> positions = vectors_of(other, number).vectors;
    for (std::size_t f = 0; f < take.frames; ++f)
      put(take, f, n, same_unit * positions[f] - tracks.origins[n]);
  }
  return std::move(take.values);
}

CleanedTrack cleaned_track(const MotionTracks& tracks, const TakeView& take, std::size_t n,
                           std::span<const float> values) {
  std::vector<Vec3> vectors(take.frames);
  std::vector<std::uint8_t> spikes(take.frames);
  for (std::size_t f = 0; f < take.frames; ++f) {
    const float* const from = values.data() + f * tracks.take.channels + 3 * n;
    vectors[f] = tracks.origins[n] + Vec3{from[0], from[1], from[2]};
    spikes[f] = tracks.is_spike[f * tracks.numbers.size() + n];
  }
  const auto& chart = tracks.charts[n];
  return track_of(take, tracks.numbers[n], vectors, spikes, true, chart ? &*chart : nullptr);
}

namespace {

// Whether the channels of a part can represent its whole motion.
bool is_tame(const BodyChannels& body, std::size_t part) {
  // Strong noise makes smaller steps; a vector that switches to the other way around steps by about
  // a turn. Chosen by hand, not swept.
  constexpr double most_step_deg = 180;
  const auto turn_at = [&](std::size_t frame) { return vector_at(body.poses, frame, part); };
  for (std::size_t f = 0; f < body.poses.frames; ++f) {
    if (norm(turn_at(f)) > degrees_per_radian * tangent_limit_rad) return false;
    if (f > 0 && norm(turn_at(f) - turn_at(f - 1)) > most_step_deg) return false;
  }
  return true;
}

// The root mean square turn of a joint about its mean pose, in deviations.
double spread_of(const PoseMatrix& poses, std::span<const float> deviation, std::size_t part) {
  double square = 0;
  for (std::size_t c = 3 * part; c < 3 * part + 3; ++c) {
    const auto unit = static_cast<double>(deviation[c]);
    for (std::size_t f = 0; f < poses.frames; ++f)
      square += poses(f, c) * poses(f, c) / (3 * unit * unit);
  }
  return std::sqrt(square / static_cast<double>(poses.frames));
}

void see_everywhere(const MotionTracks& tracks, Take& clip) {
  const std::size_t joints = clip.joint_count(), positions = 1 + clip.translated_joints.size();
  for (const std::size_t number : tracks.numbers) {
    const bool turns = number < joints;
    std::vector<std::uint8_t>& observed = turns ? clip.observed : clip.observed_positions;
    const std::size_t width = turns ? joints : positions, at = turns ? number : number - joints;
    for (std::size_t i = at; i < observed.size(); i += width) observed[i] = 1;
  }
}

}  // namespace

std::string why_not_learned(const TakeView& view) {
  if (static_cast<double>(view.frames) < shortest_learned_take_s * view.frame_rate_hz)
    return "the take is shorter than half a second";
  if (view.frame_rate_hz < lowest_learned_rate_hz) return "the frame rate is below 20 Hz";
  const bool is_noise_given =
      view.noise_correlation || std::any_of(view.tracks.begin(), view.tracks.end(),
                                            [](const Track& track) { return track.noise > 0; });
  if (is_noise_given) return "the noise is given";
  return {};
}

BodyReading read_body(const BodyLayout& layout, std::span<const float> deviation,
                      const NameMap& names, const TakeView& view, const MotionTracks& tracks) {
  BodyReading reading;
  if (view.joints == nullptr || layout.kind != BodyKind::joints) return reading;
  KnownBody body;
  try {
    body.match = match_body(layout, *view.joints, names);
  } catch (const Error&) {
    if (!names.empty()) throw;
    return reading;
  }
  body.clip = *view.joints;
  for (std::size_t n = 0; n < tracks.numbers.size(); ++n) {
    const CleanedTrack steady = cleaned_track(tracks, view, n, tracks.take.values);
    if (steady.positions.empty()) {
      set_track(body.clip, tracks.numbers[n], steady.rotations);
    } else {
      set_track(body.clip, tracks.numbers[n], steady.positions);
    }
  }
  // Bridges are marked as measured: channels would hold the last sample before a gap, and the
  // network has learned from bridges.
  see_everywhere(tracks, body.clip);
  body.channels = encode_body(body.clip, layout, body.match);
  body.calibration = calibration_of(body.channels.poses, layout);
  body.channels.poses =
      calibrated(body.channels.poses, body.channels.frame_rate_hz, layout, body.calibration);
  body.track_of.assign(body.channels.poses.channels / 3, -1);
  // The place is treated like any position: in the body's frame it would depend on the body's
  // rotation.
  std::size_t wild = 0, tame = 0;
  std::vector<double> spreads;
  for (std::size_t part = 0; part < layout.track_count(); ++part) {
    if (body.match.tracks[part] < 0) continue;
    const auto number = static_cast<std::size_t>(body.match.tracks[part]);
    const auto found = std::find(tracks.numbers.begin(), tracks.numbers.end(), number);
    if (found == tracks.numbers.end()) continue;
    const bool fits = is_tame(body.channels, part);
    ++(fits ? tame : wild);
    if (!fits) continue;
    body.track_of[part] = static_cast<std::int32_t>(found - tracks.numbers.begin());
    spreads.push_back(spread_of(body.channels.poses, deviation, part));
  }
  if (!spreads.empty()) reading.spread = median_of(spreads);
  // Half a body misleads the network more than no body. Chosen by hand, not swept.
  constexpr double most_wild = 0.2;
  // A few moving joints are not enough to judge a body, or a take.
  constexpr double least_spread = 0.02;
  const auto moves = [](double spread) { return spread > least_spread; };
  const auto moving = std::count_if(spreads.begin(), spreads.end(), moves);
  const bool is_still = static_cast<std::size_t>(moving) < fewest_noisy_tracks;
  const bool is_wild = static_cast<double>(wild) > most_wild * static_cast<double>(wild + tame);
  if (!is_wild && !is_still && reading.spread <= most_spread) reading.body = std::move(body);
  return reading;
}

std::vector<std::uint8_t> marks_of(const std::optional<KnownBody>& body, std::size_t tracks) {
  std::vector<std::uint8_t> marks(tracks);
  if (!body) return marks;
  for (const std::int32_t n : body->track_of)
    if (n >= 0) marks[static_cast<std::size_t>(n)] = 1;
  return marks;
}

void show_body(const KnownBody& body, MotionTake& take) {
  for (std::size_t part = 0; part < body.track_of.size(); ++part) {
    if (body.track_of[part] < 0) continue;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t slot = 3 * part + axis;
      const std::size_t c = 3 * static_cast<std::size_t>(body.track_of[part]) + axis;
      take.slots[c] = static_cast<std::int32_t>(slot);
      for (std::size_t f = 0; f < take.frames; ++f)
        take.values[f * take.channels + c] = static_cast<float>(body.channels.poses(f, slot));
    }
  }
}

void decode_known_body(KnownBody& body, const BodyLayout& layout, const MotionTake& take,
                       std::span<const float> values) {
  std::vector<std::uint8_t> chosen;
  for (std::size_t part = 0; part < body.track_of.size(); ++part) {
    const std::int32_t n = body.track_of[part];
    chosen.push_back(n >= 0 ? 1 : 0);
    if (n < 0) continue;
    for (std::size_t f = 0; f < take.frames; ++f) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        body.channels.poses(f, 3 * part + axis) =
            static_cast<double>(values[f * take.channels + 3 * static_cast<std::size_t>(n) + axis]);
    }
  }
  body.channels.poses =
      uncalibrated(body.channels.poses, body.channels.frame_rate_hz, layout, body.calibration);
  decode_body(body.channels, layout, body.match, body.clip, chosen);
}

namespace {

Quat turn_of(const PoseMatrix& poses, std::size_t frame, std::size_t joint) {
  return exp(radians_per_degree * vector_at(poses, frame, joint));
}

// Multiplies the rotations of joints by `left` and `right`.
PoseMatrix turned(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                  std::span<const Quat> left, std::span<const Quat> right) {
  PoseMatrix result = poses;
  std::vector<Vec3> vectors(poses.frames);
  for (std::size_t j = 0; j < layout.track_count(); ++j) {
    const Quat reference = layout.references[j];
    const Quat before = conjugate(reference) * left[j] * reference;
    for (std::size_t f = 0; f < poses.frames; ++f)
      vectors[f] = log(normalized(before * turn_of(poses, f, j) * right[j]));
    representation::continue_vectors(vectors, rate_hz);
    for (std::size_t f = 0; f < poses.frames; ++f) {
      const Vec3 v = degrees_per_radian * vectors[f];
      double* const to = &result(f, 3 * j);
      to[0] = v.x, to[1] = v.y, to[2] = v.z;
    }
  }
  return result;
}

Quat parent_turn(const BodyLayout& layout, const BodyCalibration& calibration, std::size_t joint) {
  const std::int32_t parent = layout.parents[joint];
  return parent < 0 ? Quat{} : calibration.turns[static_cast<std::size_t>(parent)];
}

}  // namespace

BodyCalibration calibration_of(const PoseMatrix& poses, const BodyLayout& layout) {
  const std::size_t joints = layout.track_count();
  std::vector<Quat> sums(joints, Quat{0, 0, 0, 0}), globals(joints), learned(joints);
  const auto follow = [&](std::size_t j, Quat local, const std::vector<Quat>& of) {
    const std::int32_t parent = layout.parents[j];
    return parent < 0 ? local : of[static_cast<std::size_t>(parent)] * local;
  };
  for (std::size_t f = 0; f < poses.frames; ++f) {
    for (std::size_t j = 0; j < joints; ++j) {
      globals[j] = follow(j, layout.references[j] * turn_of(poses, f, j), globals);
      const Quat q = f == 0 ? globals[j] : align_hemisphere(globals[j], sums[j]);
      sums[j] = {sums[j].w + q.w, sums[j].x + q.x, sums[j].y + q.y, sums[j].z + q.z};
    }
  }
  BodyCalibration calibration;
  for (std::size_t j = 0; j < joints; ++j) {
    learned[j] = follow(j, layout.references[j], learned);
    calibration.turns.push_back(normalized(conjugate(normalized(sums[j])) * learned[j]));
  }
  return calibration;
}

PoseMatrix calibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                      const BodyCalibration& calibration) {
  std::vector<Quat> left;
  for (std::size_t j = 0; j < layout.track_count(); ++j)
    left.push_back(conjugate(parent_turn(layout, calibration, j)));
  return turned(poses, rate_hz, layout, left, calibration.turns);
}

PoseMatrix uncalibrated(const PoseMatrix& poses, double rate_hz, const BodyLayout& layout,
                        const BodyCalibration& calibration) {
  std::vector<Quat> left, right;
  for (std::size_t j = 0; j < layout.track_count(); ++j) {
    left.push_back(parent_turn(layout, calibration, j));
    right.push_back(conjugate(calibration.turns[j]));
  }
  return turned(poses, rate_hz, layout, left, right);
}

}  // namespace kinemend
