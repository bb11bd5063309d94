#include "kinemend/representation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "kinemend/error.hpp"

namespace kinemend {

namespace {

std::vector<Quat> observed_track(const Clip& clip, std::size_t joint) {
  std::vector<Quat> track;
  track.reserve(clip.frame_count());
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, joint)) track.push_back(clip.rotation(f, joint));
  }
  return track;
}

void encode_tangent(const Clip& clip, EncodedClip& encoded) {
  for (std::size_t i = 0; i < encoded.joints.size(); ++i) {
    const std::size_t joint = encoded.joints[i];
    const Quat reference = mean_rotation(clip, joint);
    encoded.references.push_back(reference);
    Vec3 previous;
    for (std::size_t f = 0; f < clip.frame_count(); ++f) {
      const Vec3 v = log(conjugate(reference) * clip.rotation(f, joint));
      previous = f == 0 ? v : continue_rotation_vector(v, previous);
      encoded.poses(f, 3 * i) = previous.x;
      encoded.poses(f, 3 * i + 1) = previous.y;
      encoded.poses(f, 3 * i + 2) = previous.z;
    }
  }
}

void encode_quaternion(const Clip& clip, EncodedClip& encoded) {
  const std::size_t count = encoded.joints.size();
  std::vector<SignContinuation> signs(count);
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    double* row = encoded.poses.row(f).data();
    for (std::size_t i = 0; i < count; ++i) {
      const Quat q = signs[i].next(clip.rotation(f, encoded.joints[i]));
      row[4 * i] = q.w;
      row[4 * i + 1] = q.x;
      row[4 * i + 2] = q.y;
      row[4 * i + 3] = q.z;
    }
  }
}

// The position columns of a frame: the root's, then those of the translated joints.
template <class AnyClip>
auto& position(AnyClip& clip, std::size_t frame, std::size_t column) {
  if (column == 0) return clip.root_positions[frame];
  return clip.joint_translations[frame * clip.translated_joints.size() + column - 1];
}

void encode_positions(const Clip& clip, EncodedClip& encoded) {
  const std::size_t frames = clip.frame_count();
  const std::size_t first_channel = encoded.joints.size() * encoded.channels_per_joint();
  for (std::size_t column = 0; column <= clip.translated_joints.size(); ++column) {
    Vec3 sum;
    for (std::size_t f = 0; f < frames; ++f) sum += position(clip, f, column);
    const Vec3 mean = frames > 0 ? (1.0 / static_cast<double>(frames)) * sum : Vec3{};
    encoded.position_references.push_back(mean);
    const std::size_t channel = first_channel + 3 * column;
    for (std::size_t f = 0; f < frames; ++f) {
      const Vec3 p = position(clip, f, column) - mean;
      encoded.poses(f, channel) = p.x;
      encoded.poses(f, channel + 1) = p.y;
      encoded.poses(f, channel + 2) = p.z;
    }
  }
}

Quat decode_rotation(const EncodedClip& encoded, std::size_t frame, std::size_t column) {
  if (encoded.encoding == Encoding::tangent) {
    const double* v = &encoded.poses.values[frame * encoded.poses.channels + 3 * column];
    return normalized(encoded.references[column] * exp({v[0], v[1], v[2]}));
  }
  const double* q = &encoded.poses.values[frame * encoded.poses.channels + 4 * column];
  return normalized({q[0], q[1], q[2], q[3]});
}

void check_decodable(const EncodedClip& encoded, const Clip& clip) {
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

Quat mean_rotation(const Clip& clip, std::size_t joint) {
  const std::vector<Quat> track = observed_track(clip, joint);
  return track.empty() && clip.frame_count() > 0 ? clip.rotation(0, joint) : chordal_mean(track);
}

Vec3 continue_rotation_vector(Vec3 v, Vec3 previous) {
  const double angle = norm(v);
  // An identity has no axis of its own: it lies on every sphere of whole turns, nearest along
  // `previous`.
  if (angle == 0) {
    const double length = norm(previous);
    const double turns = std::round(length / (2 * pi));
    return turns == 0 ? v : (turns * 2 * pi / length) * previous;
  }
  const double turns = std::round((dot(previous, v) / angle - angle) / (2 * pi));
  return turns == 0 ? v : ((angle + 2 * pi * turns) / angle) * v;
}

Quat SignContinuation::next(Quat q) {
  constexpr double near = 0.866;  // cosine of half of 60 degrees
  constexpr int patience_frames = 12;
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

double largest_angle_from_mean(const Clip& clip, std::size_t joint) {
  const Quat mean = mean_rotation(clip, joint);
  double least = 1;
  for (std::size_t f = 0; f < clip.frame_count(); ++f) {
    if (clip.is_observed(f, joint))
      least = std::min(least, std::fabs(dot(mean, clip.rotation(f, joint))));
  }
  return 2 * std::acos(least);
}

Encoding suitable_encoding(const Clip& clip, std::size_t joint) {
  return largest_angle_from_mean(clip, joint) < tangent_limit_rad ? Encoding::tangent
                                                                  : Encoding::quaternion;
}

EncodedClip encode(const Clip& clip, Encoding encoding, std::vector<std::size_t> joints,
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
  if (encoding == Encoding::tangent) {
    encode_tangent(clip, encoded);
  } else {
    encode_quaternion(clip, encoded);
  }
  if (with_positions) encode_positions(clip, encoded);
  return encoded;
}

void decode(const EncodedClip& encoded, Clip& clip) {
  check_decodable(encoded, clip);
  for (std::size_t f = 0; f < encoded.poses.frames; ++f) {
    for (std::size_t i = 0; i < encoded.joints.size(); ++i) {
      clip.rotation(f, encoded.joints[i]) = decode_rotation(encoded, f, i);
    }
  }
  if (!encoded.with_positions) return;
  const std::size_t first_channel = encoded.joints.size() * encoded.channels_per_joint();
  for (std::size_t column = 0; column < encoded.position_references.size(); ++column) {
    const std::size_t channel = first_channel + 3 * column;
    for (std::size_t f = 0; f < encoded.poses.frames; ++f) {
      const Vec3 p{encoded.poses(f, channel), encoded.poses(f, channel + 1),
                   encoded.poses(f, channel + 2)};
      position(clip, f, column) = encoded.position_references[column] + p;
    }
  }
}

}  // namespace kinemend
