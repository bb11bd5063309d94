// Matches a take with the model's body and leaves out parts that its channels cannot describe.
#include "methods/learned/learned_body.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/quantiles.hpp"
#include "cleaner/pieces.hpp"
#include "kinemend/error.hpp"
#include "methods/learned/noise_floor.hpp"

namespace kinemend {

namespace {

// Whether the channels of a part can represent its whole motion.
bool is_tame(const BodyChannels& body, std::size_t part) {
  // Strong noise makes smaller steps; a vector that switches to the other way around steps by about
  // a turn. Chosen by hand, not swept.
  constexpr double most_step_deg = 180;
  const auto vector_at = [&](std::size_t frame) {
    return Vec3{body.poses(frame, 3 * part), body.poses(frame, 3 * part + 1),
                body.poses(frame, 3 * part + 2)};
  };
  for (std::size_t f = 0; f < body.poses.frames; ++f) {
    if (norm(vector_at(f)) > degrees_per_radian * tangent_limit_rad) return false;
    if (f > 0 && norm(vector_at(f) - vector_at(f - 1)) > most_step_deg) return false;
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

}  // namespace kinemend
