// Turns rotations and positions of a clip into a matrix of channels without a body, and back.
#include "body/representation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/portable.hpp"
#include "kinemend/error.hpp"
#include "kinemend/extend/body.hpp"
#include "motion/take.hpp"

namespace kinemend {

namespace {

std::vector<std::uint8_t> observed_of(const Take& clip, std::size_t joint) {
  std::vector<std::uint8_t> observed;
  if (clip.observed.empty()) return observed;
  for (std::size_t f = 0; f < clip.frame_count(); ++f)
    observed.push_back(clip.is_observed(f, joint) ? 1 : 0);
  return observed;
}

void encode_tangent(std::span<const Quat> track, Quat reference, PoseMatrix& channels,
                    std::size_t first) {
  Vec3 previous;
  for (std::size_t f = 0; f < track.size(); ++f) {
    const Vec3 v = log(conjugate(reference) * track[f]);
    previous = f == 0 ? v : continue_rotation_vector(v, previous);
    double* row = channels.row(f).data() + first;
    row[0] = previous.x, row[1] = previous.y, row[2] = previous.z;
  }
}

void encode_quaternion(std::span<const Quat> track, PoseMatrix& channels, std::size_t first) {
  SignContinuation sign;
  for (std::size_t f = 0; f < track.size(); ++f) {
    const Quat q = sign.next(track[f]);
    double* row = channels.row(f).data() + first;
    row[0] = q.w, row[1] = q.x, row[2] = q.y, row[3] = q.z;
  }
}

void encode_positions(const Take& clip, EncodedClip& encoded) {
  const std::size_t frames = clip.frame_count();
  const std::size_t first_channel = encoded.joints.size() * encoded.channels_per_joint();
  for (std::size_t column = 0; column <= clip.translated_joints.size(); ++column) {
    Vec3 sum;
    for (std::size_t f = 0; f < frames; ++f) sum += clip.position(f, column);
    const Vec3 mean = frames > 0 ? (1.0 / static_cast<double>(frames)) * sum : Vec3{};
    encoded.position_references.push_back(mean);
    const std::size_t channel = first_channel + 3 * column;
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p = clip.position(f, column) - mean;
      encoded.poses(f, channel) = p.x;
      encoded.poses(f, channel + 1) = p.y;
      encoded.poses(f, channel + 2) = p.z;
    }
  }
}

void check_decodable(const EncodedClip& encoded, const Take& clip) {
  const std::size_t rotations = encoded.joints.size() * encoded.channels_per_joint();
  const std::size_t positions =
      encoded.with_positions ? 3 * (1 + clip.translated_joints.size()) : 0;
  const bool references =
      encoded.encoding != Encoding::tangent || encoded.references.size() == encoded.joints.size();
  if (encoded.poses.frames != clip.frame_count() ||
      encoded.poses.channels != rotations + positions || !references ||
      encoded.position_references.size() * 3 != positions) {
    throw Error(ErrorKind::usage, "the encoded channels do not fit the clip they are decoded into");
  }
  for (const std::size_t joint : encoded.joints) {
    if (joint >= clip.joint_count()) {
      throw Error(ErrorKind::usage, "an encoded joint is not in the clip it is decoded into");
    }
  }
}

}  // namespace

Quat mean_rotation(std::span<const Quat> track, std::span<const std::uint8_t> observed) {
  if (observed.empty()) return chordal_mean(track);
  std::vector<Quat> seen;
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (observed[f] != 0) seen.push_back(track[f]);
  }
  return seen.empty() && !track.empty() ? track[0] : chordal_mean(seen);
}

Quat mean_rotation(const Take& clip, std::size_t joint) {
  return mean_rotation(rotations_of(clip, joint), observed_of(clip, joint));
}

Vec3 continue_rotation_vector(Vec3 v, Vec3 previous) {
  const double angle = norm(v);
  // An identity has no axis of its own: any sphere of whole turns represents it, and the nearest
  // point lies along `previous`.
  if (angle == 0) {
    const double length = norm(previous);
    const double turns = std::round(length / (2 * pi));
    return turns == 0 ? v : (turns * 2 * pi / length) * previous;
  }
  const double turns = std::round((dot(previous, v) / angle - angle) / (2 * pi));
  return turns == 0 ? v : ((angle + 2 * pi * turns) / angle) * v;
}

