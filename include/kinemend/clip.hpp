#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinemend/rotation.hpp"
#include "kinemend/skeleton.hpp"

namespace kinemend {

/// What a reader keeps of a file so that the file can be written back faithfully. Each format has
/// its own derived class, which only that format reads.
struct SourceDocument {
  virtual ~SourceDocument() = default;
  /// The channel values of the joints as they stand in the file: F rows in the order of
  /// `Skeleton::channels`, in degrees and file units; NaN where the file has no finite number.
  /// Empty for formats without such channels.
  virtual std::vector<double> channel_values() const { return {}; }
};

/// A fact about the rest of a file, in words: {"analog", "16 channels at 1,000 Hz"}.
struct SourceFact {
  std::string name;
  std::string text;
};

struct SourceInfo {
  std::string name;    ///< for messages: the path, or "standard input"
  std::string format;  ///< "bvh"; empty for a clip made in memory
  std::shared_ptr<const SourceDocument> document;
  std::vector<SourceFact> facts{};  ///< what the fields of the take do not say
};

/// A motion of one skeleton: F frames, J joints, frame-major.
struct Clip {
  Skeleton skeleton;
  double frame_rate_hz = 0;
  double metres_per_unit = 0;         ///< for all lengths; 0 where the file does not say
  std::vector<Vec3> root_positions;   ///< F; position of joint 0 in file units (its offset where it
                                      ///< has no position channels)
  std::vector<Quat> local_rotations;  ///< F x J unit quaternions, relative to the rest rotation
  std::vector<std::int32_t>
      translated_joints;  ///< joints other than 0 that have position channels, ascending
  std::vector<Vec3> joint_translations;  ///< F x translated_joints; replaces the joint's offset
  std::vector<std::uint8_t> observed;  ///< F x J, 1 where a rotation was measured; empty: all were
  /// F x (1 + translated_joints), 1 where the position of joint 0 and the translations were
  /// measured; empty: all were.
  std::vector<std::uint8_t> observed_positions;
  SourceInfo source;

  std::size_t frame_count() const noexcept { return root_positions.size(); }
  std::size_t joint_count() const noexcept { return skeleton.joint_count(); }
  Quat& rotation(std::size_t frame, std::size_t joint) {
    return local_rotations[frame * joint_count() + joint];
  }
  Quat rotation(std::size_t frame, std::size_t joint) const {
    return local_rotations[frame * joint_count() + joint];
  }
  bool is_observed(std::size_t frame, std::size_t joint) const {
    return observed.empty() || observed[frame * joint_count() + joint] != 0;
  }
  /// `track` 0 is the position of joint 0; `track` k + 1 is the translation of translated joint k.
  bool is_position_observed(std::size_t frame, std::size_t track) const {
    return observed_positions.empty() ||
           observed_positions[frame * (1 + translated_joints.size()) + track] != 0;
  }
  double duration_s() const noexcept {
    return frame_rate_hz > 0 ? static_cast<double>(frame_count()) / frame_rate_hz : 0.0;
  }

  /// Checks the rules: a valid skeleton, a finite positive rate, arrays of the lengths above,
  /// finite positions, and rotations of unit norm (1e-6). Errors: `ErrorKind::usage` with the first
  /// frame and joint that break a rule.
  void validate() const;
};

/// Frames [first, last) as a new clip, without the source document.
Clip slice(const Clip& clip, std::size_t first, std::size_t last);

/// The number that the file gives its first frame: an AMC file and a table number their frames, and
/// 1 stands for files that do not.
std::int64_t first_frame_number(const Clip& clip);

/// How many frames at the start are a calibration pose, 0 to 9, and not part of the motion. A
/// calibration pose is a T-pose as in the CMU files: joints other than roots are within 25 degrees
/// of their rest rotation, 6 on average. A jump follows: one joint turns by more than 25 degrees,
/// and the mean turn of the joints is 1.5 times that of the next step and of nine in ten later
/// steps. Noise does not hide it. Never all frames of a clip.
std::size_t leading_calibration_frames(const Clip& clip);

}  // namespace kinemend