Quat SignContinuation::next(Quat q) {
  constexpr double near = 0.866;  // cosine of half of 60 degrees, `steady_rad`
  if (frames_away_ < 0) {
    frames_away_ = 0;
    return previous_ = steady_ = q;
  }
  const double to_previous = dot(q, previous_), to_steady = dot(q, steady_);
  const double nearest = std::fabs(to_steady) > std::fabs(to_previous) ? to_steady : to_previous;
  previous_ = nearest < 0 ? -q : q;
  if (std::fabs(to_steady) >= near || ++frames_away_ > patience_frames) {
    steady_ = previous_;
    frames_away_ = 0;
  }
  return previous_;
}

namespace {

double largest_angle_from_mean(std::span<const Quat> track,
                               std::span<const std::uint8_t> observed) {
  const Quat mean = mean_rotation(track, observed);
  double least = 1;
  for (std::size_t f = 0; f < track.size(); ++f) {
    if (observed.empty() || observed[f] != 0)
      least = std::min(least, std::fabs(dot(mean, track[f])));
  }
  return 2 * portable::acos(least);
}

}  // namespace

double largest_angle_from_mean(const Take& clip, std::size_t joint) {
  return largest_angle_from_mean(rotations_of(clip, joint), observed_of(clip, joint));
}

Encoding suitable_encoding(std::span<const Quat> track, std::span<const std::uint8_t> observed) {
  return largest_angle_from_mean(track, observed) < tangent_limit_rad ? Encoding::tangent
                                                                      : Encoding::quaternion;
}

Encoding suitable_encoding(const Take& clip, std::size_t joint) {
  return suitable_encoding(rotations_of(clip, joint), observed_of(clip, joint));
}

void encode_rotations(std::span<const Quat> track, Encoding encoding, Quat reference,
                      PoseMatrix& channels, std::size_t first) {
  if (encoding == Encoding::tangent) {
    encode_tangent(track, reference, channels, first);
  } else {
    encode_quaternion(track, channels, first);
  }
}

Quat decode_rotation(const PoseMatrix& channels, Encoding encoding, Quat reference,
                     std::size_t frame, std::size_t first) {
  const double* v = channels.row(frame).data() + first;
  if (encoding == Encoding::tangent) return normalized(reference * exp({v[0], v[1], v[2]}));
  return normalized({v[0], v[1], v[2], v[3]});
}

EncodedClip encode(const Take& clip, Encoding encoding, std::vector<std::size_t> joints,
                   bool with_positions) {
  if (joints.empty()) {
    joints.resize(clip.joint_count());
    std::iota(joints.begin(), joints.end(), std::size_t{0});
  }
  for (const std::size_t joint : joints) {
    if (joint >= clip.joint_count())
      throw Error(ErrorKind::usage, "a joint to encode is not in the clip");
  }
  EncodedClip encoded;
  encoded.encoding = encoding;
  encoded.joints = std::move(joints);
  encoded.with_positions = with_positions;
  const std::size_t position_columns = with_positions ? 1 + clip.translated_joints.size() : 0;
  encoded.poses =
      PoseMatrix(clip.frame_count(),
                 encoded.joints.size() * encoded.channels_per_joint() + 3 * position_columns);
  for (std::size_t i = 0; i < encoded.joints.size(); ++i) {
    const std::vector<Quat> track = rotations_of(clip, encoded.joints[i]);
    if (encoding == Encoding::tangent)
      encoded.references.push_back(mean_rotation(track, observed_of(clip, encoded.joints[i])));
    encode_rotations(track, encoding,
                     encoding == Encoding::tangent ? encoded.references[i] : Quat{}, encoded.poses,
                     encoded.channels_per_joint() * i);
  }
  if (with_positions) encode_positions(clip, encoded);
  return encoded;
}

void decode(const EncodedClip& encoded, Take& clip) {
  check_decodable(encoded, clip);
  for (std::size_t f = 0; f < encoded.poses.frames; ++f) {
    for (std::size_t i = 0; i < encoded.joints.size(); ++i) {
      const Quat reference = encoded.encoding == Encoding::tangent ? encoded.references[i] : Quat{};
      clip.rotation(f, encoded.joints[i]) = decode_rotation(
          encoded.poses, encoded.encoding, reference, f, encoded.channels_per_joint() * i);
    }
  }
  if (!encoded.with_positions) return;
  const std::size_t first_channel = encoded.joints.size() * encoded.channels_per_joint();
  for (std::size_t column = 0; column < encoded.position_references.size(); ++column) {
    const std::size_t channel = first_channel + 3 * column;
    for (std::size_t f = 0; f < encoded.poses.frames; ++f) {
      const Vec3 p{encoded.poses(f, channel), encoded.poses(f, channel + 1),
                   encoded.poses(f, channel + 2)};
      clip.position(f, column) = encoded.position_references[column] + p;
    }
  }
}

}  // namespace kinemend
